"""What a person meets when something goes wrong: nothing is lost, and the page says what happened."""

import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Route, expect
from tests.browser.conftest import Open
from tests.browser.kit import Complaints, Learner, ask, log_in, wait_for_heading

from waypost_server import serving
from waypost_server.settings import Settings

QUESTION = ask("inspect_full")["question"]


def wait_until_leased(learner: Learner, *queries: int) -> None:
    """Wait until the page has these queries."""
    deadline = time.monotonic() + 15
    while any(learner.query(query)["state"] != "leased" for query in queries):
        assert time.monotonic() < deadline
        time.sleep(0.05)


def test_an_answer_survives_an_outage(open_page: Open, learner: Learner, complaints: Complaints) -> None:
    complaints.expect("net::ERR_")
    run = learner.create_run("outage")
    questions = (QUESTION, "Leased ahead", "Leased ahead, too", "After the outage")
    asks = [ask("inspect_full", episode, question=one) for episode, one in enumerate(questions)]
    first, second, third, last = learner.ask(run, *asks)
    page = open_page(f"/work?run={run}", intercepted=True)
    wait_for_heading(page, QUESTION)
    wait_until_leased(learner, second, third)
    page.route("**/api/**", lambda route: route.abort())
    page.keyboard.press("f")
    wait_for_heading(page, "Leased ahead")
    expect(page.get_by_text("1 unsaved")).to_be_visible()
    page.keyboard.press("p")
    wait_for_heading(page, "Leased ahead, too")
    page.keyboard.press("p")
    wait_for_heading(page, "The server cannot be reached")
    expect(page.get_by_text("3 answers kept here")).to_be_visible()
    assert learner.query(first)["answer"] is None
    page.unroute("**/api/**")
    assert [learner.answer_of(query)["verdict"] for query in (first, second, third)] == ["fail", "pass", "pass"]
    wait_for_heading(page, "After the outage")
    expect(page.get_by_text("unsaved")).to_be_hidden()
    page.keyboard.press("p")
    learner.answer_of(last)
    assert learner.call("GET", f"/runs/{run}/costs")["total"] == 4


