"""After an answer, a toast says what was answered and takes it back: by mouse, by finger, and by keyboard."""

import pytest
from playwright.sync_api import Page, expect
from tests.browser.conftest import WIDE, Open
from tests.browser.hands.pointer import Finger, Mouse
from tests.browser.kit import Json, Learner, ask, wait_for_heading, wait_for_question

FIRST, SECOND = ask("inspect_full"), ask("label_hi", ordinal=1)
PHONE = {"width": 390, "height": 844}
COVERED = """() => {
  const toast = document.querySelector('.toast').getBoundingClientRect()
  const needed = 'h1, main button, main input, main canvas, .panel li, header a, header button'
  const bar = document.querySelector('main footer').getBoundingClientRect()
  const end = bar.height > 0 ? bar.top : innerHeight
  const seen = (one, box) => {
    const part = one.closest('.scroll')?.getBoundingClientRect() ?? { top: 0, bottom: end }
    return { top: Math.max(box.top, part.top), bottom: Math.min(box.bottom, part.bottom, end) }
  }
  return [...document.querySelectorAll(needed)]
    .filter((one) => {
      const box = one.getBoundingClientRect()
      const { top, bottom } = seen(one, box)
      const isBeside = box.left >= toast.right || toast.left >= box.right
      return top < bottom && !isBeside && top < toast.bottom && toast.top < bottom
    })
    .map((one) => one.outerHTML.slice(0, 80))
}"""  # what the toast covers of all that is seen beside the status bar


def answered(learner: Learner, page: Page, run: str) -> int:
    """Answer the first of two questions of a run with the keyboard; return its number."""
    first, second = learner.ask(run, FIRST, SECOND)
    page.goto(f"/work?run={run}")
    wait_for_question(page, first)
    page.keyboard.press("f")
    wait_for_question(page, second)  # the toast has not taken the focus
    page.locator(".toast").wait_for()
    return first


@pytest.mark.parametrize("by", ["mouse", "touch", "keyboard"])
def test_an_answer_is_taken_back_from_the_toast(open_page: Open, learner: Learner, by: str) -> None:
    page = open_page("/login", touch=by == "touch", size=PHONE if by == "touch" else WIDE)
    first = answered(learner, page, learner.create_run("toast"))
    expect(page.get_by_role("group", name="Your last answer")).to_contain_text("Answered: no, it failed.")
    learner.answer_of(first)
    if by == "keyboard":
        page.get_by_role("button", name="Take it back").press("Enter")
    else:
        (Finger if by == "touch" else Mouse)(page).press("Take it back")
    wait_for_heading(page, FIRST["question"])
    expect(page.get_by_role("group", name="Your last answer")).to_have_count(0)
    page.keyboard.press("p")
    expect(page.get_by_role("group", name="Your last answer")).to_contain_text("Answered: yes, it worked.")
    assert learner.answer_of(first)["verdict"] == "pass"


def test_the_toast_is_dismissed_or_waits_while_it_is_read(open_page: Open, learner: Learner) -> None:
    page = open_page("/login")
    page.clock.install()
    answered(learner, page, learner.create_run("patient toast"))
    toast = page.get_by_role("group", name="Your last answer")
    page.clock.run_for(19_000)
    toast.get_by_role("button", name="Dismiss").focus()
    page.clock.run_for(60_000)
    expect(toast).to_be_visible()
    page.keyboard.press("Enter")
    expect(toast).to_have_count(0)
    expect(page.get_by_role("heading", name=SECOND["question"])).to_be_focused()
    page.keyboard.press("Shift+Enter")
    expect(toast).to_contain_text("5 labels sent.")
    page.clock.run_for(21_000)
    expect(toast).to_have_count(0)


SIZES = [WIDE, {"width": 768, "height": 1024}, PHONE, {"width": 390, "height": 664}, {"width": 844, "height": 390}]


@pytest.mark.parametrize("role", ["annotator", "admin"])
@pytest.mark.parametrize("locale", ["en-US", "de-DE"])
@pytest.mark.parametrize("size", SIZES)
def test_the_toast_covers_nothing_that_is_needed(
    open_page: Open, learner: Learner, size: Json, locale: str, role: str
) -> None:
    page = open_page("/login", size=size, locale=locale, role=role)
    answered(learner, page, learner.create_run("toast and buttons"))
    assert page.evaluate(COVERED) == []
    expect(page.locator(".toast [aria-keyshortcuts=U]")).to_be_in_viewport(ratio=1)
