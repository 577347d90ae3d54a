"""A person does a whole run of hg-DAgger in a real browser with the keyboard alone: nobody and nothing else answers."""

from collections import Counter

from playwright.sync_api import Page
from tests.acceptance.person import Person
from tests.acceptance.processes import VALUES, ServerProcess, answers, finished, start_learner

from waypost import wire
from waypost.domains import find_domain

EPISODES, DEMONSTRATIONS = 8, 2
SEED = ("--seed", "1")  # of few runs so short that ask every kind of query
LENGTH = ("--episodes", str(EPISODES), "--warm-start", str(DEMONSTRATIONS))


def price(answer: wire.Answer) -> int:
    """What the paper has an answer cost: Label the length of what is labeled, Inspect one (section 3)."""
    match answer:
        case wire.InspectAnswer():
            return 1
        case wire.LabelHiAnswer():
            return len(answer.subgoals)
        case wire.LabelLoAnswer():
            return len(answer.actions) + 1  # and the last state's termination
        case wire.LabelFullAnswer():
            return len(answer.actions)
        case wire.HierDemoAnswer():  # its HI labels, and per segment its LO labels
            return sum(1 + len(segment.actions) + 1 for segment in answer.segments)


def test_a_person_does_a_run_with_the_keyboard_alone_and_pays_what_the_paper_says(
    server: ServerProcess, page: Page
) -> None:
    page.goto(server.login_link("person"))
    page.wait_for_url("**/practice?first=yes")
    page.goto(f"{server.url}/work")
    person = Person(page, server.client("learner", "learner"), find_domain("maze"))
    learner = start_learner(server, (*VALUES, *SEED, *LENGTH))
    person.work_until(lambda: learner.poll() is not None)
    summary = finished(learner)

    client = server.client("learner", "learner")
    asked = answers(client, str(summary["run"]))
    assert {query.annotator for query in asked} == {"person"}
    assert [query.ask.kind for query in asked] == person.answered
    assert person.answered.count("hier_demo") == DEMONSTRATIONS
    assert set(person.answered) == {"hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo"}
    assert {query.ask.episode for query in asked} == set(range(EPISODES))
    assert summary["episodes"] == EPISODES

    owed: Counter[str] = Counter()
    for query in asked:
        assert query.answer is not None
        assert query.units == price(query.answer)
        owed[query.ask.kind] += price(query.answer)
    charged = {kind: units for kind, units in summary["cost"]["by_kind"].items() if units}
    assert (summary["cost"]["total"], charged) == (owed.total(), owed)
    assert client.costs(str(summary["run"])).reserved == 0
