"""`waypost demo`, as a newcomer meets it: one command, one link, something to judge, and nothing left behind."""

import os
import re
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect
from tests.acceptance.processes import WAYPOST

PATIENCE_MS = 60_000


@pytest.fixture(params=["maze", "montezuma"])
def domain(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def demo(tmp_path: Path, domain: str) -> Iterator[subprocess.Popen[str]]:
    process = subprocess.Popen(
        [*WAYPOST, "demo", "--domain", domain, "--port", "0", "--database", str(tmp_path / "demo.db")],
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    yield process
    if is_alive(process.pid):
        os.killpg(process.pid, signal.SIGKILL)
    process.communicate()


def is_alive(group: int) -> bool:
    """Whether any process of a group is."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def test_the_link_opens_on_something_to_judge_and_nothing_is_left_behind(
    demo: subprocess.Popen[str], domain: str, page: Page
) -> None:
    assert demo.stdout is not None
    (link,) = next(found for line in demo.stdout if (found := re.findall(r"once: (http\S+)", line)))
    page.goto(link)
    expect(page.get_by_text(re.compile("^(Inspect|Label)_")).first).to_be_visible(timeout=PATIENCE_MS)
    if domain == "montezuma":
        expect(page.locator("img.shown")).to_be_visible()  # a picture of the game
    page.goto("about:blank")
    demo.send_signal(signal.SIGTERM)
    assert demo.wait(timeout=30) == 0
    assert "Stopped." in demo.stdout.read()
    assert not is_alive(demo.pid)
