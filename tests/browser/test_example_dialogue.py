"""The dialogue example in the page: states read as a conversation, and every kind of query is answered by keyboard."""

import re
from typing import Any

import pytest
from playwright.sync_api import Page, expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner
from tests.browser.test_access import violations
from tests.examples.page import asked, give, wait_for
from waypost_dialogue import flight_dialogue

from waypost_server.serving import Served

SEED = 4
TABLET = {"width": 768, "height": 1024}


def expect_turns(page: Page, state: Any) -> None:
    """The page shows the turns of a state, each with its speaker, and the last one is in view."""
    turns = page.get_by_role("list", name="Conversation").get_by_role("listitem")
    expect(turns).to_have_count(len(state["turns"]))
    for n, turn in enumerate(state["turns"]):
        expect(turns.nth(n)).to_contain_text(turn["speaker"])
        expect(turns.nth(n)).to_contain_text(turn["text"])
    expect(turns.last).to_be_in_viewport()
    rest = page.get_by_label("The rest of the state")
    expect(rest).to_have_text(re.compile(rf"useless\s*{state['useless']}"))
    expect(rest).to_be_in_viewport()


@pytest.mark.parametrize("size", [{"width": 1440, "height": 900}, TABLET], ids=["desktop", "tablet"])
def test_every_kind_of_query_is_answered_with_the_keyboard(
    open_page: Open, learner: Learner, served: Served, size: dict[str, int]
) -> None:
    with asked(served, flight_dialogue, SEED) as queries:
        page = open_page(f"/work?run={queries[0].run}", size=size)
        for one in queries:
            wait_for(page, one)
            if one.ask.kind == "hier_demo":
                expect_turns(page, one.ask.state)
            else:
                page.keyboard.press("End")
                expect_turns(page, one.ask.segments[-1].states[-1])
                page.keyboard.press("Home")
            assert violations(page) == [], one.ask.kind
            give(page, one)
            assert learner.answer_of(one.query) == one.stored


def test_new_turns_are_marked(open_page: Open, served: Served) -> None:
    with asked(served, flight_dialogue, SEED) as queries:
        page = open_page(f"/work?run={queries[0].run}")
        wait_for(page, queries[0])
        expect(page.get_by_text("· new")).to_have_count(0)
        give(page, queries[0])
        wait_for(page, queries[1])
        page.keyboard.press("End")
        expect(page.get_by_text("system · new")).to_have_count(1)
        expect(page.get_by_text("user · new")).to_have_count(1)
        for one in queries[1:]:
            wait_for(page, one)
            give(page, one)
