"""Long work at the page with all that happens to people: nothing is lost, nothing is doubled, no error in the console.

With WAYPOST_SESSION_MINUTES=30, each session lasts as long, at the pace of a person; bench/RESULTS.md has what that
showed.
"""

import os
import time

import pytest
from playwright.sync_api import Browser
from tests.browser.kit import Complaints, Learner, log_in
from tests.browser.work.session import Session

from waypost_server.serving import Served

MINUTES = float(os.environ.get("WAYPOST_SESSION_MINUTES", "0"))
DEEDS = 60  # where no length is given
PACE = 0.4 if MINUTES else 0  # seconds


@pytest.mark.timeout(300 + 60 * MINUTES)
@pytest.mark.parametrize("seed", range(5 if MINUTES else 2))
def test_a_session_loses_nothing_and_doubles_nothing(
    browser: Browser, served: Served, learner: Learner, complaints: Complaints, seed: int
) -> None:
    complaints.expect("net::ERR_INTERNET_DISCONNECTED")
    complaints.expect("409")  # U came too late
    with browser.new_context(base_url=served.url, viewport={"width": 1440, "height": 900}) as context:
        context.set_default_timeout(30_000)
        log_in(context, served, f"session-{seed}", "annotator")
        session = Session(seed, context, learner, complaints, PACE)
        end = time.monotonic() + 60 * MINUTES
        session.work(lambda: time.monotonic() > end if MINUTES else session.did.total() >= DEEDS)
        session.check()
        print(f"session {seed}: {dict(session.did)}")
