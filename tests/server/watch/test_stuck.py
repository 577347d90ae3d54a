"""What is stuck in a run: for each reason, a query that has it, and one that does not have it yet."""

from collections.abc import Callable
from typing import Any

import pytest
from sqlalchemy import event, update
from tests.server.kit import Caller, Json, Service, query

from waypost_server.db.tables import assignments, presence, queries
from waypost_server.leases import service as leases


def stuck(service: Service, run: str) -> list[tuple[int, list[str]]]:
    """The queries that are stuck, with the reasons."""
    found = service.viewer.get(f"/runs/{run}/stuck")
    assert found["total"] == len(found["queries"])
    return [(one["query"], one["reasons"]) for one in found["queries"]]


def ids(asked: list[Json]) -> list[int]:
    """The ids of queries."""
    return [one["id"] for one in asked]


def age(service: Service, seconds: float) -> None:
    """Let all that is in the store have happened earlier."""
    for table, columns in (
        (queries, ["created_at"]),
        (assignments, ["leased_at", "ended_at"]),
        (presence, ["asked_at"]),
    ):
        earlier: Json = {name: table.c[name] - seconds for name in columns}
        service.db.write_now(lambda tx, table=table, earlier=earlier: tx.conn.execute(update(table).values(earlier)))


def expire(service: Service, by: Caller, run: str) -> None:
    """Lease a query and let the lease expire."""
    held = by.lease(run=run)
    ended = update(assignments).where(assignments.c.id == held["id"]).values(expires_at=assignments.c.leased_at - 1)
    service.db.write_now(lambda tx: tx.conn.execute(ended))
    service.db.write_now(leases.expire)


def test_nothing_is_stuck_at_first(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query())
    assert stuck(service, run) == []


def test_a_query_is_stuck_that_is_open_for_more_than_ten_minutes(service: Service) -> None:
    run = service.learner.create_run()
    first, _ = ids(service.learner.ask(run, query(), query(ordinal=1)))
    age(service, 590)
    assert stuck(service, run) == []
    age(service, 20)
    held = service.annotator.lease(run=run)
    assert held["query"]["id"] == first
    assert [one for one, _ in stuck(service, run)] == [first + 1], "the other one is at work"
    service.annotator.release(held)
    assert [one for one, _ in stuck(service, run)] == [first + 1], "its time begins anew"
    age(service, 610)
    assert stuck(service, run) == [(first, ["waiting"]), (first + 1, ["waiting"])]


def test_the_time_of_a_query_that_was_sent_back_begins_anew(service: Service) -> None:
    run = service.learner.create_run()
    (asked,) = ids(service.learner.ask(run, query()))
    given = service.annotator.answer(service.annotator.lease(run=run))
    age(service, 3600)
    body = {"answer": given["answer"], "text": "It burned in the lava."}
    service.learner.post(f"/queries/{asked}/send-back", body, 201)
    assert stuck(service, run) == []


def test_a_query_is_stuck_whose_leases_expired_twice(service: Service) -> None:
    run = service.learner.create_run()
    (asked,) = ids(service.learner.ask(run, query()))
    expire(service, service.annotator, run)
    assert stuck(service, run) == []
    expire(service, service.annotator, run)
    assert stuck(service, run) == [(asked, ["expired"])]
    held = service.annotator.lease(run=run)
    assert stuck(service, run) == [(asked, ["expired"])], "also while somebody tries again"
    service.annotator.answer(held)
    assert stuck(service, run) == []


def test_a_query_is_stuck_that_every_annotator_of_the_last_day_skipped(service: Service) -> None:
    run, elsewhere = service.learner.create_run(), service.learner.create_run()
    (asked,) = ids(service.learner.ask(run, query()))
    other, idle, former = service.annotators(3)
    former.lease(run=run, kinds=["inspect_lo"], expect=204)
    idle.lease(run=elsewhere, expect=204)
    other.release(other.lease(run=run))
    for each in (service.annotator, other):
        assert stuck(service, run) == []
        held = each.lease(run=run)
        each.release(held, skip=True, reason="too dark")
    assert stuck(service, run) == [(asked, ["skipped"])], "two take other kinds, or queries of another run"
    former.lease(run=elsewhere, expect=204)
    idle.lease()
    assert stuck(service, run) == [], "one who takes any query is at it"


def test_who_was_here_earlier_or_is_deactivated_does_not_count_among_those_who_skipped(service: Service) -> None:
    run = service.learner.create_run()
    (asked,) = ids(service.learner.ask(run, query()))
    earlier, gone = service.annotators(2)
    for each in (earlier, gone):
        each.release(each.lease(run=run))
    age(service, 24 * 3600)
    gone.release(gone.lease(run=run))
    held = service.annotator.lease(run=run)
    service.annotator.release(held, skip=True)
    assert stuck(service, run) == []
    service.admin.change(gone, active=False)
    assert stuck(service, run) == [(asked, ["skipped"])]


@pytest.mark.parametrize("state", ["paused", "finished"])
def test_nothing_is_stuck_in_a_run_that_asks_nobody(service: Service, state: str) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query())
    age(service, 3600)
    assert stuck(service, run) != []
    service.learner.patch(run, state=state)
    assert stuck(service, run) == []


def test_the_oldest_are_listed_and_all_are_counted(lite: Service) -> None:
    run = lite.learner.create_run()
    asked = ids(lite.learner.ask(run, *(query(ordinal=ordinal) for ordinal in range(25))))
    age(lite, 3600)
    found = lite.viewer.get(f"/runs/{run}/stuck")
    assert ([one["query"] for one in found["queries"]], found["total"]) == (asked[:20], 25)
    lite.viewer.get("/runs/nothing/stuck", 404)


def test_no_table_is_scanned(lite: Service) -> None:
    run = lite.learner.create_run()
    lite.learner.ask(run, query())
    said: list[tuple[str, Any]] = []
    note: Callable[..., None] = lambda conn, cursor, statement, values, *rest: said.append((statement, values))  # noqa: E731
    engine = lite.db.read_now(lambda tx: tx.conn.engine)
    event.listen(engine, "before_cursor_execute", note)
    lite.viewer.get(f"/runs/{run}/stuck")
    event.remove(engine, "before_cursor_execute", note)
    reads = [one for one in said if "presence" in one[0]]
    assert len(reads) == 1
    with lite.db.read_now(lambda tx: tx.conn.engine.connect()) as conn:
        plan = conn.exec_driver_sql("EXPLAIN QUERY PLAN " + reads[0][0], reads[0][1]).all()
    assert [row[3] for row in plan if row[3].startswith("SCAN") and "CONSTANT" not in row[3]] == []
