"""On a phone held upright, no view is wider than the window."""

import pytest
from playwright.sync_api import Locator, Page, expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, begun_run, wait_for_heading

from waypost_server.serving import Served

PHONE = {"width": 390, "height": 844}
KINDS = ("inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")


def too_wide(page: Page) -> list[str]:
    """What reaches beyond the right edge of the window and cannot be scrolled to in a part of its own."""
    return list(
        page.evaluate("""async () => {
          const frame = () => new Promise(requestAnimationFrame)
          await frame().then(frame) // a picture measures its place after the window has its size
          if (document.documentElement.scrollWidth <= innerWidth) return []
          const scrolls = (one) => one !== null && one !== document.body &&
            (['auto', 'scroll', 'hidden'].includes(getComputedStyle(one).overflowX) || scrolls(one.parentElement))
          return [...document.body.querySelectorAll('*')]
            .filter((one) => one.getBoundingClientRect().right > innerWidth && !scrolls(one.parentElement))
            .map((one) => one.outerHTML.slice(0, 60))
        }""")
    )


@pytest.mark.parametrize("kind", KINDS)
def test_work_fits_a_phone(open_page: Open, learner: Learner, kind: str) -> None:
    run = learner.create_run("a run whose name is rather long for a phone", budget=5000.0)
    learner.ask(run, ask(kind))
    page = open_page(f"/work?run={run}", role="admin", size=PHONE)
    wait_for_heading(page, ask(kind)["question"])
    page.get_by_text("0 answers").wait_for()
    assert too_wide(page) == []
    for name in ("Work", "Runs", "Practice", "People"):
        expect(page.get_by_role("link", name=name, exact=True)).to_be_in_viewport(ratio=1)
    for name in ("Keys", "Theme"):
        expect(page.get_by_role("button", name=name)).to_be_in_viewport(ratio=1)


def test_runs_fit_a_phone(open_page: Open, learner: Learner) -> None:
    run, page = begun_run(learner, open_page, "a run whose name is rather long for a phone", 5000.0, size=PHONE)
    query = page.locator("[data-query]").get_attribute("data-query")
    row, chart = page.get_by_role("row").nth(1), page.get_by_role("slider").first
    for path, there in (
        ("/runs", row),
        (f"/runs/{run}", chart),
        (f"/runs/{run}/queries", row),
        (f"/runs/{run}/queries/{query}", chart),
        (f"/runs/{run}/ledger", row),
        (f"/runs/{run}/gold", page.get_by_role("button", name="Mark as gold")),
        (f"/runs/compare?run={run}", chart),
    ):
        page.goto(path)
        there.wait_for()
        assert too_wide(page) == [], path


def sideways(page: Page) -> list[str]:
    """The tables that can be read only by scrolling sideways."""
    tables = page.locator("[role=region]:has(> table)").filter(visible=True)
    tables.first.wait_for()
    wide = "all => all.filter(one => one.scrollWidth > one.clientWidth).map(one => one.ariaLabel)"
    return list(tables.evaluate_all(wide))


def test_tables_of_runs_are_read_on_a_phone_without_scrolling_sideways(open_page: Open, learner: Learner) -> None:
    run, page = begun_run(learner, open_page, "a run whose name is rather long for a phone", 5000.0, size=PHONE)
    query = next(one["id"] for one in learner.call("GET", f"/runs/{run}/query-rows")["rows"])
    own = ("", "/queries", f"/queries/{query}", "/ledger", "/gold")
    for path in ("/runs", f"/runs/compare?run={run}", *(f"/runs/{run}{part}" for part in own)):
        page.goto(path)
        assert sideways(page) == [], path


