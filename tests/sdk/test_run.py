"""The run of a training script, against a real server: waiting, resuming, paying once."""

import threading
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tests.sdk.kit import DARK, NAMES, WALK, inspection

import waypost
from waypost import wire

# --- waiting for answers


def test_answers_come_with_their_queries_in_the_order_in_which_they_are_given(service):
    run = service.start()
    asked = [run.ask(inspection(episode)) for episode in range(3)]
    threading.Thread(target=service.answer, args=(3,)).start()
    received = list(run.answers())  # ends because no query is open any more
    assert dict(received) == dict.fromkeys(asked, True)
    assert list(run.answers()) == []
    run.ask(inspection(3))
    assert list(run.answers(wait=0)) == []
    service.answer(verdict="fail")
    query, answer = next(run.answers(wait=10))
    assert (query.episode, answer) == (3, False)


def test_a_loop_that_is_left_early_continues_with_the_next_answer(service):
    run = service.start()
    run.ask_all([inspection(episode) for episode in range(3)])
    service.answer(3)
    episodes = [next(iter(run.answers(wait=0)))[0].episode for _ in range(3)]
    assert sorted(episodes) == [0, 1, 2]


def test_several_queries_are_waited_for_together(service):
    run = service.start()
    asked = run.ask_all([inspection(episode) for episode in range(3)])
    threading.Thread(target=service.answer, args=(3,)).start()
    assert run.wait(asked, timeout=30) == [True, True, True]


def test_waiting_ends_with_a_sentence_and_can_be_continued(service):
    run = service.start()
    asked = run.ask(inspection())
    with pytest.raises(TimeoutError, match=rf"query {asked.id} has no answer yet; is an annotator or a bot at work"):
        asked.answer(timeout=0)
    with pytest.raises(TimeoutError):
        run.wait([asked], timeout=0)
    service.answer()
    assert asked.answer(timeout=0) is True


def test_an_answer_that_was_read_can_no_longer_be_retracted(service):
    run = service.start()
    asked = run.ask(inspection())
    assignment = service.lease()
    service.annotator.answer(assignment, wire.InspectAnswer(kind="inspect_full", verdict="pass"))
    assert asked.answer()
    with pytest.raises(waypost.Refused) as refused:
        service.annotator._send("POST", f"/assignments/{assignment.id}/retract", wire.Retract(token=assignment.token))
    assert refused.value.name == "answer-used"


def test_an_answer_that_is_retracted_first_is_not_read(service):
    run = service.start()
    asked = run.ask(inspection())
    assignment = service.lease()
    service.annotator.answer(assignment, wire.InspectAnswer(kind="inspect_full", verdict="pass"))
    asked.latest = run.client.query(asked.id)  # the script has seen the answer, but not read it
    service.annotator._send("POST", f"/assignments/{assignment.id}/retract", wire.Retract(token=assignment.token))
    assert list(run.answers(wait=0)) == []
    with pytest.raises(TimeoutError):
        asked.answer(timeout=0)


def test_a_finished_run_answers_no_more(service):
    run = service.start()
    asked = run.ask(inspection())
    run.finish()
    with pytest.raises(waypost.QueryCancelled, match=f"the run was finished before query {asked.id} was answered"):
        asked.answer()


# --- asking once, also after a crash


def test_an_equal_query_about_the_same_episode_is_asked_once(service):
    run = service.start()
    assert run.ask(inspection(0)) == run.ask(inspection(0))
    assert run.ask(inspection(0)) != run.ask(inspection(1))
    assert run.ask(inspection(0)) != run.ask(inspection(0, last=1))
    assert service.annotator.run(run.id).open_queries == 3


def test_the_same_query_with_other_pictures_is_the_same_query(service):
    run = service.start()

    def shown(shade: int) -> waypost.InspectFull:
        pictures = [np.full((2, 2), shade, np.uint8)] * 2
        return waypost.InspectFull([waypost.Segment([0, 1], ["left"], pictures=pictures)], episode=0)

    assert run.ask(shown(0)) == run.ask(shown(9))


def test_a_resumed_script_gets_its_answers_back_and_pays_once(service):
    run = service.start(resume=True)
    first, second = run.ask_all([inspection(0), inspection(0, last=1)])
    service.answer(2)
    run.close()  # the script crashes here

    again = service.start(resume=True)
    assert again.id == run.id
    assert again.ask(inspection(0, last=1)) == second  # in another order
    assert again.ask(inspection(0)) == first
    third = again.ask(inspection(0, last=0))
    assert third not in (first, second)
    assert [query for query, _ in again.answers(wait=0)] == [first, second]
    assert again.costs().total == 2


