"""Batches: several queries leased by one request, several answers stored by one commit, each judged by itself."""

from typing import Any

import pytest
from tests.server.kit import Caller, Json, Service, query, right_answer


def lease(caller: Caller, count: int, **more: Any) -> list[Json]:
    held: list[Json] = caller.post("/assignments/batch", {"count": count, **more}, 201)["assignments"]
    return held


def post(held: Json, **changes: Any) -> Json:
    return {"assignment": held["id"], "token": held["token"], "answer": right_answer(held["query"]["ask"]), **changes}


def send(caller: Caller, *posts: Json) -> list[Json]:
    results: list[Json] = caller.post("/assignments/answers", {"answers": list(posts)})["results"]
    return results


def test_a_batch_leases_the_next_queries_in_their_order(service: Service) -> None:
    run = service.learner.create_run()
    asked = service.learner.ask(run, *(query(ordinal=n) for n in range(5)))
    assert [held["query"]["id"] for held in lease(service.annotator, 3)] == [one["id"] for one in asked[:3]]
    assert [held["query"]["id"] for held in lease(service.annotator, 100)] == [one["id"] for one in asked[3:]]
    assert lease(service.annotator, 100) == []


def test_two_annotators_never_get_the_same_query(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), *(query(ordinal=n) for n in range(20)))
    one, other = service.annotators(2)
    held = [*lease(one, 12), *lease(other, 12)]
    assert len({each["query"]["id"] for each in held}) == len(held) == 20


def test_a_batch_waits_for_its_first_query(service: Service) -> None:
    assert lease(service.annotator, 2, wait=0.1) == []


def test_answers_of_a_batch_are_stored_and_charged_once_each(service: Service) -> None:
    run = service.learner.create_run(budget=100)
    service.learner.ask(run, *(query(ordinal=n) for n in range(4)))
    posts = [post(held) for held in lease(service.annotator, 4)]
    results = send(service.annotator, *posts)
    assert [result["problem"] for result in results] == [None] * 4
    units = sum(result["receipt"]["units"] for result in results)
    assert service.learner.get(f"/runs/{run}")["spent"] == units > 0
    again = send(service.annotator, *posts)
    assert [one["receipt"]["answer"] for one in again] == [one["receipt"]["answer"] for one in results]
    assert service.learner.get(f"/runs/{run}")["spent"] == units


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"token": "wrong"}, "/problems/wrong-token"),
        ({"assignment": 999_999}, "/problems/not-found"),
        ({"answer": {"kind": "label_hi", "subgoals": ["north"]}}, "/problems/unprocessable"),
    ],
)
def test_a_refused_answer_says_why_and_the_others_stay(service: Service, changes: Json, problem: str) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, *(query(ordinal=n) for n in range(3)))
    first, second, third = lease(service.annotator, 3)
    results = send(service.annotator, post(first), post(second, **changes), post(third))
    assert [result["receipt"] is None for result in results] == [False, True, False]
    assert results[1]["problem"]["type"] == problem
    assert service.learner.get(f"/runs/{run}")["open_queries"] == 1
    assert send(service.annotator, post(second))[0]["problem"] is None


def test_nobody_answers_what_another_annotator_holds(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query())
    one, other = service.annotators(2)
    (held,) = lease(one, 1)
    (result,) = send(other, post(held))
    assert (result["receipt"], result["problem"]["type"]) == (None, "/problems/not-yours")


@pytest.mark.parametrize("count", [0, 101])
def test_a_batch_has_1_to_100_queries(lite: Service, count: int) -> None:
    lite.annotator.post("/assignments/batch", {"count": count}, 422)
