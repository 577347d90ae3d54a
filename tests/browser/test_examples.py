"""Domains with pictures or text in the page: one query of each kind about each is answered with the keyboard alone."""

import re
from typing import Any

import pytest
from playwright.sync_api import Page, expect
from tests.browser.conftest import WIDE, Open
from tests.browser.hands.keyboard import give
from tests.browser.kit import Learner
from tests.examples.kit import DOMAINS
from tests.examples.page import Asked, asked, wait_for
from waypost_dialogue import flight_dialogue

from waypost.domains import find_domain
from waypost_learner.domains.montezuma.env import Instance
from waypost_server.serving import Served

SIZES = {"desktop": WIDE, "tablet": {"width": 768, "height": 1024}}
SEED = 4
INSTANCES: dict[str, Any] = {**dict.fromkeys(DOMAINS, SEED), "montezuma": Instance(noops=SEED)}


def expect_picture(page: Page, _: Asked) -> None:
    """The page shows a picture of the state."""
    expect(page.locator("img.shown")).to_be_visible()
    page.wait_for_function("() => document.querySelector('img.shown')?.naturalWidth >= 160")  # it has arrived


def expect_conversation(page: Page, one: Asked) -> None:
    """The page shows the turns of the last state, each with its speaker, and the last one is in view."""
    if one.ask.kind == "hier_demo":
        expect_turns(page, one.ask.state)
    else:
        page.keyboard.press("End")
        expect_turns(page, one.ask.segments[-1].states[-1])
        page.keyboard.press("Home")


def expect_turns(page: Page, state: Any) -> None:
    turns = page.get_by_role("list", name="Conversation").get_by_role("listitem")
    expect(turns).to_have_count(len(state["turns"]))
    for n, turn in enumerate(state["turns"]):
        expect(turns.nth(n)).to_contain_text(turn["speaker"])
        expect(turns.nth(n)).to_contain_text(turn["text"])
    expect(turns.last).to_be_in_viewport()
    rest = page.get_by_label("The rest of the state")
    expect(rest).to_have_text(re.compile(rf"useless\s*{state['useless']}"))
    expect(rest).to_be_in_viewport()


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("place", INSTANCES)
def test_one_query_of_each_kind_is_answered_with_the_keyboard_alone(
    open_page: Open, learner: Learner, served: Served, place: str, size: str
) -> None:
    domain = find_domain(place)
    expect_state = expect_conversation if domain is flight_dialogue else expect_picture
    with asked(served, domain, INSTANCES[place]) as queries:
        page = open_page(f"/work?run={queries[0].run}", size=SIZES[size])
        for one in queries:
            wait_for(page, one)
            if one.ask.kind == "hier_demo":
                page.locator("[data-stage=here]").wait_for()
            expect_state(page, one)
            give(page, one.right)
            answer = learner.answer_of(one.query)
            if one.ask.kind == "hier_demo":  # with it is what the annotator saw
                steps = sum(len(segment["actions"]) for segment in answer["segments"])
                assert len(answer["replay"]["states"]) == steps + 1
                answer["replay"] = None
            assert answer == one.stored


def test_new_turns_of_a_conversation_are_marked(open_page: Open, served: Served) -> None:
    with asked(served, flight_dialogue, SEED) as queries:
        page = open_page(f"/work?run={queries[0].run}")
        wait_for(page, queries[0])
        expect(page.get_by_text("· new")).to_have_count(0)
        give(page, queries[0].right)
        wait_for(page, queries[1])
        page.keyboard.press("End")
        expect(page.get_by_text("system · new")).to_have_count(1)
        expect(page.get_by_text("user · new")).to_have_count(1)
        for one in queries[1:]:
            wait_for(page, one)
            give(page, one.right)
