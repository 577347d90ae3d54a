"""A person finishes a run in a real browser with the keyboard alone, after a warm start by the bot."""

from playwright.sync_api import Page

from tests.acceptance.person import Person
from tests.acceptance.processes import VALUES, ServerProcess, answers, bot, finished, start_learner

EPISODES = ("--episodes", "25", "--warm-start", "20")


def test_a_person_answers_five_episodes_after_the_bots_warm_start(server: ServerProcess, page: Page) -> None:
    page.goto(server.login_link("person"))
    page.goto(f"{server.url}/work")
    person = Person(page, server.client("learner", "learner"))
    with bot(server, "bot", "--kinds", "hier_demo"):
        learner = start_learner(server, (*VALUES, *EPISODES))
        person.work_until(lambda: learner.poll() is not None)
        summary = finished(learner)
    assert summary["episodes"] == 25
    client = server.client("learner", "learner")
    asked = answers(client, str(summary["run"]))
    assert {query.annotator for query in asked if query.ask.kind == "hier_demo"} == {"bot"}
    mine = [query for query in asked if query.annotator == "person"]
    assert [query.ask.kind for query in mine] == person.answered
    assert set(person.answered) >= {"inspect_full", "label_hi", "inspect_lo", "label_lo"}
    assert {query.ask.episode for query in mine} == set(range(20, 25))
    assert sum(query.units or 0 for query in asked) == summary["cost"]["total"]
