"""Somebody new sees how a demonstration is given before the first question asks for one, in the domain of the run."""

import json
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect
from tests.browser.access.axe import violations_in_every_look
from tests.browser.conftest import Open
from tests.browser.hands.pointer import Finger
from tests.browser.kit import Json, wait_for_heading
from tests.browser.test_narrow import PHONE, too_wide

from waypost.domains import find_domain
from waypost_learner.experts.practice import practice
from waypost_server import serving
from waypost_server.gold.practice import SHIPPED
from waypost_server.serving import Served
from waypost_server.settings import Settings

WHOLE = "Do the whole task yourself, one subgoal after the other."
PLAY_ON = re.compile("^It failed at “.*”. Play on from here, until a subgoal is reached.$")


def moves(page: Page) -> Locator:
    """The rows of the example."""
    return page.get_by_role("list", name="Moves").get_by_role("button")


def go_to_demonstrations(page: Page) -> None:
    """Skip all questions of the first practice."""
    example, skip = page.get_by_text("Worked example"), page.get_by_role("button", name="Skip", exact=True)
    example.or_(skip).wait_for()
    kinds = page.get_by_role("progressbar", name="Questions answered").get_attribute("max")
    for _ in range(int(kinds or 0)):
        if example.is_visible():
            page.keyboard.press("Enter")
        skip.wait_for()
        page.keyboard.press("Shift+S")
    wait_for_heading(page, WHOLE)


@contextmanager
def serving_practice(page: Path, folder: Path, content: Json) -> Iterator[Served]:
    file = folder / "practice.json"
    file.write_text(json.dumps(content))
    with serving.background(Settings(database=f"sqlite:///{folder / 'it.db'}", page=page, practice=(file,))) as served:
        yield served


def test_each_move_is_shown_with_its_key_and_the_reason(empty: Served, open_page: Open) -> None:
    page = open_page("/practice?first=yes", at=empty, motion="reduce")
    go_to_demonstrations(page)
    own = json.loads(SHIPPED.read_text())["demonstrations"][0]["answer"]["segments"]
    first = own[0]["subgoal"]
    expect(moves(page)).to_have_count(3 * len(own))  # the episode ends the last segment, and it is sent
    letter = first[0].upper()
    expect(moves(page).nth(0)).to_have_accessible_name(f"{letter} Choose {letter} {first}")
    expect(moves(page).nth(1)).to_contain_text(f"{len(own[0]['actions'])} steps")
    expect(moves(page).nth(2)).to_contain_text("↵ Reached")
    expect(moves(page).last).to_contain_text("↵ Send")
    status = page.locator(".panel").get_by_role("status")
    expect(status).to_contain_text("First choose the subgoal.")
    for words in (f"Move toward “{first}”.", "Say so in the first state", "Choose the next subgoal"):
        page.keyboard.press("ArrowDown")
        expect(status).to_contain_text(words)
    moves(page).last.click()
    expect(status).to_contain_text("The task is accomplished. Send the demonstration.")
    page.keyboard.press("Enter")
    wait_for_heading(page, PLAY_ON)
    expect(moves(page).nth(0)).to_contain_text("The learner failed at")
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="0 of 5 right")).to_be_visible()


def test_it_plays_once_by_itself_and_waits_when_told_to(empty: Served, open_page: Open) -> None:
    page = open_page("/practice?first=yes", at=empty)
    go_to_demonstrations(page)
    expect(moves(page).nth(1)).to_have_attribute("aria-current", "step")
    page.keyboard.press("Space")
    expect(page.get_by_role("button", name="Play", exact=True)).to_be_visible()
    page.get_by_role("button", name="Play", exact=True).click()
    page.get_by_role("button", name="Play again").wait_for(timeout=60_000)
    expect(moves(page).last).to_have_attribute("aria-current", "step")


def without_pictures(content: Json) -> Json:
    """The practice of a domain whose states are shown as text."""
    asks = [one["ask"] for one in content["exercises"] + content["demonstrations"]]
    shown = [one for ask in asks for one in (*ask.get("segments", ()), *ask["context"])]
    for one in shown + [one["answer"]["replay"] for one in content["demonstrations"]]:
        one |= {"frames": [], "landmarks": []}
    return content | {"frames": []}


def as_it_is(content: Json) -> Json:
    return content


@pytest.mark.parametrize(("made", "shown"), [(as_it_is, "img.shown"), (without_pictures, ".stage dd >> nth=0")])
def test_it_is_shown_in_pictures_or_as_text(
    built_page: Path, tmp_path: Path, open_page: Open, made: Callable[[Json], Json], shown: str
) -> None:
    content = made(json.loads(practice(find_domain("corridor"), "random", seed=0)))
    with serving_practice(built_page, tmp_path, content) as served:
        page = open_page("/practice?first=yes", at=served, motion="reduce")
        go_to_demonstrations(page)
        seen = []
        for _ in range(3):
            one = page.locator(shown)
            seen.append(one.get_attribute("src") if shown.startswith("img") else one.inner_text())
            page.keyboard.press("ArrowDown")
        assert seen[0] != seen[1] == seen[2], "steps lead to another state, in which the subgoal is reached"


def test_it_is_read_by_everybody_on_every_screen(empty: Served, open_page: Open) -> None:
    page = open_page("/practice?first=yes", at=empty, motion="reduce", size=PHONE, touch=True)
    go_to_demonstrations(page)
    assert too_wide(page) == []
    Finger(page).press("Next example")
    wait_for_heading(page, PLAY_ON)
    assert too_wide(page) == []
    assert violations_in_every_look(page) == []
