"""Actions on pictures and texts: what is asked about an action is answered where it leads, by mouse or touch alone."""

from collections.abc import Callable, Iterator

import pytest
from playwright.sync_api import Page, expect
from tests.browser import test_play
from tests.browser.access.axe import violations, violations_in_every_look
from tests.browser.conftest import WIDE, Open, Stage
from tests.browser.hands.pointer import CORRIDOR, Finger, Mouse
from tests.browser.kit import Json, Learner, ask, wait_for_heading
from tests.browser.test_narrow import PHONE, too_wide
from tests.browser.test_pictures import agents_cell, ask_with_pictures, client_of

from waypost.trajectory import Trajectory
from waypost_learner.algorithms.queries import HierDemo, LabelFull, LabelLo, Query
from waypost_learner.domains.corridor import CorridorDomain
from waypost_learner.remote.translation import vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_server.serving import Served

QUESTION = "It tried “west”. What should it have done at each step?"
ACTS = ["say_hello", "ask_city", *(f"tell_about_{what}" for what in ("flights", "prices", "hotels", "the_weather"))]
TALK = {"domain": "talk", "subgoals": ["ask", "offer"], "actions": ACTS, "renderer": "talk"}

OpenWith = Callable[[str], tuple[Page, Mouse]]


@pytest.fixture(autouse=True)
def finish(learner: Learner) -> Iterator[None]:
    """Leave no run behind whose domain has no practice: other tests share the server."""
    yield
    learner.finish_all()


@pytest.fixture(params=["mouse", "touch"])
def open_with(request: pytest.FixtureRequest, open_page: Open) -> OpenWith:
    """Open a run's work view, with a hand on it."""

    def open_(run: str) -> tuple[Page, Mouse]:
        if request.param == "mouse":
            page = open_page(f"/work?run={run}", motion="reduce")
            return page, Mouse(page, CORRIDOR)
        page = open_page(f"/work?run={run}", motion="reduce", size=PHONE, touch=True)
        return page, Finger(page, CORRIDOR)

    return open_


def begin(
    served: Served, open_with: OpenWith, query_of: Callable[[Trajectory], Query] | None = None
) -> tuple[int, Page, Mouse]:
    """Ask about the learner's way to the west, over the cells 4, 3, 2 and 1."""
    with client_of(served) as client:
        query, run = ask_with_pictures(client, query_of or (lambda sigma: LabelLo(sigma[1], sigma[:1])))
    page, hand = open_with(run)
    page.locator("img.shown").wait_for()
    return query, page, hand


def shows(page: Page, cell: int) -> None:
    """The picture shows the agent there."""
    page.wait_for_function(f"() => document.querySelector('img.shown').alt.includes('step {6 - cell} of')")
    assert agents_cell(page) == cell


def test_each_state_of_a_picture_is_labeled_by_a_click_where_the_right_action_leads(
    served: Served, learner: Learner, open_with: OpenWith
) -> None:
    query, page, hand = begin(served, open_with)
    wait_for_heading(page, QUESTION)
    shows(page, 4)
    hand.click((0, 3))
    shows(page, 3)
    hand.click((0, 4))
    shows(page, 2)
    hand.click((0, 7))  # nothing is there
    shows(page, 2)
    hand.click((0, 1))
    shows(page, 1)
    expect(page.get_by_role("list", name="Places of actions")).to_have_count(0)  # the last state needs no action
    hand.press("Done here")
    assert too_wide(page) == []
    hand.press("Send answer")
    answer = learner.answer_of(query)
    assert answer["actions"] == ["west", "east", "west"]
    assert answer["terminations"] == [False, False, False, True]


def test_the_right_way_is_drawn_through_the_boxes_and_undone_at_once(
    served: Served, learner: Learner, open_with: OpenWith
) -> None:
    query, page, hand = begin(served, open_with)
    hand.draw((0, 4), (0, 1))
    expect(page.get_by_text("3 of 4")).to_be_visible()
    shows(page, 1)
    hand.press("Undo label")
    expect(page.get_by_text("0 of 4")).to_be_visible()
    hand.draw((0, 4), (0, 3), (0, 5))  # it turns back where the learner went on
    expect(page.get_by_text("2 of 4")).to_be_visible()
    shows(page, 2)
    hand.press("Done here")
    hand.press("Send answer")
    assert learner.answer_of(query)["actions"] == ["west", "east", None]


def test_a_way_goes_on_through_several_segments(served: Served, learner: Learner, open_with: OpenWith) -> None:
    query, page, hand = begin(served, open_with, LabelFull)
    hand.draw((0, 2), (0, 4), (0, 1), (0, 3))
    expect(page.get_by_text("7 of 7", exact=True)).to_be_visible()
    hand.press("Send answer")
    assert learner.answer_of(query)["actions"] == ["east"] * 2 + ["west"] * 3 + ["east"] * 2


def test_a_way_that_is_drawn_while_the_next_question_comes_labels_neither(served: Served, open_page: Open) -> None:
    with client_of(served) as client:
        query, run = ask_with_pictures(client, lambda sigma: LabelLo(sigma[1], sigma[:1]))
        asked = client.query(query).ask
        client.ask(run, [asked.model_copy(update={"ordinal": 1, "question": "The next question"})])
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, QUESTION)
    page.locator("img.shown").wait_for()
    hand = Mouse(page, CORRIDOR)
    hand.begin((0, 4), (0, 2))
    page.keyboard.press("Shift+Enter")
    wait_for_heading(page, "The next question")
    hand.end((0, 1))
    shows(page, 4)
    expect(page.get_by_text("0 of 4")).to_be_visible()


