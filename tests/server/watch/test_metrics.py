"""`/metrics`: what the store holds, what this process did, and that reading it never reads a table that grows."""

import re
import time
from collections.abc import Mapping
from typing import Any

import pytest
from sqlalchemy import Connection, event, text
from sqlalchemy.exc import OperationalError
from tests.server.kit import Service, in_process, query
from tests.server.kit import together as at_once

from waypost_server import errors
from waypost_server.db.transaction import Tx
from waypost_server.http.traffic import Traffic
from waypost_server.runs import service as runs
from waypost_server.watch import metrics

SAMPLE = re.compile(r'^(waypost_\w+(?:\{(?:\w+="[^"{}]*",?)+\})?) (\d+(?:\.\d+)?(?:e-\d+)?)$')


def read(service: Service) -> Mapping[str, float]:
    """All samples by name and labels; every line must be a sample or a comment."""
    reply = service.client.get("/metrics", headers=service.viewer.headers)
    assert reply.headers["content-type"].startswith("text/plain; version=0.0.4")
    lines = [line for line in reply.text.splitlines() if not line.startswith("# ")]
    found = [SAMPLE.match(line) for line in lines]
    assert all(found), [line for line, one in zip(lines, found, strict=True) if one is None]
    return {one[1]: float(one[2]) for one in found if one is not None}


def test_what_was_done_is_counted_once_it_is_committed(database_url: str) -> None:
    with in_process(database_url, lease_seconds=0.2, reap_seconds=0.1) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query(), query(ordinal=1), query("label_lo", ordinal=2))
        held = service.annotator.lease()
        service.annotator.answer(held)
        service.annotator.answer(held)  # the same receipt once more
        again = service.annotator.retract(held)
        service.annotator.release(again)
        service.annotator.release(service.annotator.lease(), skip=True)
        late = service.annotator.lease(kinds=["label_lo"])
        time.sleep(0.6)
        service.annotator.answer(late, expect=409)
        found = read(service)
    assert found['waypost_answers_total{kind="counted"}'] == 1
    assert found['waypost_answers_total{kind="late"}'] == 1
    assert found['waypost_units_total{entry="charge"}'] == found['waypost_units_total{entry="refund"}'] == 1
    assert found["waypost_leases_total"] == 4
    assert found['waypost_leases_ended_total{how="expired"}'] == 1
    assert found['waypost_leases_ended_total{how="released"}'] == 1
    assert found['waypost_leases_ended_total{how="skipped"}'] == 1
    assert found['waypost_queries{state="open"}'] == 3
    assert found['waypost_queries{state="leased"}'] == found["waypost_cost_units"] == 0
    assert 0.6 < found["waypost_queue_age_seconds"] < 60
    assert found['waypost_runs{state="running"}'] == 1


def test_what_was_undone_is_not_counted(service: Service) -> None:
    def refused(tx: Tx) -> None:
        tx.count("answers", "late")
        raise errors.NotFound("no")

    def partly(tx: Tx) -> None:
        tx.count("answers", "counted", 5)
        with pytest.raises(errors.NotFound), tx.part():
            refused(tx)

    with pytest.raises(errors.NotFound):
        service.db.write_now(refused)
    service.db.write_now(partly)
    found = read(service)
    assert found['waypost_answers_total{kind="counted"}'] == 5
    assert found['waypost_answers_total{kind="late"}'] == 0


def test_what_fails_at_its_commit_is_not_counted(service: Service) -> None:
    def fail(_conn: Connection) -> None:
        raise OperationalError("COMMIT", {}, Exception("disk I/O error"))

    engine = service.db._engine
    event.listen(engine, "commit", fail)
    with pytest.raises(errors.StorageFailed):
        service.db.write_now(lambda tx: tx.count("answers", "counted"))
    event.remove(engine, "commit", fail)
    assert read(service)['waypost_answers_total{kind="counted"}'] == 0


