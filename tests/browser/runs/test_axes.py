"""The axes of a run's charts."""

from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, wait_for_heading


def test_the_numbers_of_a_dear_run_fit_beside_the_axis(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("a dear one", prices={"inspect_full": 20_000_000})
    page = open_page(f"/runs/{run}", role="viewer")
    learner.ask(run, ask("inspect_full"))
    worker = open_page(f"/work?run={run}")
    wait_for_heading(worker, ask("inspect_full")["question"])
    worker.keyboard.press("n")
    expect(page.get_by_role("row", name="Inspect_FULL 0, query 0")).to_contain_text("answered")
    learner.report(run, [True, True])
    label = page.locator("text.tick").get_by_text("20,000,000", exact=True)
    label.wait_for()
    assert label.evaluate("text => text.getBBox().x") >= 0