def test_the_cursor_of_a_checkpoint_continues_after_the_answers_that_were_used(service):
    run = service.start(resume=True)
    run.ask(inspection(0))
    service.answer()
    assert len(list(run.answers())) == 1
    again = service.start(resume=True)
    again.cursor = run.cursor
    later = again.ask(inspection(1))
    service.answer()
    assert [query for query, _ in again.answers()] == [later]


@pytest.mark.parametrize("change", [{"config": {"lr": 1}}, {"seed": 1}, {"actions": ["left"]}, {"algorithm": "ppo"}])
def test_only_a_run_with_the_same_settings_is_resumed(service, change):
    run = service.start(resume=True)
    assert service.start(resume=True, **change).id != run.id
    assert service.start("a run of another name", resume=True).id != run.id
    assert service.start(resume=False).id != run.id


def test_the_run_of_another_learner_is_not_resumed_and_cannot_be_changed(service):
    run = service.start(resume=True)
    other = service.client(service._token("leo", "learner"))
    assert waypost.start_run(service.name, client=other, resume=True, **NAMES).id != run.id
    with pytest.raises(waypost.Refused, match=f"Run {run.id} belongs to lea"):
        waypost.Run(other, other.run(run.id)).set_budget(1)


def test_a_finished_run_is_not_resumed(service):
    run = service.start(resume=True)
    run.finish()
    assert service.start(resume=True).id != run.id


def test_a_resumed_run_gets_the_new_budget(service):
    service.start(budget=1, resume=True)
    run = service.start(budget=2, resume=True)
    assert run.costs().budget == 2


