"""A real server process for each test, a real browser, and a run to compare with."""

import json
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page
from tests.acceptance.processes import LENGTH, VALUES, Reference, ServerProcess, free_port, history, run_waypost
from tests.browser.conftest import WIDE
from tests.browser.kit import Complaints, chromium

from waypost_learner.remote.embedded import embedded


@pytest.fixture
def server(tmp_path: Path) -> Iterator[ServerProcess]:
    process = ServerProcess(tmp_path, free_port())
    process.start()
    yield process
    process.stop()


@pytest.fixture(scope="session")
def in_process(tmp_path_factory: pytest.TempPathFactory) -> Reference:
    """The run with the expert in the learner's process."""
    store = tmp_path_factory.mktemp("in-process") / "store.db"
    summary = json.loads(run_waypost("train", *VALUES, *LENGTH, "--store", str(store), "--json"))
    with embedded(store) as connection:
        return summary, history(connection.learner, summary["run"])


@pytest.fixture
def page() -> Iterator[Page]:
    """A page of Chromium; the test fails if its console complains."""
    complaints = Complaints()
    with chromium() as browser:
        page = browser.new_page(viewport=WIDE)
        complaints.listen(page)
        yield page
    complaints.check()
