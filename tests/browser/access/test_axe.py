"""Everybody can use it: axe finds nothing in any view or state, light and dark, on a desktop, a tablet and a phone."""

import pytest
from playwright.sync_api import Page, expect
from tests.browser import test_play, test_takeover
from tests.browser.access.axe import violations_in_every_look
from tests.browser.conftest import Open, Stage
from tests.browser.hands.keyboard import give
from tests.browser.kit import Complaints, Learner, ask, begun_run, wait_for_heading
from tests.examples.page import asked, wait_for

from waypost.domains import find_domain
from waypost_server.serving import Served

KINDS = ("inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")
# The views of an experimenter at addresses of their own, and the heading or another part that says that they are there.
WATCHED = {
    "": "Success on unseen instances",
    "/queries": "Inspect_FULL",
    "/ledger": "Inspect_FULL",
    "/review": "Agreement",
    "/gold": "Gold queries of",
}


def check(page: Page, view: str) -> None:
    """Axe finds nothing in a view."""
    assert violations_in_every_look(page) == [], view


def dialog(page: Page, name: str, *keys: str) -> None:
    """A dialog that keys or a button open; afterwards it is closed."""
    if keys:
        page.keyboard.press(keys[0])
    else:
        page.get_by_role("button", name=name).first.click()
    page.get_by_role("dialog").wait_for()
    check(page, name)
    page.keyboard.press("Escape")
    page.get_by_role("dialog").wait_for(state="detached")