def test_requests_are_counted_by_operation_and_status(lite: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    run = lite.learner.create_run()
    for _ in range(3):
        lite.viewer.get(f"/runs/{run}")
    lite.viewer.get("/runs/000000000000", 404)

    def fail(tx: Tx, run: str) -> None:
        raise RuntimeError(f"{tx} {run}")

    with monkeypatch.context() as broken:
        broken.setattr(runs, "view", fail)
        with pytest.raises(RuntimeError):
            lite.viewer.get(f"/runs/{run}", 500)
    lite.client.get("/no-such-file")
    found = read(lite)
    for status, n in (("2xx", 3), ("4xx", 1), ("5xx", 1)):
        assert found[f'waypost_requests_total{{operation="getRun",status="{status}"}}'] == n
    assert found['waypost_request_seconds_count{operation="getRun"}'] == 5
    assert found['waypost_request_seconds_bucket{operation="getRun",le="+Inf"}'] == 5
    assert found['waypost_request_seconds_sum{operation="getRun"}'] > 0
    assert any(name.startswith('waypost_requests_total{operation="none"') for name in found)


def test_a_request_is_in_every_bucket_that_is_long_enough() -> None:
    traffic = Traffic()
    for seconds in (0.001, 0.005, 0.0051, 61.0):
        traffic.count("lease", 200, seconds)
    buckets = dict(traffic.at_most("lease"))
    assert (buckets["0.005"], buckets["0.01"], buckets["60.0"], buckets["+Inf"]) == (2, 3, 3, 4)


def test_the_writer_says_what_waits_and_how_much_it_commits_at_once(service: Service) -> None:
    run = service.learner.create_run()
    before = read(service)
    at_once(lambda number: service.learner.ask(run, query(episode=number)), 8)
    found = read(service)
    assert found["waypost_writer_transactions_total"] - before["waypost_writer_transactions_total"] >= 8
    assert found["waypost_writer_commits_total"] <= found["waypost_writer_transactions_total"]
    assert found["waypost_writer_waiting"] == 0
    assert found["waypost_writer_largest_batch"] >= 1


@pytest.fixture
def grown(service: Service) -> Service:
    """A service with many closed queries and one that is leased."""
    run = service.learner.create_run()
    (asked,) = service.learner.ask(run, query())

    def grow(tx: Tx) -> None:
        columns = "run_id, kind, priority, run_priority, ask, digest, reserve, revision, used, created_at"
        series = (
            "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 5000) "
            f"INSERT INTO queries (episode, ordinal, state, {columns}) SELECT i, 1, 'cancelled', {columns} "
            f"FROM queries CROSS JOIN n WHERE queries.id = {asked['id']}"
        )
        tx.conn.execute(text(series))
        if not tx.one_writer:
            tx.conn.execute(text("ANALYZE"))

    service.db.write_now(grow)
    service.annotator.lease()
    return service


@pytest.mark.parametrize("n_open", [0, 3])
def test_reading_them_reads_no_table_that_grows(grown: Service, n_open: int) -> None:
    if n_open:
        grown.learner.ask(grown.learner.create_run(), *(query(ordinal=n) for n in range(n_open)))
    lite = grown.db.url.get_backend_name() == "sqlite"
    explain = "EXPLAIN QUERY PLAN " if lite else "EXPLAIN "
    plans: list[str] = []

    def read_plans(tx: Tx) -> None:
        def explained(conn: Connection, cursor: Any, statement: str, parameters: Any, *_: Any) -> None:
            if not statement.startswith("EXPLAIN"):
                rows = conn.exec_driver_sql(explain + statement, parameters).all()
                plans.append("\n".join(str(row[-1]) for row in rows))

        event.listen(tx.conn, "before_cursor_execute", explained)
        metrics.of_store(tx)

    grown.db.read_now(read_plans)
    assert len(plans) >= 6
    scanned = {name for plan in plans for name in (WHOLE if lite else SEQUENTIAL).findall(plan)}
    few = {"runs", "webhooks"} | (set() if lite else {"assignments", "deliveries"})  # PostgreSQL: they are small here
    assert scanned <= few, plans


# What SQLite reads in another way than by its key or by an index of only those rows that are counted.
WHOLE = re.compile(
    r"(?:SCAN|SEARCH) (\w+)\b(?! USING INTEGER PRIMARY KEY)"
    r"(?! USING (?:COVERING )?INDEX (?:ix_queries_\w*next|uq_assignments_live|ix_deliveries_pending))"
)
SEQUENTIAL = re.compile(r"Seq Scan on (\w+)")
