"""Several tabs or people at one run: each query goes to one of them, and an episode stays with whoever is at it."""

from playwright.sync_api import Page, expect
from tests.browser.conftest import Open
from tests.browser.kit import Complaints, Learner, ask, log_in, wait_for_heading
from tests.browser.work.test_trouble import wait_until_leased

from waypost_server.serving import Served

QUESTION = ask("inspect_full")["question"]


def test_two_tabs_of_one_person_answer_different_queries(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("two tabs")
    asks = [ask("inspect_full", episode, question=f"Question {episode}") for episode in range(4)]
    queries = learner.ask(run, *asks)
    one = open_page(f"/work?run={run}")
    wait_for_heading(one, "Question 0")
    two = one.context.new_page()
    two.goto(f"/work?run={run}")
    two.get_by_role("heading", name="Question").wait_for()
    assert one.locator("#question").text_content() != two.locator("#question").text_content()
    for page in (two, one):
        page.bring_to_front()
        page.keyboard.press("p")
        page.keyboard.press("f")
    two.close()
    one.bring_to_front()
    while one.locator("#question").text_content() != "No question right now":
        one.keyboard.press("p")
        one.wait_for_timeout(100)
    assert all(learner.answer_of(query) for query in queries)
    assert learner.call("GET", f"/runs/{run}/costs")["total"] == 4


def test_two_people_share_a_run_and_none_of_it_is_answered_twice(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("two people")
    asks = [ask("inspect_full", episode, question=f"Question {episode}") for episode in range(6)]
    queries = learner.ask(run, *asks)
    pages = [open_page(f"/work?run={run}") for _ in range(2)]
    for page in pages:
        page.get_by_role("heading", name="Question").wait_for()
    while any(page.locator("#question").text_content() != "No question right now" for page in pages):
        for page in pages:
            page.keyboard.press("p")
            page.wait_for_timeout(50)
    answered = [learner.query(query) for query in queries]
    assert len({one["annotator"] for one in answered}) == 2
    assert learner.call("GET", f"/runs/{run}/costs")["total"] == 6


def test_an_episode_stays_with_the_person_who_is_at_it(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("follow-up")
    [query] = learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}")
    wait_for_heading(page, QUESTION)
    other = open_page(f"/work?run={run}")
    wait_for_heading(other, "No question right now")
    page.keyboard.press("f")
    learner.answer_of(query)
    [follow_up] = learner.ask(run, ask("label_hi", ordinal=1))
    wait_for_heading(page, ask("label_hi")["question"])
    wait_for_heading(other, "No question right now")
    page.keyboard.press("Shift+Enter")
    assert learner.answer_of(follow_up)
    assert learner.query(follow_up)["annotator"] == learner.query(query)["annotator"]


def test_who_holds_the_queries_is_said_while_none_is_open(
    open_page: Open, served: Served, learner: Learner, complaints: Complaints
) -> None:
    def at_work(name: str) -> Page:
        page = open_page("/login", role=None)
        log_in(page.context, served, name, "annotator")
        page.goto(f"/work?run={run}")
        return page

    complaints.expect("net::ERR_")
    run = learner.create_run("closed browser")
    first, second = learner.ask(run, ask("inspect_full"), ask("inspect_full", 1))
    closed = at_work("holds-two")
    wait_until_leased(learner, first, second)
    closed.context.set_offline(True)  # it cannot say goodbye
    closed.close()
    for name, said in (("holds-two", "You hold 2 questions in another tab"), ("holds-none", "Others are answering 2")):
        page = at_work(name)
        wait_for_heading(page, "No question right now")
        expect(page.get_by_text(said)).to_be_visible()
