"""Everybody can use it: no violations of WCAG 2.2 A and AA that axe can find, on any view, light and dark."""

import re
from typing import Any

import pytest
from playwright.sync_api import Page, expect
from tests.browser.conftest import WEB, Open
from tests.browser.kit import Learner, ask, begun_run, wait_for_heading

KINDS = ("inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")
SIZES = ({"width": 1280, "height": 800}, {"width": 768, "height": 1024}, {"width": 390, "height": 844})
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]


def violations_at_every_width(page: Page) -> list[Any]:
    """What axe finds on a desktop, a tablet and a phone."""
    found = []
    for size in SIZES:
        page.set_viewport_size(size)
        found += [(size["width"], *one) for one in violations(page)]
    return found


def violations(page: Page) -> list[Any]:
    """What axe finds on the page as it is."""
    if not page.evaluate("'axe' in window"):
        page.evaluate((WEB / "node_modules" / "axe-core" / "axe.min.js").read_text())
    found = page.evaluate("tags => axe.run({ runOnly: tags })", TAGS)
    return [(one["id"], [node["html"] for node in one["nodes"]]) for one in found["violations"]]


@pytest.fixture(params=["light", "dark"])
def scheme(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_work_is_accessible(open_page: Open, learner: Learner, scheme: str) -> None:
    run = learner.create_run("access", budget=500.0)
    learner.ask(run, *[ask(kind, ordinal=ordinal) for ordinal, kind in enumerate(KINDS)])
    page = open_page(f"/work?run={run}", scheme=scheme, motion="reduce")
    for kind in KINDS:
        wait_for_heading(page, ask(kind)["question"])
        if kind.startswith("label"):
            page.keyboard.press("Enter")
            page.keyboard.press("2")
        if kind == "label_lo":
            page.keyboard.press(".")
            page.keyboard.press("d")
        assert violations_at_every_width(page) == [], kind
        page.keyboard.press("f" if "inspect" in kind else "Shift+Enter")
    wait_for_heading(page, "No question right now")
    expect(page.get_by_text("The learner is training on the answers.")).to_be_visible()
    expect(page.get_by_text("The next question appears here")).to_be_visible()
    assert violations_at_every_width(page) == [], "waiting"


def test_dialogs_are_accessible(open_page: Open, learner: Learner, scheme: str) -> None:
    run = learner.create_run("dialogs")
    learner.ask(run, ask("label_hi"))
    page = open_page(f"/work?run={run}", scheme=scheme)
    wait_for_heading(page, ask("label_hi")["question"])
    for key in ("?", "Shift+S", "Control+k"):
        page.keyboard.press(key)
        page.get_by_role("dialog").wait_for()
        assert violations(page) == [], key
        page.keyboard.press("Escape")


def test_runs_are_accessible(open_page: Open, learner: Learner, scheme: str) -> None:
    run, page = begun_run(learner, open_page, "watched", 500.0, scheme=scheme)
    page.goto(f"/runs/{run}")
    page.get_by_role("slider").first.wait_for()
    for summary in page.get_by_text("As a table").all():
        summary.click()
    assert violations(page) == [], "run"
    page.goto("/runs")
    page.get_by_role("row", name="watched").first.wait_for()
    assert violations(page) == [], "runs"
    page.goto(f"/runs/compare?run={run}")
    page.get_by_role("slider").first.wait_for()
    assert violations(page) == [], "overlaid"
    for tab in ("ledger", "queries"):
        page.goto(f"/runs/{run}/{tab}")
        page.get_by_role("row", name="Inspect_FULL").wait_for()
        assert violations(page) == [], tab
    page.get_by_role("link", name="Inspect_FULL").click()
    page.get_by_role("heading", name="In the ledger").wait_for()
    assert violations(page) == [], "query"


def test_dialogs_of_a_run_are_accessible(open_page: Open, learner: Learner, scheme: str) -> None:
    page = open_page(f"/runs/{learner.create_run('dialogs of a run')}", role="admin", scheme=scheme)
    for name in ("Change…", "Finish…"):
        page.get_by_role("button", name=name).click()
        page.get_by_role("dialog").wait_for()
        assert violations(page) == [], name
        page.keyboard.press("Escape")


def test_login_is_accessible(open_page: Open, scheme: str) -> None:
    page = open_page("/login", role=None, scheme=scheme)
    page.get_by_role("heading", name="Sign in with a link").wait_for()
    assert violations(page) == []


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


def test_the_first_tab_leads_past_the_header(open_page: Open, learner: Learner, scheme: str) -> None:
    learner.create_run("past the header")
    page = open_page("/runs", scheme=scheme)
    page.get_by_role("heading", name="Runs").wait_for()
    page.keyboard.press("Tab")
    skip = page.get_by_role("link", name="Skip to the content")
    expect(skip).to_be_focused()
    expect(skip).to_be_in_viewport(ratio=1)
    assert violations(page) == []
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