def test_two_processes_of_one_run_ask_equal_queries_once_and_others_beside_each_other(service):
    run = service.start()
    runs = [
        run,
        *(waypost.Run(service.client(service.token), service.annotator.run(run.id)) for _ in "ab"),
    ]
    barrier, asked = threading.Barrier(len(runs)), dict[int, Any]()

    def work(number: int) -> None:
        barrier.wait()
        asked[number] = [runs[number].ask(inspection(0, last=step)) for step in (number, 7, 10 + number)]

    threads = [threading.Thread(target=work, args=(number,)) for number in range(len(runs))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({query.id for queries in asked.values() for query in queries}) == 2 * len(runs) + 1
    assert len({queries[1].id for queries in asked.values()}) == 1


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(orders=st.lists(st.lists(st.integers(0, 4), max_size=6), min_size=1, max_size=4))
def test_in_whatever_order_restarted_scripts_ask_each_query_has_one_number(service, orders):
    first = service.start("a script")
    seen = dict[int, int]()
    for order in orders:
        run = waypost.Run(first.client, service.annotator.run(first.id))  # a process that remembers nothing
        for step in order:
            query = run.ask(inspection(0, last=step))
            assert seen.setdefault(step, query.id) == query.id
    assert len(set(seen.values())) == len(seen)


def test_more_queries_than_fit_into_one_request_are_asked_in_order(service):
    run = service.start()
    heavy = "x" * 300_000
    queries = [inspection(episode, last=heavy + str(episode)) for episode in range(20)]
    assert [query.episode for query in run.ask_all(queries)] == list(range(20))
    assert service.annotator.run(run.id).open_queries == 20


# --- the account, the episodes, the end


def test_an_exhausted_budget_has_its_own_exception_and_more_budget_helps(service):
    run = service.start(budget=1)
    run.ask(inspection(0))
    with pytest.raises(waypost.BudgetExhausted, match="budget is exhausted: This needs 1 units, but only 0"):
        run.ask(inspection(1))
    run.set_budget(2)
    assert run.ask(inspection(1)) == run.ask(inspection(1))
    assert run.costs().reserved == 2


def test_a_refused_query_leaves_no_gap_that_would_ask_another_one_twice(service):
    run = service.start(budget=2, resume=True)
    run.ask(inspection(0))
    with pytest.raises(waypost.BudgetExhausted):
        run.ask(waypost.LabelFull([WALK], episode=0))
    last = run.ask(inspection(0, last=1))
    again = service.start(budget=2, resume=True)
    assert again.ask(inspection(0)).id < last.id
    assert again.ask(inspection(0, last=1)) == last


def test_reported_episodes_make_the_curves(service):
    run = service.start()
    asked = run.ask(inspection(0))
    service.answer()
    assert asked.answer()
    for episode, success in enumerate([False, True]):
        run.report(episode, success, train_steps=5, seconds=0.1)
        run.report(episode, success, train_steps=5, seconds=0.2)  # a repeated report changes nothing
    curves = run.client.curves(run.id)
    assert (curves.test_success, curves.success_rate, curves.cost) == ([False, True], [0, 0.5], [1, 1])


def test_the_end_of_the_block_finishes_the_run_and_an_exception_leaves_it_open(service):
    with service.start() as run:
        pass
    assert service.annotator.run(run.id).state == "finished"
    with pytest.raises(KeyboardInterrupt), service.start("interrupted") as run:
        raise KeyboardInterrupt
    assert service.annotator.run(run.id).state == "running"


def test_a_result_is_kept_with_the_finished_run(service):
    run = service.start()
    run.finish({"success_rate": 0.9})
    assert service.annotator.run(run.id).result == {"success_rate": 0.9}


# --- errors say what to do


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: waypost.Segment([0, 1], ["left", "left"]), "has 2 states and 2 actions; give one state more"),
        (
            lambda: waypost.Segment([0, 1], ["left"], pictures=[b""]),
            "has 1 pictures and 2 states; give one picture per",
        ),
        (
            lambda: waypost.Segment([0, 1], ["left"], "door", landmarks=[{"door": (0, 0, 1, 1)}]),
            "has landmarks 1 times, 2 states and 0 pictures; give landmarks with pictures only",
        ),
        (
            lambda: waypost.Segment([0], [], "door", [b""], [{"door": (0.5, 0, 0.5, 1)}]),
            r"the box of 'door' is \(0.5, 0, 0.5, 1\); give its left, upper",
        ),
        (
            lambda: waypost.LabelHi([waypost.Segment([0], [], "door", [DARK], [{"gate": (0, 0, 1, 1)}])], episode=0),
            "no subgoal 'gate'; .*: door, key",
        ),
        (
            lambda: waypost.Segment([0, 1], ["left"], "door", action_landmarks=[{"left": (0, 0, 1, 1)}]),
            "has action_landmarks 1 times, 2 states and 0 pictures; give action_landmarks with pictures only",
        ),
        (
            lambda: waypost.Segment([0], [], "door", [b""], action_landmarks=[{"left": (0, 0, 2, 1)}]),
            r"the box of 'left' is \(0, 0, 2, 1\); give its left, upper",
        ),
        (
            lambda: waypost.LabelHi(
                [waypost.Segment([0], [], "door", [DARK], action_landmarks=[{"door": (0, 0, 1, 1)}])], episode=0
            ),
            "no action 'door'; .*: left, right",
        ),
        (lambda: waypost.InspectFull([waypost.Segment([0, 1], ["up"])], episode=0), "no action 'up'; .*: left, right"),
        (lambda: waypost.InspectLo(waypost.Segment([0], [], "dor"), episode=0), "no subgoal 'dor'; .*: door, key"),
        (lambda: waypost.InspectLo(waypost.Segment([0], []), episode=0), "segment in InspectLo needs a subgoal"),
        (lambda: inspection(last=float("nan")), "nan cannot be sent as JSON"),
        (lambda: inspection(last={1: 2}), r"\{1: 2\} cannot be sent as JSON"),
        (
            lambda: waypost.InspectFull([waypost.Segment([0], [], pictures=[b"GIF89a"])], episode=0),
            "must be a PNG file",
        ),
        (
            lambda: waypost.InspectFull([waypost.Segment([0], [], pictures=[np.zeros((2, 2, 3))])], episode=0),
            r"a picture is float64\[2, 2, 3\]; give",
        ),
    ],
)
def test_a_mistake_is_explained_before_anything_is_sent(service, make, message):
    run = service.start()
    with pytest.raises(ValueError, match=message):
        run.ask(make())
    assert service.annotator.run(run.id).open_queries == 0


def test_without_a_token_the_message_says_how_to_get_one(monkeypatch):
    monkeypatch.delenv("WAYPOST_TOKEN", raising=False)
    with pytest.raises(ValueError, match=r"set WAYPOST_TOKEN .*waypost token create"):
        waypost.start_run("a run", actions=["left"])


def test_server_and_token_can_come_from_the_environment(service, monkeypatch):
    monkeypatch.setenv("WAYPOST_SERVER", service.url)
    monkeypatch.setenv("WAYPOST_TOKEN", service.token)
    with waypost.start_run("a run", actions=["left"]) as run:
        assert service.annotator.run(run.id).vocabulary.actions == ["left"]
