"""Firefox and WebKit, each driven by its makers' own protocol: Playwright drives only browsers that it has patched."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol

import pytest


class OtherBrowser(Protocol):
    """What the tests need of a browser. Keys are as WebDriver has them: letters, and code points of its `Keys`."""

    def open(self, address: str) -> None:
        """Go to an address."""

    def press(self, *keys: str) -> None:
        """Press all these keys together, and release them."""

    def script(self, text: str) -> Any:
        """Run a script in the page and return its result."""


class _Firefox:
    def __init__(self, path: str) -> None:
        from marionette_driver.marionette import Marionette

        log_to = "-"  # standard output; else the browser writes a file into the working folder
        self._marionette = Marionette(host="127.0.0.1", port=0, bin=path, headless=True, gecko_log=log_to)
        self._marionette.start_session()

    def open(self, address: str) -> None:
        self._marionette.navigate(address)

    def press(self, *keys: str) -> None:
        chain = self._marionette.actions.sequence("key", "keyboard")
        for key in keys:
            chain.key_down(key)
        for key in reversed(keys):
            chain.key_up(key)
        chain.perform()

    def script(self, text: str) -> Any:
        return self._marionette.execute_script(text, sandbox=None)

    def close(self) -> None:
        self._marionette.delete_session()
        self._marionette.cleanup()


class _WebKit:
    def __init__(self, path: str) -> None:
        from selenium import webdriver

        options = webdriver.WebKitGTKOptions()
        self._driver = webdriver.WebKitGTK(options=options, service=webdriver.WebKitGTKService(path))

    def open(self, address: str) -> None:
        self._driver.get(address)

    def press(self, *keys: str) -> None:
        from selenium.webdriver.common.action_chains import ActionChains

        chain = ActionChains(self._driver, duration=0)
        for key in keys:
            chain = chain.key_down(key)
        for key in reversed(keys):
            chain = chain.key_up(key)
        chain.perform()

    def script(self, text: str) -> Any:
        return self._driver.execute_script(text)

    def close(self) -> None:
        self._driver.quit()


@contextmanager
def started(name: str) -> Iterator[OtherBrowser]:
    """A running browser; the test is skipped where it is not installed (`make test-browsers` installs both)."""
    if name == "firefox":
        path = shutil.which("firefox-esr") or shutil.which("firefox")
        driver: Any = _Firefox
    else:
        path = shutil.which("WebKitWebDriver")
        driver = _WebKit
        if not os.environ.keys() & {"DISPLAY", "WAYLAND_DISPLAY"}:
            pytest.skip("WebKit needs a screen")
    if path is None:
        pytest.skip(f"{name} is not installed")
    browser = driver(path)
    try:
        yield browser
    finally:
        browser.close()