def test_an_answer_is_sent_from_memory_while_the_storage_is_full(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("net::ERR_")
    run = learner.create_run("full storage")
    [query] = learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", intercepted=True)
    wait_for_heading(page, QUESTION)
    full = "() => { throw new DOMException('The storage is full.', 'QuotaExceededError') }"
    page.evaluate(f"() => {{ Storage.prototype.setItem = {full} }}")
    page.route("**/api/**", lambda route: route.abort())
    page.keyboard.press("f")
    expect(page.get_by_text("1 unsaved, lost if this tab closes")).to_be_visible()
    wait_for_heading(page, "The server cannot be reached")
    expect(page.get_by_text("If you close or reload this tab, 1 answer will be lost.")).to_be_visible()
    page.unroute("**/api/**")
    assert learner.answer_of(query) == {"kind": "inspect_full", "verdict": "fail"}
    wait_for_heading(page, "No question right now")
    expect(page.get_by_text("lost")).to_be_hidden()


def test_an_answer_whose_receipt_was_lost_counts_once(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("net::ERR_")
    run = learner.create_run("lost receipt")
    [query, _] = learner.ask(run, ask("inspect_full", 0), ask("inspect_full", 1, question="The next one"))
    page = open_page(f"/work?run={run}", intercepted=True)
    wait_for_heading(page, QUESTION)
    lost = []

    def lose_first(route: Route) -> None:
        if lost:
            route.continue_()
        else:
            lost.append(route.fetch().status)
            route.abort()

    page.route("**/answer", lose_first)
    with page.expect_response("**/answer") as receipt:  # the lost one never comes
        page.keyboard.press("p")
    assert lost == [200]
    assert receipt.value.ok
    wait_for_heading(page, "The next one")
    learner.answer_of(query)
    expect(page.get_by_text("unsaved")).to_be_hidden()
    assert learner.call("GET", f"/runs/{run}/costs")["total"] == 1


def test_an_unsaved_answer_survives_a_reload(open_page: Open, learner: Learner, complaints: Complaints) -> None:
    complaints.expect("net::ERR_")
    run = learner.create_run("reload unsaved")
    [query] = learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", intercepted=True)
    wait_for_heading(page, QUESTION)
    asked_to_stay = []
    page.on("dialog", lambda dialog: (asked_to_stay.append(dialog.type), dialog.accept()))
    page.route("**/answer", lambda route: route.abort())
    page.keyboard.press("p")
    expect(page.get_by_text("1 unsaved")).to_be_visible()
    page.unroute("**/answer")
    page.route("**/answer", lambda route: route.abort(), times=1)
    page.reload()
    assert asked_to_stay == ["beforeunload"]
    assert learner.answer_of(query)["verdict"] == "pass"


def test_a_reload_goes_on_with_the_same_query(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("reload")
    learner.ask(run, ask("label_hi"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("label_hi")["question"])
    page.reload()
    wait_for_heading(page, ask("label_hi")["question"])


def test_what_is_leased_in_the_instant_of_a_reload_is_not_lost(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("net::ERR_FAILED")
    run = learner.create_run("instant")
    page = open_page("/login", intercepted=True)

    def gone(route: Route) -> None:
        """The server leases, and the page never hears of it."""
        route.fetch()
        route.abort()

    page.route("**/assignments", gone, times=1)
    [query] = learner.ask(run, ask("inspect_full"))
    page.goto(f"/work?run={run}")
    wait_until_leased(learner, query)
    page.reload()
    wait_for_heading(page, QUESTION)
    page.keyboard.press("p")
    assert learner.answer_of(query)["verdict"] == "pass"


def test_leaving_gives_back_what_is_held_and_the_back_button_takes_it_up_again(
    open_page: Open, learner: Learner
) -> None:
    run = learner.create_run("back")
    held = learner.ask(run, ask("inspect_full", 0), ask("inspect_full", 1, question="The next one"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, QUESTION)
    wait_until_leased(learner, *held)
    page.get_by_role("link", name="Runs").click()
    page.get_by_role("heading", name="Runs").wait_for()
    other = open_page(f"/work?run={run}")
    wait_for_heading(other, QUESTION)
    other.close()
    page.go_back()
    for answered in (1, 2):  # whichever is free first comes first
        page.get_by_role("button", name="Yes, it worked").wait_for()
        page.keyboard.press("p")
        expect(page.get_by_text(f"{answered} answer")).to_be_visible()
    assert [learner.answer_of(query)["verdict"] for query in held] == ["pass", "pass"]


def test_what_happens_to_a_query_is_announced(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("announced")
    learner.ask(run, ask("inspect_full", 0), ask("inspect_lo", 1))
    page = open_page(f"/work?run={run}")
    said = page.locator("[aria-live=polite]").first
    expect(said).to_have_text("Question 1. Did the whole task work?")
    page.keyboard.press("p")
    expect(said).to_have_text("Question 2. Did this segment work?, subgoal east")
    wait_for_heading(page, ask("inspect_lo")["question"])


def test_undo_takes_the_last_answer_back_with_its_labels(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("undo")
    first, second = learner.ask(run, ask("label_hi", 0), ask("inspect_full", 1))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, ask("label_hi")["question"])
    page.keyboard.press("w")
    page.keyboard.press("Shift+Enter")
    wait_for_heading(page, QUESTION)
    page.keyboard.press("u")
    wait_for_heading(page, ask("label_hi")["question"])
    expect(page.get_by_text("Taken back.")).to_be_visible()
    assert learner.query(first)["answer"] is None
    page.keyboard.press("n")
    page.keyboard.press("Enter")
    assert learner.answer_of(first)["subgoals"][:2] == ["west", "north"]
    wait_for_heading(page, QUESTION)
    page.keyboard.press("p")
    learner.answer_of(second)


def test_undo_works_while_waiting_and_not_once_the_learner_has_used_the_answer(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("409")
    run = learner.create_run("used")
    [query] = learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, QUESTION)
    page.keyboard.press("u")
    expect(page.get_by_text("There is no answer to take back yet.")).to_be_visible()
    page.keyboard.press("p")
    wait_for_heading(page, "No question right now")
    page.keyboard.press("u")
    wait_for_heading(page, QUESTION)
    page.keyboard.press("f")
    assert learner.answer_of(query)["verdict"] == "fail"
    learner.use(query)
    wait_for_heading(page, "No question right now")
    page.keyboard.press("u")
    expect(page.get_by_text("already used that answer")).to_be_visible()


@pytest.fixture
def hasty(built_page: Path, tmp_path: Path) -> Iterator[serving.Served]:
    """A server whose leases are over in a second, however often they are renewed."""
    settings = Settings(
        database=f"sqlite:///{tmp_path / 'waypost.db'}", page=built_page, lease_seconds=0.6, lease_cap_seconds=0.7
    )
    with serving.background(settings) as served:
        yield served


def test_a_lease_that_ran_out_is_explained_and_work_goes_on(
    hasty: serving.Served, open_page: Open, complaints: Complaints
) -> None:
    complaints.expect("409")
    learner = Learner(hasty)
    run = learner.create_run("hasty")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", at=hasty)
    expect(page.get_by_text("went back to the queue")).to_be_visible()
    wait_for_heading(page, QUESTION)
    learner.close()


def test_the_skip_dialog_closes_with_the_lease_of_its_query(
    built_page: Path, tmp_path: Path, open_page: Open, complaints: Complaints
) -> None:
    complaints.expect("409")
    settings = Settings(database=f"sqlite:///{tmp_path / 'waypost.db'}", page=built_page, lease_seconds=3)
    with serving.background(settings) as served:
        learner = Learner(served)
        run = learner.create_run("skipped too late")
        [query] = learner.ask(run, ask("inspect_full"))
        page = open_page(f"/work?run={run}", at=served, intercepted=True)
        wait_for_heading(page, QUESTION)
        page.keyboard.press("s")
        words = page.get_by_role("dialog").get_by_role("textbox")
        words.fill("too dark")
        problem = {"type": "/problems/lease-expired", "title": "Expired", "status": 409}
        page.route("**/renew", lambda route: route.fulfill(status=409, json=problem))
        expect(page.get_by_text("went back to the queue")).to_be_visible()
        expect(page.get_by_role("dialog")).to_be_hidden()
        page.unroute("**/renew")
        wait_for_heading(page, QUESTION)
        page.keyboard.press("s")
        expect(words).to_have_value("")
        expect(page.get_by_role("radio", name="I cannot tell")).to_be_checked()
        page.keyboard.press("Enter")
        expect(page.get_by_text("Skipped.")).to_be_visible()
        assert learner.query(query)["state"] == "open"
        page.goto("/login")
        page.wait_for_load_state("networkidle")  # what is still loading would fail with the server
        learner.close()


def test_an_answer_after_a_sleep_past_the_lease_is_explained_and_its_labels_are_kept(
    built_page: Path, tmp_path: Path, open_page: Open, complaints: Complaints
) -> None:
    complaints.expect("409")
    complaints.expect("net::ERR_")
    settings = Settings(database=f"sqlite:///{tmp_path / 'waypost.db'}", page=built_page, lease_seconds=5)
    with serving.background(settings) as served:
        learner = Learner(served)
        run = learner.create_run("asleep")
        [query] = learner.ask(run, ask("label_hi"))
        page = open_page("/login", at=served, intercepted=True)
        leases: list[str] = []

        def lease(route: Route) -> None:
            """The second, for what comes next, is not heard: else the page itself would take this one again."""
            leases.append(route.request.url)
            if len(leases) == 2:
                route.abort()
            else:
                route.continue_()

        page.route("**/assignments", lease)
        page.route("**/assignments/1/renew", lambda route: route.abort())  # asleep, it beats no more
        page.goto(f"{served.url}/work?run={run}")
        wait_for_heading(page, ask("label_hi")["question"])
        page.keyboard.press("w")
        deadline = time.monotonic() + 15
        while learner.query(query)["state"] == "leased" and time.monotonic() < deadline:
            page.wait_for_timeout(100)
        page.keyboard.press("Shift+Enter")
        expect(page.get_by_text("That answer came too late")).to_be_visible()
        wait_for_heading(page, ask("label_hi")["question"])
        expect(page.get_by_text("5 of 5")).to_be_visible()
        page.keyboard.press("Enter")
        assert learner.answer_of(query)["subgoals"][0] == "west"
        assert learner.call("GET", f"/runs/{run}/costs")["total"] == 5
        page.goto("/login")
        learner.close()


def test_a_server_that_restarts_while_one_answers_loses_nothing(
    built_page: Path, tmp_path: Path, open_page: Open, complaints: Complaints
) -> None:
    complaints.expect("net::ERR_")
    settings = Settings(database=f"sqlite:///{tmp_path / 'waypost.db'}", page=built_page)
    with serving.background(settings) as served:
        learner = Learner(served)
        run = learner.create_run("restarted")
        asks = [ask("inspect_full", episode, question=f"Question {episode}") for episode in range(4)]
        queries = learner.ask(run, *asks)
        page = open_page(f"/work?run={run}", at=served)
        wait_for_heading(page, "Question 0")
        wait_until_leased(learner, *queries[:3])
        learner.close()
    page.keyboard.press("f")
    wait_for_heading(page, "Question 1")
    expect(page.get_by_text("1 unsaved")).to_be_visible()
    page.keyboard.press("p")
    wait_for_heading(page, "Question 2")
    page.keyboard.press("p")
    wait_for_heading(page, "The server cannot be reached")
    with serving.background(settings, port=int(served.url.rpartition(":")[2])) as again:
        wait_for_heading(page, "Question 3")
        page.keyboard.press("p")
        learner = Learner(again)
        assert [learner.answer_of(query)["verdict"] for query in queries] == ["fail", "pass", "pass", "pass"]
        assert learner.call("GET", f"/runs/{run}/costs")["total"] == 4
        page.goto("/login")
        learner.close()


def test_a_viewer_is_told_why_there_is_no_work(open_page: Open, complaints: Complaints) -> None:
    complaints.expect("403")
    page = open_page("/work", role="viewer")
    wait_for_heading(page, "This account cannot answer questions")


def test_what_is_kept_while_signed_out_is_sent_after_signing_in(
    open_page: Open, learner: Learner, served: serving.Served, complaints: Complaints
) -> None:
    complaints.expect("401")
    run = learner.create_run("signed out")
    [query] = learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", role=None)
    log_in(page.context, served, "comes-back", "annotator")
    page.reload()
    wait_for_heading(page, QUESTION)
    page.context.clear_cookies()
    page.keyboard.press("p")
    wait_for_heading(page, "You are not signed in")
    expect(page.get_by_text("1 answer kept in this tab")).to_be_visible()
    log_in(page.context, served, "comes-back", "annotator")
    assert learner.answer_of(query)["verdict"] == "pass"
