"""The marks on a maze: the agent is never covered, no other mark looks like it, and the legend names each mark."""

import pytest
from playwright.sync_api import Page, expect
from tests.browser import test_takeover
from tests.browser.conftest import WIDE, Open, Stage
from tests.browser.kit import Cell, Json, Learner, ask, wait_for_heading
from tests.browser.test_narrow import PHONE
from tests.browser.test_play import press

SIZES = [PHONE, {"width": 360, "height": 640}, WIDE]
END: Cell = (6, 5)  # of the third segment
# Points of a cell, as (right, down) from its middle
MIDDLE = [(0.0, 0.0), (0.15, 0.0), (-0.15, 0.0), (0.0, 0.15), (0.0, -0.15), (0.1, 0.1), (-0.1, -0.1)]
CORNERS = [(0.29, 0.29), (-0.29, 0.29), (0.29, -0.29), (-0.29, -0.29)]


def colors(page: Page, cell: Cell, points: list[tuple[float, float]]) -> list[str]:
    """The colors that the map has at points of a cell: "dark" as the agent, "light" as the floor, or "other"."""
    script = """([row, column, points]) => {
      const canvas = document.querySelector('canvas'), {width} = canvas, unit = width / 17
      const copy = new OffscreenCanvas(width, width).getContext('2d', {willReadFrequently: true})
      copy.drawImage(canvas, 0, 0)
      const nameOf = (color) =>
        Math.max(...color) < 60 ? 'dark' : Math.min(...color) > 190 ? 'light' : 'other'
      return points.map(([right, down]) => nameOf([...copy.getImageData(
        Math.floor((column + 0.5 + right) * unit), Math.floor((row + 0.5 + down) * unit), 1, 1).data.slice(0, 3)]))
    }"""
    return list(page.evaluate(script, [*cell, points]))


def begin(open_page: Open, learner: Learner, asked: Json, **opened: object) -> Page:
    run = learner.create_run("marks")
    learner.ask(run, asked)
    page = open_page(f"/work?run={run}", motion="reduce", **opened)
    wait_for_heading(page, asked["question"])
    return page


def names(page: Page, *marks: str) -> None:
    """The legend names these marks, and no others."""
    expect(page.get_by_role("list", name="Legend").get_by_role("listitem")).to_have_text(marks)


def agent_is_whole(page: Page, cell: Cell, step: int) -> None:
    """Nothing covers the agent in a cell."""
    expect(page.get_by_role("slider", name="Step")).to_have_value(str(step))
    assert set(colors(page, cell, MIDDLE)) == {"dark"}, f"step {step}"


@pytest.mark.parametrize("size", SIZES, ids=lambda size: f"{size['width']}")
@pytest.mark.parametrize("kind", ["label_hi", "label_lo", "inspect_lo"])
def test_nothing_covers_the_agent_in_any_step(open_page: Open, learner: Learner, kind: str, size: Json) -> None:
    asked = ask(kind)
    segments = [*asked.get("context", []), *asked["segments"]]
    states = [segments[0]["states"][0], *(state for one in segments for state in one["states"][1:])]
    page = begin(open_page, learner, asked, size=size)
    if kind == "label_lo":
        press(page, "Enter", "ArrowDown", "Enter", "d")
    page.get_by_role("slider", name="Step").fill("0")
    for step, (row, column) in enumerate(states[:-1]):  # the last one is in lava, with a cross in it
        agent_is_whole(page, (row, column), step)
        press(page, ".")


def test_on_a_phone_somebody_who_plays_on_sees_the_agent_and_whole_buttons(
    open_page: Open, learner: Learner, stage: Stage
) -> None:
    run, query, translator = test_takeover.failed_in_a_maze(learner)
    stage(learner.served, query, translator)
    page = open_page(f"/work?run={run}", size=PHONE, touch=True, motion="reduce")
    test_takeover.is_here(page, "north")
    page.get_by_role("button", name="south", exact=True).tap()
    expect(page.get_by_text("Move toward “south”.")).to_be_visible()
    agent_is_whole(page, (10, 1), 5)
    bottom = page.locator(".scroll").bounding_box()
    assert bottom
    for name in ("north", "south", "west", "east", "go to target"):
        box = page.get_by_role("button", name=name, exact=True).bounding_box()
        assert box
        assert box["y"] + box["height"] <= bottom["y"] + bottom["height"], name


def test_done_here_is_a_square_that_no_agent_could_be(open_page: Open, learner: Learner) -> None:
    page = begin(open_page, learner, ask("label_lo"))
    assert set(colors(page, END, CORNERS)) == {"light"}
    press(page, *["Enter"] * 6, "d", ",")
    expect(page.get_by_text("7 of 7")).to_be_visible()
    assert set(colors(page, END, CORNERS)) == {"dark"}
    press(page, ".")  # the agent on it
    assert set(colors(page, END, CORNERS)) == {"dark"}
    assert set(colors(page, END, [(0.3, 0), (0, 0.3), (-0.3, 0), (0, -0.3)])) == {"light"}  # its edge


def test_arrows_that_point_at_each_other_stay_apart(open_page: Open, learner: Learner) -> None:
    page = begin(open_page, learner, ask("label_lo"))
    press(page, "Enter", "ArrowDown")  # up out of (8, 1), and down into it again
    expect(page.get_by_text("2 of 7")).to_be_visible()
    assert colors(page, (8, 1), [(0.27, -0.3)]) == ["dark"]
    assert colors(page, (7, 1), [(-0.27, 0.3)]) == ["dark"]
    across = [(share / 20, -0.5) for share in range(-9, 10)]  # the border between the two
    assert "dark" not in colors(page, (8, 1), across)


def test_the_legend_names_the_marks_that_are_there_and_no_others(open_page: Open, learner: Learner) -> None:
    page = begin(open_page, learner, ask("inspect_full"))
    always = ["agent", "target", "door", "lava", "1Nsubgoal"]
    names(page, *always, "✕end in lava")
    page = begin(open_page, learner, ask("label_lo"))
    names(page, *always, "end")
    expect(page.get_by_text("or drag along the right way.")).to_be_visible()
    press(page, "Enter")
    names(page, *always, "label", "end")
    press(page, *["Enter"] * 5, "d", ",")
    names(page, *always, "label", "done here")
    page = begin(open_page, learner, ask("label_hi"))
    press(page, "t")
    names(page, "agent", "door", "lava", "1Nsubgoal", "Nto choose", "label: target", "✕end in lava")


@pytest.mark.parametrize("size", [*SIZES, {"width": 768, "height": 1024}], ids=lambda size: f"{size['width']}")
def test_the_map_keeps_its_size_when_a_mark_comes(open_page: Open, learner: Learner, size: Json) -> None:
    page = begin(open_page, learner, ask("label_lo"), size=size)
    before = page.locator("canvas").bounding_box()
    press(page, *["Enter"] * 6, "d", ",")
    expect(page.get_by_role("button", name="Send answer")).to_be_visible()
    assert page.locator("canvas").bounding_box() == before
