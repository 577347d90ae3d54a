"""Races: many annotators, some too slow, on one queue. Nothing is answered twice and nothing is charged twice."""

import asyncio
import threading
import time
from collections import Counter
from typing import Any

import pytest
from sqlalchemy import Connection, create_engine, text
from tests.server.db.racing import race
from tests.server.kit import Json, Service, in_process, query, right_answer, together

from waypost import wire
from waypost_server.answers import service as answers
from waypost_server.db import sending
from waypost_server.db.transaction import Tx
from waypost_server.leases import service as leases
from waypost_server.leases.request import LeaseRequest
from waypost_server.runs import service as runs
from waypost_server.settings import Settings


def test_racing_annotators_answer_each_query_once_and_none_is_charged_twice(database_url: str) -> None:
    raced = asyncio.run(race(database_url, 32, 500, seed=0))
    assert set(raced.seen) == {"accepted", "lease-expired"}, "an answer was accepted after its lease"
    assert raced.seen["accepted"] == 500
    assert raced.seen["lease-expired"] >= 11, "no lease expired: the race was not run"
    assert (raced.costs["total"], raced.costs["reserved"]) == (500, 0)
    assert raced.charges == [1] * 500


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


def test_a_query_that_is_leased_while_its_tab_closes_is_open_again(database_url: str) -> None:
    with in_process(database_url) as service:
        service.learner.ask(service.learner.create_run(), query())
        user = service.annotator.get("/me")["id"]
        wanted = LeaseRequest.of(wire.Lease(tab="one"), user, Settings(database=database_url))
        is_leased = threading.Event()

        def lease(tx: Tx) -> None:
            assert leases.lease(tx, wanted) is not None
            is_leased.set()
            time.sleep(0.5)  # not committed yet

        leasing = threading.Thread(target=service.db.write_now, args=(lease,))
        leasing.start()
        is_leased.wait()
        service.annotator.leave("one")
        leasing.join()
        assert service.annotator.get("/assignments")["assignments"] == []
        service.annotator.lease(tab="two")


def test_a_page_may_say_many_times_at_once_that_it_goes(database_url: str) -> None:
    with in_process(database_url) as service:
        together(lambda _: service.annotator.leave("one"), 8)
        service.learner.ask(service.learner.create_run(), query())
        assert service.annotator.lease(tab="one", expect=204) is None


def somebody_waits(conn: Connection) -> None:
    """Return once another transaction waits for a lock."""
    until = time.monotonic() + 10
    while not conn.execute(text("SELECT count(*) FROM pg_locks WHERE NOT granted")).scalar_one():
        assert time.monotonic() < until, "no transaction waits"
        time.sleep(0.02)


@pytest.mark.parametrize("is_committed", [True, False])
def test_a_key_used_in_two_runs_at_once_is_refused_if_the_first_answer_is_stored(
    cluster: Any, is_committed: bool
) -> None:
    with in_process(cluster.create()) as service:
        held = []
        for _ in range(2):
            service.learner.ask(service.learner.create_run(), query())
            held.append(service.annotator.lease())
        first, second = held
        user = service.annotator.get("/me")["id"]
        content = wire.AnswerPost.model_validate({"token": first["token"], "answer": right_answer(query())}).answer
        post = answers.Post(first["id"], user, first["token"], content, "abc", 30)
        replies: list[Json] = []

        def answer_second() -> None:
            expect = 409 if is_committed else 200
            replies.append(service.annotator.answer(second, expect=expect, headers={"Idempotency-Key": "abc"}))

        engine = create_engine(service.db.url)
        with engine.connect() as slow, engine.connect() as watch:
            answers.answer(Tx(slow), post, None)
            answering = threading.Thread(target=answer_second)
            answering.start()
            somebody_waits(watch)
            slow.commit() if is_committed else slow.rollback()
            answering.join()
        engine.dispose()
        (reply,) = replies
        if is_committed:
            assert reply["type"] == "/problems/idempotency-key-reused"
        (again,) = service.annotator.get("/assignments")["assignments"]
        assert again["id"] == (second if is_committed else first)["id"]
        service.annotator.answer(again, headers={"Idempotency-Key": "def"})


def test_a_lease_that_takes_over_an_expired_one_does_not_wait_for_an_answer_to_another_query(cluster: Any) -> None:
    with in_process(cluster.create(), lease_seconds=0.2) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query())
        expired = service.annotator.lease()
        time.sleep(0.3)
        engine = create_engine(service.db.url)
        with engine.begin() as answering:
            runs.lock(Tx(answering), run)
            (other,) = service.annotators(1)
            assert other.lease()["query"]["id"] == expired["query"]["id"]
        engine.dispose()


def test_a_query_that_is_skipped_while_its_annotator_leases_does_not_come_back(
    cluster: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    with in_process(cluster.create()) as service:
        service.annotator.lease(expect=204)  # the annotator is at work, so the next lease does not record it
        first, second = service.learner.ask(service.learner.create_run(), query(), query(ordinal=1))
        user = service.annotator.get("/me")["id"]
        wanted = LeaseRequest.of(wire.Lease(), user, Settings())
        read, engine = sending.Single.read, create_engine(service.db.url)

        def skipping(line: sending.Single, conn: Connection, statement: str, arguments: Any) -> Any:
            if conn.engine is engine and "ORDER BY answers.id DESC" in statement:  # selected, but not locked yet
                held = service.annotator.lease()
                assert held["query"]["id"] == first["id"]
                service.annotator.release(held, skip=True)
            return read(line, conn, statement, arguments)

        monkeypatch.setattr(sending.Single, "read", skipping)
        with engine.begin() as conn:
            leased = leases.lease(Tx(conn), wanted)
        engine.dispose()
        assert leased is not None
        assert leased.query.id == second["id"]
