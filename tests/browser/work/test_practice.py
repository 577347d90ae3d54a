"""Practice is about what a person will be asked, and worked examples show a learner's mistakes."""

import re
from collections.abc import Iterator
from contextlib import closing

import pytest
from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import VOCABULARY, Json, Learner, ask, login_link, wait_for_heading

from waypost.client import Client
from waypost_learner.domains.corridor import CorridorDomain
from waypost_learner.remote.translation import vocabulary
from waypost_learner.runs.practice import send_practice
from waypost_server.auth import tokens
from waypost_server.serving import Served
from waypost_server.users import service as users

SIZES = [{"width": 1440, "height": 900}, {"width": 768, "height": 1024}, {"width": 390, "height": 844}]


@pytest.mark.parametrize("size", SIZES)
def test_every_worked_example_has_a_mistake(open_page: Open, empty: Served, size: Json) -> None:
    page = open_page("/practice?first=yes", at=empty, size=size, motion="reduce")
    page.get_by_text("Worked example").wait_for()
    kinds = page.get_by_role("progressbar", name="Questions answered").get_attribute("max")
    for _ in range(int(kinds or 0)):  # those that runs on the server ask
        page.get_by_text("Worked example").wait_for()
        corrected = page.get_by_role("button", name=re.compile("no, it failed|instead of")).first
        expect(corrected).to_have_attribute("aria-current", "step")
        expect(corrected).to_be_in_viewport(ratio=0.9)
        page.keyboard.press("Enter")
        page.get_by_role("button", name="Skip").first.wait_for()
        page.keyboard.press("Shift+S")


def test_on_a_tablet_the_bar_is_in_the_window(open_page: Open, empty: Served) -> None:
    page = open_page("/practice?first=yes", at=empty, size=SIZES[1])
    page.get_by_text("Worked example").wait_for()
    expect(page.get_by_role("button", name="Skip the practice")).to_be_in_viewport(ratio=1)


@pytest.fixture
def own(empty: Served) -> Iterator[Learner]:
    """The learner's side of a server that has no run yet."""
    learner = Learner(empty)
    yield learner
    learner.close()


def test_the_first_login_leads_to_practice_in_the_domain_of_the_run(
    open_page: Open, empty: Served, own: Learner
) -> None:
    corridor = CorridorDomain()
    run = own.create_run("corridor", vocabulary=vocabulary(corridor).model_dump())
    user = empty.db.write_now(lambda tx: users.ensure_user(tx, "learner", "learner"))
    token = empty.db.write_now(lambda tx: tokens.create_token(tx, user.id, "practice")).token
    with closing(Client(empty.url, token)) as client:
        assert send_practice(client, run, corridor, "random") is None
    page = open_page(login_link(empty, "newcomer", "annotator").removeprefix(empty.url), role=None, at=empty)
    for _ in range(5):  # kinds
        page.get_by_text("Worked example").wait_for()
        expect(page.locator("img.shown")).to_be_visible()
        page.keyboard.press("Enter")
        page.get_by_role("button", name="Skip", exact=True).wait_for()
        page.keyboard.press("Shift+S")
    page.goto("/practice")
    expect(page.get_by_text("10 questions about “corridor”")).to_be_visible()
    expect(page.get_by_role("radio")).to_have_count(0)
    page.keyboard.press("Enter")
    wait_for_heading(page, "Did it do the whole task?")
    page.keyboard.press("y")
    page.get_by_role("heading", name="Right", exact=True).wait_for()


def test_nobody_is_offered_questions_about_another_domain(open_page: Open, empty: Served, own: Learner) -> None:
    dialogue = VOCABULARY | {"domain": "dialogue", "renderer": "none"}
    run = own.create_run("dialogue", vocabulary=dialogue)
    own.ask(run, ask("inspect_full"))
    page = open_page("/practice", at=empty)
    expect(page.get_by_role("heading", name="No practice for these questions")).to_be_visible()
    expect(page.get_by_text("maze")).to_have_count(0)
    own.create_run("maze")
    page.reload()
    expect(page.get_by_text("questions about “maze”")).to_be_visible()
    page.goto(f"/practice?first=yes&run={run}")  # whose login link names this run
    wait_for_heading(page, ask("inspect_full")["question"])
    assert page.url.endswith(f"/work?run={run}")
