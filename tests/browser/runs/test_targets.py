"""What the page of a run says about levels of success that it has not reached."""

import pytest
from playwright.sync_api import Page, expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner


def run_with(learner: Learner, outcomes: list[bool], state: str = "running") -> str:
    """Return a run with these tests."""
    run = learner.create_run("with few tests", episodes=len(outcomes))
    learner.report(run, outcomes)
    learner.call("PATCH", f"/runs/{run}", {"state": state})
    return run


def tile(page: Page, term: str) -> str:
    """What a tile says below its name."""
    return page.locator(".tiles .card").filter(has=page.get_by_text(term)).inner_text()


def test_a_finished_run_says_why_it_reached_no_level(open_page: Open, learner: Learner) -> None:
    page = open_page(f"/runs/{run_with(learner, [True] * 60, 'finished')}", role="viewer")
    expect(page.get_by_text("Success, last 60")).to_be_visible()
    levels = tile(page, "Cost to reach")
    assert levels.count("not reached") == 3
    assert "not yet" not in levels
    assert "needs 100 tests, has 60" in levels
    forecast = page.get_by_role("region", name="Forecast")
    expect(forecast).to_contain_text(
        "The run ended with 60 tests. A level of success counts as reached from the 100th test on."
    )
    expect(forecast).not_to_contain_text("ended before")


def test_a_run_that_goes_on_may_still_reach_its_levels(open_page: Open, learner: Learner) -> None:
    run = run_with(learner, [True] * 60)
    page = open_page(f"/runs/{run}", role="viewer")
    expect(page.get_by_text("Success, last 60")).to_be_visible()
    assert tile(page, "Cost to reach").count("not yet") == 3
    assert "needs 100 tests, has 60" in tile(page, "Cost to reach")
    learner.report(run, [True] * 100)
    expect(page.get_by_text("Success, last 100", exact=True)).to_be_visible()
    expect(page.get_by_text("not yet")).to_have_count(0)
    expect(page.get_by_text("needs 100 tests")).to_have_count(0)


@pytest.mark.parametrize(("tests", "said"), [(60, 1), (100, 0)])
def test_the_comparison_says_why_a_run_reached_no_level(
    open_page: Open, learner: Learner, tests: int, said: int
) -> None:
    run = run_with(learner, [True] * tests, "finished")
    page = open_page(f"/runs/compare?run={run}", role="viewer")
    expect(page.get_by_role("row")).to_have_count(2)
    expect(page.get_by_text("A level of success counts as reached from the 100th test on.")).to_have_count(said)
