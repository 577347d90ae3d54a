"""On a phone, the buttons that play a demonstration are under the thumb: nobody scrolls to make a move."""

import pytest
from playwright.sync_api import Page, WebSocketRoute, expect
from tests.browser import test_takeover
from tests.browser.conftest import WIDE, Open, Stage
from tests.browser.hands.pointer import Finger, Mouse, box_of
from tests.browser.kit import MOVES as WAYS
from tests.browser.kit import START, Json, Learner, wait_for_heading
from tests.browser.kit import ask as question
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
    box = box_of(page)
    assert box["width"] >= 240
    for number, (segment, (_, steps)) in enumerate(zip(SEGMENTS, WAY, strict=True)):
        tap(page, str(segment["subgoal"]).replace("_", " "))
        for step in steps:
            assert box_of(page) == box  # or else a finger on the map would lead the agent astray
            tap(page, MOVES[step])
        if number + 1 < len(WAY):
            tap(page, "Reached")
    expect(page.get_by_text("The task is accomplished. Send the demonstration.")).to_be_in_viewport()
    assert page.evaluate("scrollY") == 0
    send(page)
    assert learner.answer_of(query)["segments"] == SEGMENTS


@pytest.mark.parametrize(("hand", "size"), [(Mouse, WIDE), (Finger, PHONES[0])])
def test_a_demonstration_is_played_on_the_map(
    open_page: Open, learner: Learner, stage: Stage, hand: type[Mouse], size: Json
) -> None:
    run = learner.create_run("on the map")
    [query] = learner.ask(run, ask())
    stage(learner.served, query)
    page = open_page(f"/work?run={run}", size=size, touch=hand is Finger)
    is_here(page)
    on, cell = hand(page), START
    for number, (segment, (_, steps)) in enumerate(zip(SEGMENTS, WAY, strict=True)):
        on.press(str(segment["subgoal"]).replace("_", " "))
        cells = [cell]
        for step in steps:
            cells.append((cells[-1][0] + WAYS[MOVES[step]][0], cells[-1][1] + WAYS[MOVES[step]][1]))
        if number % 2:
            on.draw(*cells)
        else:
            for one in cells[1:]:
                on.click(one)
        cell = cells[-1]
        expect(page.get_by_role("list", name="Segments played").get_by_role("listitem").last).to_contain_text(
            f"{len(steps)} step"
        )
        if number + 1 < len(WAY):
            on.press("Reached")
    send(page)
    assert learner.answer_of(query)["segments"] == SEGMENTS


def test_the_agent_is_led_further_than_the_environment_has_answered(
    open_page: Open, learner: Learner, stage: Stage
) -> None:
    run = learner.create_run("slow environment")
    [query] = learner.ask(run, ask())
    stage(learner.served, query)
    page = open_page("/practice")
    held: list[tuple[WebSocketRoute, str | bytes]] = []
    holds = False

    def slow(page_side: WebSocketRoute) -> None:
        server = page_side.connect_to_server()
        page_side.on_message(server.send)
        server.on_message(lambda news: held.append((page_side, news)) if holds else page_side.send(news))

    page.route_web_socket("**/play**", slow)
    page.goto(f"/work?run={run}")
    is_here(page)
    hand = Mouse(page)
    hand.press("north")
    holds = True
    hand.draw(START, (START[0] - 3, START[1]))
    expect(page.get_by_role("list", name="Segments played")).to_contain_text("3 steps")
    holds = False
    for page_side, news in held:
        page_side.send(news)
    hand.press("Reached")
    hand.press("Send")
    page.get_by_role("button", name="Send it anyway").click()
    assert learner.answer_of(query)["segments"] == [{"subgoal": "north", "actions": ["up"] * 3}]


def test_buttons_show_no_keys_where_there_is_no_keyboard(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("no keys")
    learner.ask(run, question("label_hi"))
    for touch in (True, False):
        page = open_page(f"/work?run={run}", size={"width": 768, "height": 1024}, touch=touch)
        wait_for_heading(page, question("label_hi")["question"])
        shown = [cap for cap in page.locator(".button kbd").all() if cap.is_visible()]
        assert bool(shown) is not touch
        page.goto("/login")  # so that the question is free again


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
