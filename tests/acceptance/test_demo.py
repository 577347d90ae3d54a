"""`waypost demo`, as a newcomer meets it: one command, one link, something to judge, and nothing left behind."""

import os
import re
import signal
import sqlite3
import subprocess
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect
from tests.acceptance.processes import WAYPOST

PATIENCE_SECONDS = 120.0
LONG_ENOUGH_SECONDS = 5.0  # for a bot that does not wait to answer


@pytest.fixture(params=["maze", "montezuma"])
def domain(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@dataclass
class Demo:
    """`waypost demo` in a process group of its own, and its store."""

    store: Path
    process: subprocess.Popen[str]

    @property
    def link(self) -> str:
        assert self.process.stdout is not None
        (link,) = next(found for line in self.process.stdout if (found := re.findall(r"once: (http\S+)", line)))
        return str(link)

    def count(self, state: str) -> int:
        """Return how many questions, apart from demonstrations, are in a state."""
        try:
            with closing(sqlite3.connect(f"file:{self.store}?mode=ro", uri=True)) as store:
                question = "select count(*) from queries where kind <> 'hier_demo' and state = ?"
                return int(store.execute(question, [state]).fetchone()[0])
        except sqlite3.OperationalError:  # there is no store yet
            return 0

    def wait_for(self, state: str) -> None:
        """Wait until there is a question in a state."""
        deadline = time.monotonic() + PATIENCE_SECONDS
        while self.count(state) == 0:
            assert time.monotonic() < deadline, f"no question was {state}"
            time.sleep(0.2)


@contextmanager
def run_demo(store: Path, *options: str) -> Iterator[Demo]:
    process = subprocess.Popen(
        [*WAYPOST, "demo", "--port", "0", "--database", str(store), *options],
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    try:
        yield Demo(store, process)
    finally:
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


def expect_something_to_judge(page: Page) -> None:
    expect(page.get_by_text(re.compile("^(Inspect|Label)_")).first).to_be_visible(timeout=PATIENCE_SECONDS * 1_000)


def test_the_link_opens_on_something_to_judge_and_nothing_is_left_behind(
    tmp_path: Path, domain: str, page: Page
) -> None:
    with run_demo(tmp_path / "demo.db", "--domain", domain) as demo:
        page.goto(demo.link)  # at once: the learner has not asked anything yet
        expect_something_to_judge(page)
        if domain == "montezuma":
            expect(page.locator("img.shown")).to_be_visible()  # a picture of the game
        page.goto("about:blank")
        demo.process.send_signal(signal.SIGTERM)
        assert demo.process.wait(timeout=30) == 0
        assert demo.process.stdout is not None
        assert "Stopped." in demo.process.stdout.read()
        assert not is_alive(demo.process.pid)


def test_the_run_waits_at_its_first_question_until_somebody_opens_the_link(tmp_path: Path, page: Page) -> None:
    with run_demo(tmp_path / "demo.db") as demo:
        link = demo.link
        demo.wait_for("open")
        time.sleep(LONG_ENOUGH_SECONDS)
        assert demo.count("answered") == 0
        page.goto(link)
        expect_something_to_judge(page)
        page.goto("about:blank")  # gone again; the bot answers what is left
        demo.wait_for("answered")


def test_a_script_can_tell_the_run_not_to_wait_for_anybody(tmp_path: Path) -> None:
    with run_demo(tmp_path / "demo.db", "--no-wait") as demo:
        demo.wait_for("answered")
