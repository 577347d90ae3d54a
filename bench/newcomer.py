"""Measures the way of a new annotator from the login link to the first correct answer. Run `python -m bench.newcomer`.

A script opens the login link of somebody new in a real Chromium, on a server with a run that has an Inspect_FULL open.
It reads each line of the page once, presses only keys that the page shows, and knows the right answers. It prints the
actions (opening the link, and key presses) and the seconds of a person by the keystroke-level model: 0.28 s for a key,
1.1 + 0.2 s to point at the link and click it, 4 words per second to read, 3 s to watch a path. The time of the machine
and the time to think are left out. `--page FOLDER` measures another build of the web app.
"""

import argparse
import re
import tempfile
from collections.abc import Callable
from contextlib import ExitStack, closing
from dataclasses import dataclass, field
from pathlib import Path

from bench.expert import CLICK, KEY, POINT
from playwright.sync_api import Page
from tests.browser.conftest import WEB, WIDE
from tests.browser.kit import Learner, ask, chromium, login_link

from waypost_server import serving
from waypost_server.settings import Settings

READ, WATCH = 0.25, 3.0  # seconds per word, seconds per path
YES, NO = re.compile("Yes|Pass"), re.compile("No,|Fail")


@dataclass
class Newcomer:
    """Acts on the page for the first time, and counts."""

    page: Page
    actions: int = 0
    seconds: float = 0.0
    known: set[str] = field(default_factory=set)

    def open(self, link: str) -> None:
        """Click the login link."""
        self.actions, self.seconds = self.actions + 1, self.seconds + POINT + CLICK
        self.page.goto(link)

    def key(self, key: str) -> None:
        """Press a key."""
        self.actions, self.seconds = self.actions + 1, self.seconds + KEY
        self.page.keyboard.press(key)

    def read(self) -> None:
        """Read what is new on the page, the names on buttons included."""
        self.page.wait_for_timeout(300)
        lines = self.page.locator("main, dialog[open]").last.inner_text().splitlines()
        new = [line for line in lines if line not in self.known]
        self.known.update(new)
        self.seconds += READ * sum(len(re.findall(r"[A-Za-z]{2,}", line)) for line in new)

    def judge(self, answer: re.Pattern[str]) -> None:
        """Read the question, watch the path, and press the key of the answer."""
        self.page.locator("#question[data-query]").wait_for()
        self.read()
        self.seconds += WATCH
        self.key(self.page.get_by_role("button", name=answer).locator("kbd").inner_text().lower())

    @property
    def is_practicing(self) -> bool:
        """Whether the link has led to practice."""
        self.page.locator("main #question").wait_for()
        return "/practice" in self.page.url


def at_once(newcomer: Newcomer) -> None:
    """Answer the run's question as soon as possible."""
    if newcomer.is_practicing:
        newcomer.read()
        newcomer.key("Escape")
    newcomer.judge(NO)


def explained(newcomer: Newcomer) -> None:
    """Have the question explained first: by the worked example, or by the list of keys if there is none."""
    if newcomer.is_practicing:
        newcomer.read()
        newcomer.key("Enter")
        newcomer.judge(YES)
        newcomer.page.get_by_role("heading", name="Right", exact=True).wait_for()
        return
    newcomer.page.locator("#question[data-query]").wait_for()
    newcomer.key("?")
    newcomer.read()
    newcomer.key("Escape")
    newcomer.judge(NO)


WAYS: dict[str, Callable[[Newcomer], None]] = {"at once": at_once, "explained first": explained}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", type=Path, default=WEB / "dist", help="the folder of a build of the web app")
    page = parser.parse_args().page
    if not (page / "index.html").is_file():
        print("Nothing was measured, because the web app is not built. Run `make web` first.")
        return
    print("| to the first correct answer | actions | person, s |\n| --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        served = stack.enter_context(serving.background(Settings(database=f"sqlite:///{folder}/waypost.db", page=page)))
        learner = stack.enter_context(closing(Learner(served)))
        browser = stack.enter_context(chromium())
        run = learner.create_run("for somebody new")
        for number, (name, way) in enumerate(WAYS.items()):
            [query] = learner.ask(run, ask("inspect_full", number))
            context = browser.new_context(base_url=served.url, viewport=WIDE)
            newcomer = Newcomer(context.new_page())
            newcomer.open(login_link(served, f"newcomer {number}", "annotator"))
            way(newcomer)
            if not newcomer.page.url.endswith("practice?first=yes"):
                assert learner.answer_of(query)["verdict"] == "fail"
            context.close()
            print(f"| {name} | {newcomer.actions} | {newcomer.seconds:.1f} |")


if __name__ == "__main__":
    main()