def test_on_a_phone_a_run_is_read_in_two_lines(open_page: Open, learner: Learner) -> None:
    run, page = begun_run(learner, open_page, "short name", 5000.0, size=PHONE)
    page.goto(f"/runs?text={run}")
    row = page.get_by_role("row").filter(has_text="short name")
    first = [row.get_by_role("link"), row.get_by_text("running")]
    second = [row.get_by_role("cell", name=name) for name in ("Episodes 3", "Success 66.7%", "Cost 1")]
    for one in (*first, *second):
        expect(one).to_be_in_viewport(ratio=1)

    def middles(line: list[Locator]) -> list[float]:
        boxes = [one.bounding_box() for one in line]
        return [box["y"] + box["height"] / 2 for box in boxes if box is not None]

    assert max(middles(first)) < min(middles(second))
    page.get_by_role("button", name="Name").click()  # the heads still sort
    expect(page.get_by_role("columnheader", name="Name")).to_have_attribute("aria-sort", "ascending")


def test_curves_of_several_runs_take_most_of_a_phone(open_page: Open, learner: Learner) -> None:
    """Their names are above the chart, so that they leave the width to the lines."""
    runs = [learner.create_run(f"a run with a long name, number {number}") for number in range(2)]
    for run in runs:
        learner.report(run, [True] * 5)
    page = open_page("/runs/compare?apart=yes&" + "&".join(f"run={run}" for run in runs), size=PHONE)
    chart, line = page.get_by_role("slider").first, page.locator("svg path.grid").first
    chart.wait_for()
    whole, drawn = chart.bounding_box(), line.bounding_box()
    assert whole
    assert drawn
    assert drawn["width"] > 0.7 * whole["width"]


def test_people_and_practice_fit_a_phone(open_page: Open, empty: Served) -> None:
    page = open_page("/people", at=empty, role="admin", size=PHONE)
    person = page.get_by_role("row").nth(1).get_by_role("link")
    person.wait_for()
    assert too_wide(page) == [], "people"
    person.click()
    page.get_by_role("heading", name="Role and login").wait_for()
    assert too_wide(page) == [], "person"
    page.goto("/me")
    page.get_by_role("heading", name="API tokens").wait_for()
    assert too_wide(page) == [], "me"
    page.goto("/practice")
    page.get_by_role("heading", name="Practice").wait_for()
    assert too_wide(page) == [], "practice"
    page.keyboard.press("Enter")
    wait_for_heading(page, "Did it do the whole task?")
    assert too_wide(page) == [], "practice query"
    page.keyboard.press("f")
    wait_for_heading(page, "Not right")
    assert too_wide(page) == [], "feedback"


def test_on_a_tablet_the_map_is_large_and_the_player_below_it(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("tablet")
    learner.ask(run, ask("label_lo"))
    page = open_page(f"/work?run={run}", size={"width": 768, "height": 1024})
    wait_for_heading(page, ask("label_lo")["question"])
    picture = page.locator("canvas").bounding_box()
    player = page.get_by_role("region", name="Player").bounding_box()
    assert picture is not None
    assert player is not None
    assert picture["width"] >= 0.58 * 768
    assert picture["y"] + picture["height"] <= player["y"]
    assert player["y"] + player["height"] <= 640
    page.keyboard.press("?")
    expect(page.get_by_role("dialog", name="Keys")).to_contain_text("the ring with a dot is the target")


def test_on_a_tablet_many_labels_do_not_cover_what_is_below_them(open_page: Open, learner: Learner) -> None:
    actions = ["noop", "jump", "up", "right", "left", "down", "jump right", "jump left"]
    words = {"domain": "game", "subgoals": ["stair", "key"], "actions": actions, "renderer": "none"}
    run = learner.create_run("many labels", vocabulary=words)
    segment = {"subgoal": "stair", "states": list(range(41)), "actions": ["jump right"] * 40}
    learner.ask(run, ask("label_lo", segments=[segment], context=[], suggestion=None))
    page = open_page(f"/work?run={run}", size={"width": 768, "height": 1024})
    wait_for_heading(page, ask("label_lo")["question"])
    labels, skip = page.get_by_role("list", name="States").bounding_box(), page.get_by_role("button", name="Skip")
    below = skip.bounding_box()
    assert labels is not None
    assert below is not None
    assert labels["y"] + labels["height"] <= below["y"]
    skip.click()
    expect(page.get_by_role("dialog", name="Skip this question")).to_be_visible()
