"""On PostgreSQL, prepared statements go to the database together: nothing changes but the number of round trips."""

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import pytest
from sqlalchemy import Connection, bindparam, insert, select, text, update
from sqlalchemy.exc import IntegrityError
from tests.conftest import Cluster
from tests.server.kit import in_process, query

from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.prepared import Prepared
from waypost_server.db.sending import Together
from waypost_server.db.tables import users
from waypost_server.db.transaction import Tx

ADD = Prepared(insert(users), ["name", "role", "created_at"])
RENAME = Prepared(update(users).where(users.c.name == bindparam("old")).values(name=bindparam("new")))
NAMES = Prepared(select(users.c.name).order_by(users.c.name))
OF_NAME = Prepared(select(users).where(users.c.name == bindparam("wanted")))


@pytest.fixture
def db(cluster: Cluster) -> Iterator[Database]:
    db = Database(cluster.create())
    yield db
    db.close()


def add(tx: Tx, name: str) -> None:
    ADD.run(tx.conn, {"name": name, "role": "viewer", "created_at": tx.now})


def names(tx: Tx) -> list[str]:
    return [row.name for row in NAMES.rows(tx.conn, {})]


def n_prepared(tx: Tx) -> int:
    return int(tx.conn.execute(text("SELECT count(*) FROM pg_prepared_statements")).scalar_one())


def test_what_was_not_read_is_stored_by_the_commit(db: Database) -> None:
    db.write_now(lambda tx: add(tx, "ann"))
    assert db.read_now(names) == ["ann"]


def test_a_statement_sees_what_came_before_it(db: Database) -> None:
    def work(tx: Tx) -> tuple[list[str], list[str]]:
        add(tx, "ann")
        RENAME.run(tx.conn, {"old": "ann", "new": "bea"})
        prepared = names(tx)
        add(tx, "cid")
        return prepared, list(tx.conn.execute(select(users.c.name).order_by(users.c.name)).scalars())

    assert db.write_now(work) == (["bea"], ["bea", "cid"])


def test_a_read_that_was_announced_is_read_in_its_place(db: Database) -> None:
    def work(tx: Tx) -> list[Any]:
        for name in ("ann", "bea", "ann"):
            OF_NAME.ahead(tx.conn, {"wanted": name})
        add(tx, "ann")
        found = [OF_NAME.first(tx.conn, {"wanted": name}) for name in ("ann", "bea")]
        return [*found, OF_NAME.one(tx.conn, {"wanted": "ann"}).name]

    assert db.write_now(work) == [None, None, "ann"]  # the first two were read before the name was there


@pytest.mark.parametrize("last", [lambda tx: None, names], ids=["commit", "read"])
def test_the_first_error_is_the_one_that_is_raised(db: Database, last: Any) -> None:
    def work(tx: Tx, more: int) -> None:
        for name in ("ann", "bea", "ann", *map(str, range(more))):
            add(tx, name)
        last(tx)

    for more in (0, 1, 10, 100, 1000):  # with many, its reply comes before the last one is sent
        with pytest.raises(IntegrityError, match="unique"):
            db.write_now(lambda tx, more=more: work(tx, more))
    assert db.read_now(names) == []
    db.write_now(lambda tx: add(tx, "ann"))
    assert db.read_now(names) == ["ann"]


def test_what_was_undone_is_not_sent_by_the_next_transaction(db: Database) -> None:
    class Undone(Exception):
        pass

    def fail(tx: Tx) -> None:
        add(tx, "bea")  # could not be sent later, where there is one
        raise Undone

    def part(tx: Tx) -> None:
        with tx.part():
            fail(tx)

    def fail_in_part(tx: Tx) -> None:
        add(tx, "bea")
        with pytest.raises(Undone):
            part(tx)
        add(tx, "dan")

    for _ in range(20):  # more often than there are connections
        with pytest.raises(Undone):
            db.write_now(fail)
    db.write_now(fail_in_part)
    assert db.read_now(names) == ["bea", "dan"]


def test_what_is_not_read_in_a_part_fails_in_it(db: Database) -> None:
    def part(tx: Tx) -> None:
        with tx.part():
            add(tx, "ann")

    def work(tx: Tx) -> None:
        add(tx, "ann")
        with pytest.raises(IntegrityError):
            part(tx)
        add(tx, "bea")

    db.write_now(work)
    assert db.read_now(names) == ["ann", "bea"]


def test_an_error_that_nobody_minds_does_not_become_a_commit(db: Database) -> None:
    def work(tx: Tx) -> None:
        add(tx, "ann")
        with suppress(IntegrityError):
            add(tx, "ann")
            names(tx)

    with pytest.raises(errors.StorageFailed, match="Nothing was stored"):
        db.write_now(work)
    assert db.read_now(names) == []


def test_a_connection_whose_pipeline_failed_is_not_used_again(db: Database) -> None:
    """psycopg may believe that a statement is prepared which the database never got."""

    def process(tx: Tx) -> int:
        return int(tx.conn.execute(text("SELECT pg_backend_pid()")).scalar_one())

    def work(tx: Tx) -> int:
        add(tx, "ann")
        with suppress(IntegrityError), tx.part():
            add(tx, "ann")
        return process(tx)

    failed = db.write_now(work)
    assert all(db.write_now(process) != failed for _ in range(5))
    assert db.read_now(names) == ["ann"]


def test_a_read_leaves_its_connection_the_statements_that_it_has_prepared(db: Database) -> None:
    """With a rollback, psycopg would forget them, and PostgreSQL would have to plan each one again."""
    for _ in range(100):  # by several connections, each often enough for the driver to prepare the statement
        db.read_now(names)
    assert all(db.read_now(n_prepared) for _ in range(8))


@pytest.mark.parametrize("by_a_reader", [True, False])
def test_a_connection_that_is_lost_costs_nobody_a_request(db: Database, by_a_reader: bool) -> None:
    others = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid != pg_backend_pid()"
    run = db.read_now if by_a_reader else db.write_now
    db.write_now(lambda tx: add(tx, "ann"))
    db.read_now(names)
    run(lambda tx: tx.conn.execute(text(f"{others} AND datname = current_database()")).all())
    assert db.read_now(names) == db.write_now(names) == ["ann"]


def test_a_lease_takes_five_round_trips_and_an_answer_three(cluster: Cluster, monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[int] = []
    flush = Together.flush

    def counting(line: Together, conn: Connection) -> None:
        if line.is_waiting:
            sent.append(1)
        flush(line, conn)

    with in_process(cluster.create()) as service:
        run = service.learner.create_run()
        service.learner.ask(run, *(query(ordinal=ordinal) for ordinal in range(3)))
        service.annotator.answer(service.annotator.lease())  # knows the annotator from now on
        monkeypatch.setattr(Together, "flush", counting)
        held = service.annotator.lease(run=run)
        n_lease = len(sent)
        service.annotator.answer(held)
        assert (n_lease, len(sent) - n_lease) == (5, 3)
