"""What whoever waits for a question is told about the learner."""

import pytest
from playwright.sync_api import Page, Route, ViewportSize, expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, wait_for_heading
from tests.browser.pictures import SIZES

SOON = 5_000  # milliseconds; without events, the view would ask again after 20 s


def waiting(open_page: Open, run: str) -> Page:
    """The work view of a run that asks nothing."""
    page = open_page(f"/work?run={run}", intercepted=True)
    wait_for_heading(page, "No question right now")
    return page


def age(page: Page, seconds: float) -> None:
    """Look again, at runs that changed so long ago."""

    def older(route: Route) -> None:
        said = route.fetch().json()
        route.fulfill(json=said | {"runs": [one | {"seconds": seconds} for one in said["runs"]]})

    page.unroute_all()
    page.route("**/outlook*", older)
    page.reload()
    wait_for_heading(page, "No question right now")


def test_no_learner_is_said_to_work_before_one_has_done_anything(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("without a learner")
    page = waiting(open_page, run)
    expect(page.get_by_text("No learner has asked or reported anything for this run yet.")).to_be_visible()
    expect(page.get_by_text("trying its task")).to_have_count(0)
    age(page, 180)
    expect(page.get_by_text("Nothing has come for 3 min. Perhaps nobody has started a learner.")).to_be_visible()
    learner.report(run, [True])
    expect(page.get_by_text("The learner is trying its task")).to_be_visible(timeout=SOON)


def test_a_learner_that_is_silent_for_longer_than_usual_is_said_to_be(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("silent")
    learner.report(run, [True])
    page = waiting(open_page, run)
    expect(page.get_by_text("The learner is trying its task")).to_be_visible()
    expect(page.get_by_text("Nothing has come from it")).to_have_count(0)
    age(page, 100)
    expect(page.get_by_text("Nothing has come from it for 2 min.")).to_be_visible()
    expect(page.get_by_text("may have stopped")).to_have_count(0)
    age(page, 220)
    expect(page.get_by_text("Nothing has come from it for 4 min, so it may have stopped.")).to_be_visible()


def test_a_pause_is_said_as_soon_as_it_begins(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("paused meanwhile")
    learner.report(run, [True])
    page = waiting(open_page, run)
    expect(page.get_by_text("The learner is trying its task")).to_be_visible()
    learner.call("PATCH", f"/runs/{run}", {"state": "paused"})
    expect(page.get_by_text("The run is paused.")).to_be_visible(timeout=SOON)
    learner.call("PATCH", f"/runs/{run}", {"state": "running"})
    expect(page.get_by_text("The learner is trying its task")).to_be_visible(timeout=SOON)
    learner.ask(run, ask("inspect_full"))
    wait_for_heading(page, ask("inspect_full")["question"])


@pytest.mark.parametrize("size", SIZES.values(), ids=SIZES)
def test_no_word_is_on_the_empty_picture(open_page: Open, learner: Learner, size: ViewportSize) -> None:
    page = open_page(f"/work?run={learner.create_run('beside')}", size=size)
    wait_for_heading(page, "No question right now")
    picture, words = (page.locator(f"main {part}").bounding_box() for part in (".stage", "section[aria-labelledby]"))
    assert picture is not None
    assert words is not None
    right, bottom = picture["x"] + picture["width"], picture["y"] + picture["height"]
    assert words["x"] >= right or words["y"] >= bottom
