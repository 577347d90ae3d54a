"""Review by keyboard: from the filter to the answer, the comment, the way back, and the annotator who reads it."""

import re

from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask, log_in, wait_for_heading
from tests.browser.test_access import violations

from waypost_server.serving import Served

WHY = "The second step east leads into the lava."


def test_an_answer_is_found_sent_back_and_read_by_its_annotator(
    open_page: Open, learner: Learner, served: Served
) -> None:
    run = learner.create_run("to review")
    hi = ask("label_hi")
    first, second, third = learner.ask(run, hi, hi | {"ordinal": 1}, ask("inspect_full", ordinal=2))
    worker = open_page(f"/work?run={run}")
    for query in (first, second):
        heading = worker.locator(f"h1[data-query='{query}']")
        expect(heading).to_be_focused()
        worker.keyboard.press("s")  # south: the learner chose north
        worker.keyboard.press("Shift+Enter")
    expect(worker.locator(f"h1[data-query='{third}']")).to_be_focused()
    worker.keyboard.press("f")
    wait_for_heading(worker, "Waiting for the learner")
    learner.use(second)

    page = open_page("/login", role=None)
    log_in(page.context, served, "learner", "learner")
    page.goto(f"/runs/{run}")
    page.get_by_role("link", name="Review").click()
    shown = page.locator("h2[data-query]")
    expect(shown).to_have_attribute("data-query", str(third))
    page.get_by_label("Differs from").select_option("suggestion")
    expect(page.get_by_text("2 answers to review")).to_be_visible()
    expect(shown).to_have_attribute("data-query", str(second))
    expect(page.get_by_text("The learner has used this answer")).to_be_visible()
    expect(page.get_by_role("button", name="Send back")).to_be_disabled()
    page.get_by_label("Differs from").blur()
    page.keyboard.press("j")
    expect(shown).to_have_attribute("data-query", str(first))
    expect(shown).to_be_focused()
    expect(page).to_have_url(re.compile(rf"disagrees=suggestion&query={first}$"))
    page.keyboard.press("b")
    expect(page.get_by_text("Write what should be different")).to_be_visible()
    expect(page.get_by_role("textbox", name="Comment")).to_be_focused()
    page.keyboard.type(WHY)
    page.keyboard.press("Escape")
    page.keyboard.press("k")
    expect(shown).to_have_attribute("data-query", str(second))
    page.keyboard.press("j")
    expect(page.get_by_role("textbox", name="Comment")).to_have_value(WHY)
    page.keyboard.press("b")
    expect(page.get_by_text("Sent back. The query is open again.")).to_be_visible()
    expect(page.get_by_role("list", name="Comments")).to_contain_text(WHY)
    assert violations(page) == []

    wait_for_heading(worker, hi["question"])
    expect(worker.get_by_role("note")).to_contain_text(WHY)
    assert violations(worker) == []
    worker.goto("/me")
    back = worker.get_by_role("region", name="Answers that came back")
    expect(back).to_contain_text(WHY)
    expect(back).to_contain_text("to review")
    assert violations(worker) == []
