"""The picture is acted on: by the mouse alone, by touch alone on a phone, and each act has a key that does the same."""

from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect
from tests.browser.access.axe import violations
from tests.browser.conftest import Open
from tests.browser.hands.pointer import Finger, Mouse
from tests.browser.kit import Json, Learner, ask, maze, wait_for_heading, way
from tests.browser.test_narrow import PHONE, too_wide

OpenWith = Callable[[str], tuple[Page, Mouse]]
# The learner's rollout passes five rooms; these are corners of the right way through them.
WAY = ((14, 2), (10, 2), (10, 1), (6, 1), (6, 5), (6, 7), (2, 7), (2, 9))


@pytest.fixture(params=["mouse", "touch"])
def open_with(request: pytest.FixtureRequest, open_page: Open) -> OpenWith:
    """Open a run's work view, with a hand on it."""

    def open_(run: str) -> tuple[Page, Mouse]:
        if request.param == "mouse":
            page = open_page(f"/work?run={run}", motion="reduce")
            return page, Mouse(page)
        page = open_page(f"/work?run={run}", motion="reduce", size=PHONE, touch=True)
        return page, Finger(page)

    return open_


def begin(learner: Learner, open_with: OpenWith, asked: Json) -> tuple[int, Page, Mouse]:
    """Ask a query and wait until it is on the screen."""
    run = learner.create_run("pointing")
    [query] = learner.ask(run, asked)
    page, hand = open_with(run)
    wait_for_heading(page, asked["question"])
    return query, page, hand


def shows(page: Page, words: str) -> None:
    """The player is at a step."""
    expect(page.get_by_role("slider", name="Step")).to_have_attribute("aria-valuetext", words)


@pytest.mark.parametrize("kind", ["inspect_full", "inspect_lo"])
def test_a_click_on_the_path_goes_there_and_inspections_need_no_keys(
    learner: Learner, open_with: OpenWith, kind: str
) -> None:
    query, page, hand = begin(learner, open_with, ask(kind))
    hand.click((6, 2))
    shows(page, f"step 10 of {21 if kind == 'inspect_full' else 13}, action right, subgoal east")
    hand.click((14, 2))
    shows(page, f"step 0 of {21 if kind == 'inspect_full' else 13}, action up, subgoal north")
    hand.click((14, 14))  # nothing is there
    shows(page, f"step 0 of {21 if kind == 'inspect_full' else 13}, action up, subgoal north")
    hand.press("No, it failed")
    assert learner.answer_of(query) == {"kind": kind, "verdict": "fail"}


def test_each_click_on_a_cell_goes_to_the_next_visit(learner: Learner, open_with: OpenWith) -> None:
    _, page, hand = begin(learner, open_with, ask("inspect_full"))
    for step in ("18 of 21, action left", "20 of 21, action right", "18 of 21, action left"):
        hand.click((3, 7))
        shows(page, f"step {step}, subgoal east")


def test_a_segment_is_selected_and_its_subgoal_chosen_on_the_map(learner: Learner, open_with: OpenWith) -> None:
    query, page, hand = begin(learner, open_with, ask("label_hi"))
    current = page.locator("li [aria-current=step]")
    hand.click((5, 6))
    expect(current).to_contain_text("4")
    shows(page, "step 15 of 21, action right, subgoal north")
    hand.click((6, 8))  # lava
    expect(current).to_contain_text("4")
    hand.click((3, 6))
    expect(current).to_contain_text("5")
    hand.click((4, 7))  # the door in the south of its room
    expect(page.get_by_text("1 of 5")).to_be_visible()
    hand.click((14, 2))
    expect(current).to_contain_text("1")
    hand.click((2, 14))  # the target
    expect(current).to_contain_text("2")
    hand.press("Keep the rest, send")
    assert learner.answer_of(query)["subgoals"] == ["go_to_target", "north", "east", "north", "south"]


def test_the_right_way_is_drawn_for_all_segments_and_undone_at_once(learner: Learner, open_with: OpenWith) -> None:
    query, page, hand = begin(learner, open_with, ask("label_hi"))
    hand.draw((10, 1), (6, 1), (6, 5))
    expect(page.get_by_text("2 of 5")).to_be_visible()
    hand.press("Undo label")
    expect(page.get_by_text("0 of 5")).to_be_visible()
    hand.draw(*WAY)
    expect(page.get_by_text("5 of 5")).to_be_visible()
    hand.press("Send answer")
    assert learner.answer_of(query)["subgoals"] == ["north", "north", "north", "north", "east"]


def test_the_right_way_is_drawn_for_the_states_of_a_segment(learner: Learner, open_with: OpenWith) -> None:
    query, page, hand = begin(learner, open_with, ask("label_lo"))
    before = page.evaluate("scrollY")
    hand.draw((8, 1), (7, 1), (7, 3), (6, 3), (6, 5))
    expect(page.get_by_text("4 of 7")).to_be_visible()
    expect(page.get_by_role("button", name="State 7: ")).to_have_attribute("aria-current", "step")
    assert page.evaluate("scrollY") == before, "a finger that draws does not scroll"
    hand.press("Done here")
    hand.draw((6, 1), (6, 3))  # the states that the first way does not pass
    hand.press("Send answer")
    assert learner.answer_of(query) == {
        "kind": "label_lo",
        "actions": ["up", "right", "right", "right", "right", "right"],
        "terminations": [False] * 6 + [True],
    }


