"""Races: many annotators, some too slow, on one queue. Nothing is answered twice and nothing is charged twice."""

import random
import time
from collections import Counter
from typing import Any

from tests.server.kit import Caller, Service, in_process, query, right_answer, together

LEASE_SECONDS = 0.5


def work(caller: Caller, slow: bool, until: float) -> Counter[str]:
    """Lease and answer until the queue is empty; a slow one often takes longer than its lease."""
    seen: Counter[str] = Counter()
    client, headers, random_ = caller.client, caller.headers, random.Random(caller.name)
    while time.monotonic() < until:
        reply = client.post("/api/v1/assignments", json={"wait": 1.5}, headers=headers)
        if reply.status_code == 204:
            break
        held: dict[str, Any] = reply.json()
        late = slow and random_.random() < 0.2
        if late:
            time.sleep(LEASE_SECONDS * 1.2)
        body = {"token": held["token"], "answer": right_answer(held["query"]["ask"])}
        reply = client.post(f"/api/v1/assignments/{held['id']}/answer", json=body, headers=headers)
        name = "accepted" if reply.status_code == 200 else reply.json()["type"]
        seen[name] += 1
        assert not (late and reply.status_code == 200), "a stale lease was accepted"
    return seen


def test_racing_annotators_answer_each_query_once_and_none_is_charged_twice(database_url: str) -> None:
    n_queries = 500
    settings = {"lease_seconds": LEASE_SECONDS, "reap_seconds": 0.2}
    with in_process(database_url, **settings) as service:
        run = service.learner.create_run(budget=n_queries)
        for start in range(0, n_queries, 100):
            service.learner.ask(run, *(query(ordinal=start + n) for n in range(100)))
        annotators = service.annotators(32)
        until = time.monotonic() + 60
        seen = sum(together(lambda n: work(annotators[n], n % 3 == 0, until), 32), Counter())
        assert seen["accepted"] == n_queries
        assert seen["/problems/lease-expired"] > 0, "no lease expired: the race was not run"
        assert set(seen) <= {"accepted", "/problems/lease-expired"}
        assert_each_charged_once(service, run, n_queries)


def assert_each_charged_once(service: Service, run: str, n_queries: int) -> None:
    costs = service.learner.costs(run)
    assert (costs["total"], costs["reserved"]) == (n_queries, 0)
    sql = "SELECT query_id, count(*) AS n FROM ledger GROUP BY query_id"
    charged = service.db.read_now(lambda tx: tx.conn.exec_driver_sql(sql).all())
    assert len(charged) == n_queries
    assert {row.n for row in charged} == {1}


def test_one_query_goes_to_one_of_many_who_wait(service: Service) -> None:
    run = service.learner.create_run()
    annotators = service.annotators(16)

    def lease(number: int) -> int:
        if number == 16:
            time.sleep(0.2)
            service.learner.ask(run, query())
            return 0
        body = {"wait": 1}
        return service.client.post("/api/v1/assignments", json=body, headers=annotators[number].headers).status_code

    assert sorted(together(lease, 17)) == [0, 201] + [204] * 15


def test_the_same_answer_sent_many_times_at_once_is_one_answer(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    held = service.annotator.lease()
    receipts = together(lambda _: service.annotator.answer(held, next={}), 16)
    assert len({(receipt["answer"], receipt["next"]["id"]) for receipt in receipts}) == 1
    assert service.learner.costs(run)["total"] == 1


def test_the_same_question_sent_many_times_at_once_is_one_query(service: Service) -> None:
    run = service.learner.create_run(budget=1)
    asked = together(lambda _: service.learner.ask(run, query()), 16)
    assert len({one["id"] for (one,) in asked}) == 1


def test_an_answer_is_either_used_or_taken_back(service: Service) -> None:
    run = service.learner.create_run()
    outcomes: Counter[tuple[int, int]] = Counter()
    for ordinal in range(15):
        (asked,) = service.learner.ask(run, query(ordinal=ordinal))
        held = service.annotator.lease()
        service.annotator.answer(held)
        calls = [
            (f"/api/v1/queries/{asked['id']}/use", None, service.learner.headers),
            (f"/api/v1/assignments/{held['id']}/retract", {"token": held["token"]}, service.annotator.headers),
        ]

        def call(number: int, calls: list[Any] = calls) -> int:
            path, body, headers = calls[number]
            given = {} if body is None else {"json": body}
            return service.client.post(path, headers=headers, **given).status_code

        used, retracted = together(call, 2)
        outcomes[used, retracted] += 1
        now = service.learner.get(f"/queries/{asked['id']}")
        assert now["used"] == (used == 200)
        assert now["state"] == ("answered" if used == 200 else "leased")
        if retracted == 200:
            (again,) = service.annotator.get("/assignments")["assignments"]
            service.annotator.answer(again)
    assert set(outcomes) <= {(200, 409), (409, 200)}
    assert service.learner.costs(run)["total"] == 15