def test_a_box_says_which_action_it_means(served: Served, open_page: Open) -> None:
    with client_of(served) as client:
        _, run = ask_with_pictures(client, lambda sigma: LabelLo(sigma[1], sigma[:1]))
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, QUESTION)
    places = page.get_by_role("list", name="Places of actions").get_by_role("listitem")
    expect(places).to_have_count(2)
    hand = Mouse(page, CORRIDOR)
    page.mouse.move(*hand.point((0, 5)))
    expect(places.filter(has_text="east")).to_have_count(1)
    page.mouse.move(*hand.point((0, 3)))
    expect(places.filter(has_text="east")).to_have_count(0)
    expect(places.filter(has_text="west")).to_contain_text("•")  # so did the learner
    expect(page.get_by_role("list", name="Legend")).to_contain_text("where an action leads")
    expect(page.get_by_text("or drag along the right way.")).to_be_visible()
    assert violations_in_every_look(page) == []


def test_keys_go_on_working_after_a_click_in_a_box(served: Served, learner: Learner, open_page: Open) -> None:
    with client_of(served) as client:
        query, run = ask_with_pictures(client, lambda sigma: LabelLo(sigma[1], sigma[:1]))
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, QUESTION)
    Mouse(page, CORRIDOR).click((0, 5))
    page.keyboard.press("2")
    expect(page.get_by_text("2 of 4")).to_be_visible()
    page.keyboard.press("Shift+Enter")
    assert learner.answer_of(query)["actions"] == ["east", "east", "west"]


@pytest.mark.parametrize("flat", [False, True])
def test_a_demonstration_is_played_on_the_picture(
    learner: Learner, stage: Stage, open_with: OpenWith, flat: bool
) -> None:
    run = learner.create_run("boxes of moves", vocabulary=vocabulary(CorridorDomain()).model_dump())
    translator = test_play.CORRIDOR
    demo = HierDemo(Simulator(translator.domain).reset(translator.instance), flat)
    [query] = learner.ask(run, translator.ask(demo, 0, 0).model_dump())
    stage(learner.served, query, translator)
    page, hand = open_with(run)
    page.locator("[data-stage=here]").wait_for()
    if not flat:
        expect(page.get_by_role("list", name="Places of actions")).to_have_count(0)
        hand.click((0, 4))  # the door in the east
    for cell in (4, 5, 6):
        hand.click((0, cell))
        page.wait_for_function(f"() => document.querySelector('img.shown').alt.includes('step {cell - 3} of')")
        if cell == 4 and not flat:
            hand.press("Reached")
            hand.click((0, 6))  # the target
    expect(page.get_by_text("The task is accomplished. Send the demonstration.")).to_be_visible()
    hand.press("Send")
    answer = learner.answer_of(query)
    segments = [(one["subgoal"], one["actions"]) for one in answer["segments"]]
    assert segments == ([(None, ["east"] * 3)] if flat else [("east", ["east"]), ("target", ["east", "east"])])
    assert len(answer["replay"]["action_landmarks"]) == 4


def said(*texts: str) -> Json:
    """A state of a conversation."""
    return {"turns": [{"speaker": "user", "text": text} for text in texts]}


@pytest.mark.parametrize("size", [WIDE, PHONE])
@pytest.mark.parametrize("states", [[said("Hi."), said("Hi.", "Bye.")], [[1, 2], [3, 4]]])
def test_a_state_shown_as_text_has_its_choices_below_it(
    learner: Learner, open_page: Open, states: list[Json], size: dict[str, int]
) -> None:
    run = learner.create_run("talk", vocabulary=TALK)
    segment = {"subgoal": "ask", "states": states, "actions": ["say_hello"]}
    first, second = learner.ask(
        run,
        ask("label_lo", segments=[segment], context=[], suggestion=None, question="What should it say?"),
        ask("label_hi", 1, segments=[segment], context=[], suggestion=None, question="What should it try?"),
    )
    page = open_page(f"/work?run={run}", size=size, touch=size == PHONE, motion="reduce")
    wait_for_heading(page, "What should it say?")
    stage = page.locator(".stage")
    expect(stage.get_by_text("The right action here")).to_be_in_viewport()
    expect(stage.get_by_text("say hello •")).to_be_in_viewport()  # so did the learner
    assert violations(page) == []
    assert too_wide(page) == []
    stage.get_by_text("ask city").click()
    expect(page.get_by_text("1 of 2")).to_be_visible()
    expect(stage.get_by_text("The right action here")).to_have_count(0)  # the last state needs none
    page.get_by_role("button", name="Not done").click()
    page.get_by_role("button", name="Send answer").click()
    assert learner.answer_of(first)["actions"] == ["ask_city"]
    wait_for_heading(page, "What should it try?")
    stage.get_by_text("offer").click()
    page.get_by_role("button", name="Send answer").click()
    assert learner.answer_of(second)["subgoals"] == ["offer"]