def test_the_right_way_is_drawn_through_several_segments(learner: Learner, open_with: OpenWith) -> None:
    query, page, hand = begin(learner, open_with, ask("label_full"))
    hand.draw((14, 2), (10, 2), (10, 1), (6, 1), (6, 4), (6, 6))
    expect(page.get_by_text("13 of 13")).to_be_visible()
    hand.press("Send answer")
    assert learner.answer_of(query)["actions"] == [*["up"] * 4, "left", *["up"] * 4, *["right"] * 4]


def test_a_click_beside_the_agent_labels_nothing(learner: Learner, open_with: OpenWith) -> None:
    _, page, hand = begin(learner, open_with, ask("label_lo"))
    expect(page.get_by_text("0 of 7")).to_be_visible()
    hand.click((9, 1))  # where the agent came from
    shows(page, "step 6 of 13, action up, subgoal north")
    expect(page.get_by_text("0 of 7")).to_be_visible()


def test_a_way_that_is_drawn_while_the_next_question_comes_labels_neither(learner: Learner, open_page: Open) -> None:
    run = learner.create_run("pointing")
    asked = ask("label_lo")
    learner.ask(run, asked, asked | {"ordinal": asked["ordinal"] + 1, "question": "The next question"})
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, asked["question"])
    hand = Mouse(page)
    expect(page.get_by_text("0 of 7")).to_be_visible()
    hand.begin((8, 1), (6, 1))
    page.keyboard.press("Shift+Enter")
    wait_for_heading(page, "The next question")
    hand.end((6, 4))
    shows(page, "step 7 of 13, action up, subgoal east")
    expect(page.get_by_text("0 of 7")).to_be_visible()


def test_a_way_beside_the_path_says_why_nothing_is_labeled(learner: Learner, open_with: OpenWith) -> None:
    _, page, hand = begin(learner, open_with, ask("label_lo"))
    hand.draw((14, 13), (14, 15))
    expect(page.get_by_text("This way passes nothing that the question is about.")).to_be_visible()
    hand.draw((8, 1), (6, 1), (8, 1))  # back at its beginning, it is given up
    expect(page.get_by_text("0 of 7")).to_be_visible()


def test_the_keys_undo_what_was_drawn(learner: Learner, open_with: OpenWith) -> None:
    _, page, hand = begin(learner, open_with, ask("label_lo"))
    for key in ("Control+z", "Backspace"):
        hand.draw((8, 1), (6, 1), (6, 5))
        expect(page.get_by_text("6 of 7")).to_be_visible()
        page.keyboard.press("ArrowDown")  # it changes nothing at the last state
        page.keyboard.press(key)
        expect(page.get_by_text("0 of 7")).to_be_visible()


def test_a_finger_need_not_hit_the_cell_exactly(learner: Learner, open_page: Open) -> None:
    run = learner.create_run("beside")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", motion="reduce", size=PHONE, touch=True)
    wait_for_heading(page, ask("inspect_full")["question"])
    Finger(page).click((14, 2), beside=(-11.5, 0))  # within 24 pixels; the cell has 21
    shows(page, "step 0 of 21, action up, subgoal north")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("kind", ["label_hi", "label_lo"])
def test_on_a_phone_map_and_buttons_are_in_reach_together(
    learner: Learner, open_page: Open, kind: str, scheme: str
) -> None:
    segments = way((14, 2), *[("north", "uuu"), ("south", "ddd")] * 12)
    run = learner.create_run("long")
    learner.ask(run, ask(kind, segments=segments if kind == "label_hi" else segments[:1], context=[], suggestion=None))
    page = open_page(f"/work?run={run}", size=PHONE, touch=True, scheme=scheme)
    wait_for_heading(page, ask(kind)["question"])
    expect(page.locator("canvas")).to_be_in_viewport(ratio=1)
    names = [
        "Keep its choice",
        "Keep the rest, send",
        "Undo label",
        *(["Done here", "First wrong"] if kind == "label_lo" else []),
    ]
    for name in names:
        button = page.get_by_role("button", name=name, exact=False).first
        expect(button).to_be_in_viewport(ratio=1)
        box = button.bounding_box()
        assert box is not None
        assert min(box["width"], box["height"]) >= 24
        button.click(trial=True)  # nothing covers it
    assert too_wide(page) == []
    assert violations(page) == []


def test_a_turn_of_a_conversation_leads_to_its_state(learner: Learner, open_page: Open) -> None:
    vocabulary = {"domain": "talk", "subgoals": ["ask"], "actions": ["say"], "renderer": "talk"}
    run = learner.create_run("talk", vocabulary=vocabulary)
    turns = [{"speaker": "user", "text": "Hello."}, {"speaker": "system", "text": "Where to?"}]
    segment = {"subgoal": "ask", "states": [{"turns": turns[:1]}, {"turns": turns}], "actions": ["say"]}
    learner.ask(run, ask("inspect_full", segments=[segment], instance=maze(), question="Was it polite?"))
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, "Was it polite?")
    expect(page.get_by_text("Where to?")).to_be_visible()
    assert violations(page) == []
    page.get_by_role("button", name="Go there").press("Enter")
    shows(page, "step 0 of 1, action say, subgoal ask")