def test_questions_and_their_dialogs(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("access", budget=500.0)
    learner.ask(run, *[ask(kind, ordinal=ordinal) for ordinal, kind in enumerate(KINDS)])
    page = open_page(f"/work?run={run}", role="admin", motion="reduce")
    for kind in KINDS:
        wait_for_heading(page, ask(kind)["question"])
        if kind.startswith("label"):
            page.keyboard.press("Enter")
            page.keyboard.press("2")
        if kind == "label_lo":
            page.keyboard.press(".")
            page.keyboard.press("d")
        check(page, kind)
        if kind == "label_hi":
            for key, name in (("?", "Keys"), ("Shift+S", "Skip"), ("Control+k", "Find")):
                dialog(page, name, key)
        page.keyboard.press("f" if "inspect" in kind else "Shift+Enter")
    wait_for_heading(page, "No question right now")
    expect(page.get_by_text("The learner is training on the answers.")).to_be_visible()
    expect(page.get_by_text("The next question appears here")).to_be_visible()
    check(page, "waiting")


def test_work_without_a_server_a_session_or_the_right(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    for complaint in ("net::ERR_FAILED", "401", "403", "404"):
        complaints.expect(complaint)
    run = learner.create_run("trouble")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", intercepted=True)
    wait_for_heading(page, ask("inspect_full")["question"])
    page.route("**/api/**", lambda route: route.abort())
    page.keyboard.press("f")
    wait_for_heading(page, "The server cannot be reached")
    page.get_by_text("1 answer kept here").wait_for()
    check(page, "offline, with an answer that is not saved")
    page = open_page("/work", role="viewer")
    wait_for_heading(page, "This account cannot answer questions")
    check(page, "refused")
    page.goto("/people")
    page.get_by_role("heading", name="Your account may not see this").wait_for()
    check(page, "people, refused")
    page.goto("/runs/none-such")
    page.get_by_role("heading", name="There is no such run").wait_for()
    check(page, "no such run")
    page = open_page("/work", role=None)
    wait_for_heading(page, "You are not signed in")
    check(page, "signed out")
    for path, heading in (
        ("/login", "Sign in with a link"),
        ("/login#no-such-code", "This login link"),
        ("/me", "You are not signed in"),
        ("/runs", "Runs"),
        ("/nowhere", "There is nothing at this address"),
    ):
        page.goto("about:blank")
        page.goto(path)
        page.get_by_role("heading", name=heading).first.wait_for()
        check(page, path)


def test_a_server_without_a_run(empty: Served, open_page: Open) -> None:
    for role in ("annotator", "admin"):
        page = open_page("/work", role=role, at=empty)
        page.get_by_text("No learner has been started").wait_for()
        check(page, f"work, {role}")
    page.goto("/runs")
    page.get_by_text("No learner has been started").wait_for()
    check(page, "runs")


def test_runs_and_their_dialogs(open_page: Open, learner: Learner) -> None:
    run, page = begun_run(learner, open_page, "watched", 500.0)
    page.keyboard.press("Shift+Enter")
    wait_for_heading(page, "No question right now")
    learner.call("PATCH", f"/runs/{run}", {"second_answers": 0.5})
    for section, there in WATCHED.items():
        page.goto(f"/runs/{run}{section}")
        page.get_by_label(there).or_(page.get_by_text(there)).first.wait_for()
        if section == "":
            for summary in page.get_by_text("As a table").all():
                summary.click()
        check(page, section)
    page.get_by_role("button", name="Mark as gold").first.click()
    page.get_by_role("button", name="Retire").first.wait_for()
    check(page, "gold, marked")
    for kind in ("Inspect_FULL", "Label_HI"):
        page.goto(f"/runs/{run}/queries")
        page.get_by_role("link", name=kind).first.click()
        page.get_by_role("heading", name="In the ledger").wait_for()
        check(page, f"query, {kind}")
    page.goto("/runs")
    page.get_by_role("row", name="watched").first.wait_for()
    check(page, "runs")
    page.goto(f"/runs/compare?run={run}")
    page.get_by_role("slider").first.wait_for()
    check(page, "overlaid")
    page.goto(f"/runs/{run}")
    for name in ("Change…", "Finish…"):
        dialog(page, name)


def test_people_and_their_dialogs(open_page: Open) -> None:
    page = open_page("/people", role="admin")
    page.get_by_role("heading", level=1, name="People").wait_for()
    check(page, "people")
    page.get_by_label("Name").fill("access of the lab")
    page.keyboard.press("Enter")
    page.get_by_role("dialog").wait_for()
    check(page, "login link")
    page.keyboard.press("Escape")
    page.get_by_role("link", name="access of the lab").click()
    page.get_by_role("heading", name="Role and login").wait_for()
    page.get_by_label("What it is for").fill("laptop")
    page.get_by_role("button", name="Create a token").click()
    page.get_by_role("dialog").wait_for()
    check(page, "token")
    page.keyboard.press("Escape")
    check(page, "person")
    dialog(page, "Revoke laptop")
    dialog(page, "Deactivate")
    page.goto("/people/audit")
    page.get_by_role("row", name="made a token").first.or_(page.get_by_role("row").nth(1)).first.wait_for()
    check(page, "audit")
    page.goto("/me")
    page.get_by_role("heading", name="API tokens").wait_for()
    check(page, "me")


def test_practice(open_page: Open, empty: Served) -> None:
    page = open_page("/practice?first=yes", at=empty)
    page.get_by_text("Worked example").wait_for()
    check(page, "worked example")
    page.goto("/practice")
    page.get_by_role("heading", name="Practice").wait_for()
    check(page, "practice")
    page.keyboard.press("Enter")
    wait_for_heading(page, "Did it do the whole task?")
    check(page, "question")
    page.keyboard.press("f")
    wait_for_heading(page, "Not right")
    check(page, "feedback")
    for _ in range(10):
        page.keyboard.press("Enter")
        if page.get_by_role("heading", name="of 10 right").count():
            break
        page.locator("#question[data-query]").wait_for()
        page.keyboard.press("Shift+Enter")
        page.keyboard.press("f")
        page.get_by_role("heading", name="right").wait_for()
    page.get_by_role("heading", name="of 10 right").wait_for()
    check(page, "result")


@pytest.mark.parametrize("place", ["waypost_dialogue:flight_dialogue", "waypost_crossing:lava_crossing"])
def test_text_and_pictures(open_page: Open, served: Served, place: str) -> None:
    with asked(served, find_domain(place), 4) as queries:
        page = open_page(f"/work?run={queries[0].run}")
        for one in queries:
            wait_for(page, one)
            if one.ask.kind == "hier_demo":
                page.locator("[data-stage=here]").wait_for()
            check(page, f"{place}, {one.ask.kind}")
            give(page, one.right)


def test_a_demonstration(open_page: Open, learner: Learner, stage: Stage) -> None:
    run = learner.create_run("shown")
    [query] = learner.ask(run, test_play.ask())
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, test_play.QUESTION)
    page.get_by_text("The learner is away.").wait_for()
    check(page, "the learner is away")
    stage(learner.served, query)
    test_play.is_here(page)
    test_play.way(page, test_play.WAY[:4])
    check(page, "under way")
    test_play.press(page, "n")
    test_play.walk(page, "uuu")
    page.get_by_text("The episode ended and the task is not accomplished.").wait_for()
    check(page, "burnt")
    page.keyboard.press("Enter")
    page.get_by_role("dialog").wait_for()
    check(page, "asked whether to send it")


def test_playing_on_from_where_the_learner_failed(open_page: Open, learner: Learner, stage: Stage) -> None:
    run, query, translator = test_takeover.failed_in_a_maze(learner)
    stage(learner.served, query, translator)
    page = open_page(f"/work?run={run}", motion="reduce")
    test_takeover.is_here(page, "north")
    check(page, "where it failed")
    test_play.press(page, "[")
    check(page, "looking back")
    test_play.press(page, "n")
    test_play.walk(page, "uuu")
    test_play.press(page, "Enter")
    page.get_by_text("Send the demonstration, or undo a move.").wait_for()
    check(page, "complete")


def test_an_answer_that_came_back(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("came back")
    [query] = learner.ask(run, ask("label_hi"))
    page = open_page(f"/work?run={run}", motion="reduce")
    wait_for_heading(page, ask("label_hi")["question"])
    page.keyboard.press("Shift+Enter")
    wait_for_heading(page, "No question right now")
    answered = learner.call("GET", f"/queries/{query}/history")["assignments"][0]["answer"]
    back = {"text": "The second step east leads into the lava.", "answer": answered["id"]}
    learner.call("POST", f"/queries/{query}/send-back", back)
    wait_for_heading(page, ask("label_hi")["question"])
    page.get_by_role("note").wait_for()
    check(page, "asked again")
    page.goto("/me")
    page.get_by_role("region", name="Answers that came back").wait_for()
    check(page, "me")
