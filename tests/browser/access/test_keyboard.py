"""The focus: where Tab leads, and where it goes when a view opens; the theme; nothing is cut off."""

import re

import pytest
from playwright.sync_api import expect
from tests.browser.access.axe import violations_in_every_look
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, wait_for_heading


def test_the_theme_is_chosen_and_remembered(open_page: Open) -> None:
    page = open_page("/login", role=None, scheme="light")
    background = "getComputedStyle(document.documentElement).backgroundColor"
    light = page.evaluate(background)
    for _ in range(2):  # from the system's to light to dark
        page.get_by_role("button", name="Theme").click()
    dark = page.evaluate(background)
    assert dark != light
    page.reload()
    assert page.evaluate(background) == dark


def test_tab_goes_through_the_segments_and_out_again(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("tab")
    learner.ask(run, ask("label_hi"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("label_hi")["question"])
    for _ in range(5 + 1):  # past the five subgoals, onto the first segment
        page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    current = page.locator("[aria-current=step]")
    expect(current).to_be_focused()
    expect(current).to_contain_text("2")
    page.keyboard.press("w")
    expect(page.locator("[aria-current=step]")).to_be_focused()
    expect(page.locator("[aria-current=step]")).to_contain_text("3")
    for _ in range(3 + 2):  # past the other segments, skip and take back
        page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="Keep").first).to_be_focused()


def test_the_first_tab_leads_past_the_header(open_page: Open, learner: Learner) -> None:
    learner.create_run("past the header")
    page = open_page("/runs")
    page.get_by_role("heading", name="Runs").wait_for()
    page.keyboard.press("Tab")
    skip = page.get_by_role("link", name="Skip to the content")
    expect(skip).to_be_focused()
    expect(skip).to_be_in_viewport(ratio=1)
    assert violations_in_every_look(page) == []
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="Runs")).to_be_focused()
    assert page.url.endswith("/runs")
    page.keyboard.press("Tab")
    expect(page.get_by_role("searchbox")).to_be_focused()
    expect(skip).not_to_be_in_viewport()


def test_the_focus_goes_to_the_heading_of_another_view_and_stays_in_the_same_one(
    open_page: Open, learner: Learner
) -> None:
    run = learner.create_run("to land on")
    learner.ask(run, ask("inspect_full"), ask("inspect_full", 1, question="The next one"))
    page = open_page(f"/work?run={run}", role="admin")
    wait_for_heading(page, ask("inspect_full")["question"])
    page.get_by_role("link", name="Runs").press("Enter")
    wait_for_heading(page, "Runs")
    search = page.get_by_role("searchbox")
    search.fill("to land on")
    expect(page).to_have_url(re.compile("text=to"))
    expect(page.get_by_role("row")).to_have_count(2)
    expect(search).to_be_focused()
    page.get_by_role("link", name="to land on").press("Enter")
    wait_for_heading(page, "to land on")
    page.get_by_role("link", name="Queries", exact=True).press("Enter")
    page.get_by_role("combobox", name="Kind").wait_for()
    expect(page.get_by_role("link", name="Queries", exact=True)).to_be_focused()
    page.get_by_role("link", name="Inspect_FULL").first.press("Enter")
    page.get_by_role("link", name="Next").or_(page.get_by_role("link", name="Previous")).first.wait_for()
    expect(page.get_by_role("heading", level=1)).to_be_focused()
    page.go_back()
    wait_for_heading(page, "to land on")
    page.wait_for_timeout(1_200)  # longer than between two refreshes: the query that was left is not loaded again
    page.get_by_role("link", name="Practice").click()
    wait_for_heading(page, "Practice")
    page.goto(f"/work?run={run}")
    wait_for_heading(page, ask("inspect_full")["question"])
    page.get_by_role("button", name="Yes, it worked").focus()
    page.keyboard.press("f")
    wait_for_heading(page, "The next one")


@pytest.mark.parametrize("size", [(768, 1024), (1024, 768), (1440, 900), (1920, 1080), (844, 390)])
def test_nothing_is_cut_off(open_page: Open, learner: Learner, size: tuple[int, int]) -> None:
    run = learner.create_run("sizes")
    learner.ask(run, ask("inspect_lo"))
    page = open_page(f"/work?run={run}", size={"width": size[0], "height": size[1]})
    wait_for_heading(page, ask("inspect_lo")["question"])
    for name in ("Yes, it worked", "No, it failed", "Skip", "Take back"):
        expect(page.get_by_role("button", name=name)).to_be_in_viewport(ratio=1)
    expect(page.get_by_role("slider", name="Step")).to_be_in_viewport(ratio=1)
    assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
