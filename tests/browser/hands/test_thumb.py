"""On a phone, the buttons that play a demonstration are under the thumb: nobody scrolls to make a move."""

import pytest
from playwright.sync_api import Page, expect
from tests.browser import test_takeover
from tests.browser.conftest import Open, Stage
from tests.browser.hands.pointer import box_of
from tests.browser.kit import Json, Learner
from tests.browser.test_play import SEGMENTS, WAY, ask, is_here, send

MOVES = {"u": "up", "d": "down", "l": "left", "r": "right"}
PHONES = [{"width": 390, "height": 844}, {"width": 360, "height": 640}, {"width": 844, "height": 390}]
THUMB = 44  # pixels that a button needs in both directions


def tap(page: Page, name: str) -> None:
    """Tap on a button where it is, without scrolling."""
    button = page.get_by_role("button", name=name, exact=True)
    expect(button).to_be_in_viewport(ratio=1)
    box = button.bounding_box()
    assert box is not None
    assert box["width"] >= THUMB, name
    assert box["height"] >= THUMB, name
    page.touchscreen.tap(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)


@pytest.mark.parametrize("size", PHONES)
def test_a_demonstration_is_played_with_a_thumb(open_page: Open, learner: Learner, stage: Stage, size: Json) -> None:
    run = learner.create_run("thumb")
    [query] = learner.ask(run, ask())
    stage(learner.served, query)
    page = open_page(f"/work?run={run}", size=size, touch=True)
    is_here(page)
    assert box_of(page)["width"] >= 240
    for number, (segment, (_, steps)) in enumerate(zip(SEGMENTS, WAY, strict=True)):
        tap(page, str(segment["subgoal"]).replace("_", " "))
        for step in steps:
            tap(page, MOVES[step])
        if number + 1 < len(WAY):
            tap(page, "Reached")
    expect(page.get_by_text("The task is accomplished. Send the demonstration.")).to_be_in_viewport()
    assert page.evaluate("scrollY") == 0
    send(page)
    assert learner.answer_of(query)["segments"] == SEGMENTS


@pytest.mark.parametrize("size", PHONES)
def test_a_learner_is_helped_with_a_thumb(open_page: Open, learner: Learner, stage: Stage, size: Json) -> None:
    run, query, translator = test_takeover.failed_in_a_maze(learner)
    stage(learner.served, query, translator)
    page = open_page(f"/work?run={run}", size=size, touch=True, motion="reduce")
    test_takeover.is_here(page, "north")
    assert box_of(page)["width"] >= 240
    tap(page, "south")
    expect(page.get_by_role("button", name="up", exact=True)).to_be_in_viewport(ratio=1)
    page.get_by_role("button", name="north", exact=True).tap()  # before the first step, another choice
    for name in ("up", "up", "up", "Reached", "Send"):
        tap(page, name)
    assert learner.answer_of(query)["segments"] == [{"subgoal": "north", "actions": ["up"] * 3}]
