"""Prepared statements: they return and raise what SQLAlchemy would, in the same transaction, on each database."""

import sqlite3
from collections.abc import Iterator
from contextlib import closing

import pytest
from sqlalchemy import bindparam, insert, make_url, select, update
from sqlalchemy.exc import IntegrityError
from tests.server.kit import Service, query

from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import queries, users
from waypost_server.db.transaction import Tx

NAMES = Prepared(select(users.c.name).order_by(users.c.id))
OF_NAME = Prepared(select(users).where(users.c.name == bindparam("wanted")))
ADD = Prepared(insert(users).returning(users.c.id), ["name", "role", "created_at"])
RENAME = Prepared(update(users).where(users.c.name == bindparam("old")).values(name=bindparam("new")))


@pytest.fixture
def db(database_url: str) -> Iterator[Database]:
    db = Database(database_url)
    yield db
    db.close()


def add(tx: Tx, name: str) -> int:
    return int(ADD.value(tx.conn, {"name": name, "role": "viewer", "created_at": tx.now}))


def names(tx: Tx) -> list[str]:
    return [row.name for row in NAMES.rows(tx.conn, {})]


def test_its_rows_are_those_of_sqlalchemy(service: Service) -> None:
    (asked,) = service.learner.ask(service.learner.create_run(), query())
    statement = select(queries).where(queries.c.id == bindparam("query"))
    parameters = {"query": asked["id"]}

    def both(tx: Tx) -> tuple[object, object]:
        return Prepared(statement).one(tx.conn, parameters), tx.conn.execute(statement, parameters).one()

    prepared, usual = service.db.read_now(both)
    assert prepared._asdict() == usual._asdict()
    assert prepared.used is False


def test_its_columns_are_those_of_its_rows(service: Service) -> None:
    run = service.learner.create_run()
    statement = Prepared(select(queries.c.id, queries.c.used).where(queries.c.run_id == bindparam("run")))

    def columns(tx: Tx) -> tuple[list[int], list[bool]]:
        found = statement.columns(tx.conn, {"run": run})
        return list(found.id), list(found.used)

    assert service.db.read_now(columns) == ([], [])
    asked = service.learner.ask(run, query(ordinal=0), query(ordinal=1))
    ids, used = service.db.read_now(columns)
    assert ids == [one["id"] for one in asked]
    assert [one is False for one in used] == [True, True], "not 0, as SQLite stores it"


def test_it_is_a_part_of_the_transaction(db: Database) -> None:
    class Undone(Exception):
        pass

    def fail(tx: Tx) -> None:
        add(tx, "ann")
        assert names(tx) == ["ann"]
        raise Undone

    with pytest.raises(Undone):
        db.write_now(fail)
    assert db.read_now(names) == []


def test_a_part_that_fails_is_undone_alone(db: Database) -> None:
    def two(tx: Tx) -> None:
        with tx.part():
            add(tx, "bea")
            add(tx, "ann")

    def work(tx: Tx) -> None:
        add(tx, "ann")
        with pytest.raises(IntegrityError):
            two(tx)
        RENAME.run(tx.conn, {"old": "ann", "new": "cid"})

    db.write_now(work)
    assert db.read_now(names) == ["cid"]


def test_to_read_a_first_row_keeps_nothing_open(sqlite_url: str) -> None:
    with closing(Database(sqlite_url)) as db:
        for name in ("ann", "bea", "cid", "dan"):
            db.write_now(lambda tx, name=name: add(tx, name))
        assert db.read_now(lambda tx: NAMES.first(tx.conn, {})).name == "ann"
        db.write_now(lambda tx: RENAME.run(tx.conn, {"old": "ann", "new": "eve"}))
        with closing(sqlite3.connect(make_url(sqlite_url).database or "")) as other:
            (is_busy, _, _) = other.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchone()
        assert not is_busy, "the read still needs the log"


def test_a_read_that_begins_with_one_sees_one_moment(db: Database) -> None:
    def twice(tx: Tx) -> tuple[list[str], list[str]]:
        before = names(tx)
        db.write_now(lambda other: add(other, "ann"))
        return before, names(tx)

    assert db.read_now(twice) == ([], [])
    assert db.read_now(lambda tx: OF_NAME.first(tx.conn, {"wanted": "ann"})).role == "viewer"
    assert db.read_now(lambda tx: OF_NAME.first(tx.conn, {"wanted": "bea"})) is None


def test_a_missing_parameter_is_an_error_not_null(db: Database) -> None:
    with pytest.raises((KeyError, errors.StorageFailed), match="wanted"):
        db.read_now(lambda tx: OF_NAME.first(tx.conn, {}))
