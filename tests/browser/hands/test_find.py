"""The find dialog leads to views, runs and commands by their words, from the keyboard alone."""

import re

from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, wait_for_heading


def test_views_runs_and_commands_are_found_by_their_words(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("the maze of Ada")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("inspect_full")["question"])
    chosen = page.get_by_role("option", selected=True)

    page.keyboard.press("Control+k")
    page.keyboard.type("reason skip")
    expect(chosen).to_contain_text("Skip, with a reason")
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog")).to_contain_text("Skip this question")
    page.keyboard.press("Escape")

    page.keyboard.press("Control+k")
    page.keyboard.type("ada maze")
    expect(page.get_by_role("option")).to_have_count(2)
    page.keyboard.press("ArrowDown")
    expect(chosen).to_contain_text("answer its questions")
    page.keyboard.press("ArrowDown")  # after the last one comes the first
    page.keyboard.press("Enter")
    expect(page).to_have_url(re.compile(rf"/runs/{run}$"))

    page.keyboard.press("Control+k")
    page.keyboard.type("no such thing")
    expect(page.get_by_role("dialog").get_by_role("status")).to_have_text("Nothing has these words.")
    page.keyboard.press("Enter")
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    page.get_by_role("button", name="Find").click()
    page.get_by_role("option", name="Practice").click()
    expect(page).to_have_url(re.compile("/practice"))
