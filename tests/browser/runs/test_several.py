"""The list of runs, and several runs at once: overlaid, and side by side."""

import re

from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, wait_for_heading


def test_the_list_leads_to_the_run_and_back(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("on the list", budget=50.0)
    learner.report(run, [True])
    page = open_page("/runs", role="viewer")
    row = page.get_by_role("row", name="on the list")
    expect(row).to_contain_text("1/500")
    expect(row).to_contain_text("0/50")
    row.get_by_role("link").click()
    expect(page).to_have_url(f"{page.url.split('/runs')[0]}/runs/{run}")
    expect(page.get_by_role("heading", name="on the list")).to_be_visible()
    page.go_back()
    expect(page.get_by_role("heading", name="Runs")).to_be_visible()


def test_runs_are_found_sorted_and_overlaid(open_page: Open, learner: Learner) -> None:
    config = {"preset": "lean"}
    for seed in range(2):
        run = learner.create_run(f"twin {seed}", seed=seed, config=config | {"seed": seed})
        learner.report(run, [seed == 0, True])
    page = open_page("/runs")
    page.get_by_role("searchbox", name="Find a run").fill("twin")
    expect(page.get_by_role("row").filter(has_text="twin")).to_have_count(2)
    expect(page).to_have_url(re.compile("text=twin"))
    page.get_by_role("button", name="Success").click()
    expect(page.get_by_role("columnheader", name="Success")).to_have_attribute("aria-sort", "descending")
    expect(page.get_by_role("row").nth(1)).to_contain_text("twin 0")
    for seed in range(2):
        page.get_by_role("checkbox", name=f"Choose twin {seed}").check()
    page.get_by_role("link", name="Overlay 2 chosen").click()
    expect(page.get_by_role("heading", name="2 runs overlaid")).to_be_visible()
    shared = page.url
    chart = page.get_by_role("slider", name="Success on unseen instances")
    chart.focus()
    page.keyboard.press("Home")
    expect(chart).to_have_attribute("aria-valuetext", "episode 0: hg-dagger (2 runs) 50% (0% to 100%)")
    page.keyboard.press("ArrowRight")
    expect(chart).to_have_attribute("aria-valuetext", "episode 1: hg-dagger (2 runs) 75% (50% to 100%)")
    page.get_by_role("checkbox", name="differ only by seed").uncheck()
    expect(chart).to_have_attribute("aria-valuetext", re.compile("twin 0 .*twin 1"))
    other = open_page(shared.removeprefix(page.url.split("/runs")[0]))
    expect(other.get_by_role("heading", name="2 runs overlaid")).to_be_visible()
    learner.report(run, [False, True, True])
    other_chart = other.get_by_role("slider", name="Success on unseen instances")
    expect(other_chart).to_have_attribute("aria-valuemax", "2")


def test_runs_are_compared_side_by_side(open_page: Open, learner: Learner) -> None:
    """With the median and range of those that differ only by seed; what was not reached is more than any number."""
    config = {"preset": "lean"}
    runs = [learner.create_run(f"beside {seed}", seed=seed, config=config | {"seed": seed}) for seed in range(2)]
    worker = open_page(f"/work?run={runs[1]}")
    (query,) = learner.ask(runs[1], ask("inspect_full"))
    wait_for_heading(worker, ask("inspect_full")["question"])
    worker.keyboard.press("y")
    learner.answer_of(query)
    for run, succeeds in zip(runs, (False, True), strict=True):
        learner.report(run, [succeeds] * 100)
    page = open_page("/runs/compare?" + "&".join(f"run={run}" for run in runs))
    table = page.get_by_role("region", name="The runs side by side")
    both, failed, solved = (table.get_by_role("row").nth(place) for place in (1, 2, 3))
    never = ["not reached 1 to not reached"] * 4
    expect(both.get_by_role("cell")).to_have_text(
        ["", "median of 2 runs", "100", "50% 0% to 100%", "0.5 0 to 1", re.compile("s"), *never, ""]
    )
    expect(failed.get_by_role("rowheader")).to_have_text("beside 0")
    expect(failed.get_by_role("cell")).to_have_text(
        ["0", "running", "100", "0%", "0", "0 s", *["not reached"] * 4, "\u00d7"]
    )
    expect(solved.get_by_role("cell")).to_have_text(
        ["1", "running", "100", "100%", "1", re.compile("s"), *["1"] * 4, "\u00d7"]
    )
    failed.get_by_role("link", name="Remove beside 0").click()
    expect(page.get_by_role("heading", name="1 run overlaid")).to_be_visible()
    expect(table.get_by_role("row")).to_have_count(2)


def test_a_run_without_tests_counts_in_no_median_of_success(open_page: Open, learner: Learner) -> None:
    runs = [learner.create_run(f"begun {seed}", seed=seed) for seed in range(2)]
    page = open_page("/runs/compare?" + "&".join(f"run={run}" for run in runs))
    together = page.get_by_role("region", name="The runs side by side").get_by_role("row").nth(1)
    expect(together.get_by_role("cell").nth(3)).to_have_text("\u2013")
    learner.report(runs[0], [True])
    expect(together.get_by_role("cell").nth(3)).to_have_text("100%")
