"""The query leased with an answer: whatever goes wrong with it, the answer stays accepted."""

import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import pytest
from sqlalchemy import update
from sqlalchemy.exc import DBAPIError
from tests.server.kit import Json, Service, query

from waypost_server.db.tables import assignments
from waypost_server.leases import service as leases


def answered(service: Service, run: str) -> int:
    return len(service.learner.get(f"/runs/{run}/answers")["queries"])


def break_leasing(service: Service) -> None:
    """Take away a table that leasing reads, and neither answering nor the tasks of the server do."""
    service.db.write_now(lambda tx: tx.conn.exec_driver_sql("ALTER TABLE skips RENAME TO gone"))


def deactivate(service: Service) -> None:
    (abe,) = [user["id"] for user in service.admin.get("/users")["users"] if user["name"] == "abe"]
    service.admin.call("PATCH", f"/users/{abe}", {"active": False})


def test_an_answer_stays_when_the_next_query_is_wanted_from_an_unknown_run(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    held = service.annotator.lease()
    receipt = service.annotator.answer(held, next={"run": "0123456789ab"})
    assert receipt["next"] is None
    assert receipt["next_problem"]["type"] == "/problems/not-found"
    assert "0123456789ab" in receipt["next_problem"]["detail"]
    assert answered(service, run) == 1
    assert service.learner.costs(run)["total"] == 1
    again = service.annotator.answer(held, next={})
    assert (again["answer"], again["next_problem"]) == (receipt["answer"], None)
    assert again["next"]["query"]["ask"]["ordinal"] == 1


def test_an_answer_that_cannot_be_stored_is_not_acknowledged(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    held = service.annotator.lease()
    service.db.write_now(lambda tx: tx.conn.exec_driver_sql("ALTER TABLE events RENAME TO gone"))
    with pytest.raises((DBAPIError, AssertionError), match="events"):
        service.annotator.answer(held, next={})
    service.db.write_now(lambda tx: tx.conn.exec_driver_sql("ALTER TABLE gone RENAME TO events"))
    assert answered(service, run) == 0
    service.annotator.answer(held)


def test_an_answer_stays_when_leasing_fails(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query(), query(ordinal=1))
    held = service.annotator.lease()
    break_leasing(service)
    _check_kept(service, run, service.annotator.answer(held, next={}))


@pytest.mark.parametrize("goes_wrong", [deactivate, break_leasing])
def test_an_answer_stays_when_waiting_for_the_next_query_fails(
    service: Service, goes_wrong: Callable[[Service], None]
) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query())
    held = service.annotator.lease()
    with ThreadPoolExecutor() as pool:
        waiting = pool.submit(service.annotator.answer, held, next={"wait": 30})
        time.sleep(0.3)
        goes_wrong(service)
        _check_kept(service, run, waiting.result())


def test_an_answer_sent_again_leases_anew_what_was_given_back_meanwhile(service: Service) -> None:
    service.learner.ask(service.learner.create_run(), query(), query(ordinal=1))
    held = service.annotator.lease()
    first = service.annotator.answer(held, next={})["next"]
    assert service.annotator.answer(held, next={})["next"] == first
    service.annotator.release(first)
    second = service.annotator.answer(held, next={})["next"]
    assert second["query"] == first["query"]
    assert second["id"] != first["id"]
    service.db.write_now(lambda tx: tx.conn.execute(update(assignments).values(expires_at=tx.now - 1)))
    third = service.annotator.answer(held, next={})["next"]
    assert third["id"] not in {first["id"], second["id"]}, "the lease had expired"
    service.annotator.answer(third)


def test_an_answer_sent_twice_at_once_returns_the_last_query_that_was_leased_with_it(service: Service) -> None:
    asked = service.learner.ask(service.learner.create_run(), *(query(ordinal=ordinal) for ordinal in range(3)))
    held = service.annotator.lease()
    service.annotator.answer(held)
    user = service.annotator.get("/me")["id"]
    for one in asked[1:]:
        service.db.write_now(lambda tx, asked=one["id"]: leases.grant(tx, asked, user, 60, after=held["id"]))
    assert service.annotator.answer(held, next={})["next"]["query"]["id"] == asked[2]["id"]


def _check_kept(service: Service, run: str, receipt: Json) -> None:
    assert receipt["next"] is None
    assert receipt["next_problem"]["status"] in {401, 500, 503}
    assert receipt["next_problem"]["detail"].startswith("The answer is stored, but the next query could not be leased")
    assert "Nothing was stored" not in receipt["next_problem"]["detail"]
    assert answered(service, run) == 1
