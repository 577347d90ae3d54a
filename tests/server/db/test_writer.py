"""Writers: acknowledged means committed, whatever else is in the batch and whatever fails."""

import sqlite3
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from typing import Any

import pytest
from sqlalchemy import Engine, create_engine, event, text
from sqlalchemy.exc import OperationalError

from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.transaction import Tx
from waypost_server.db.writers.group_commit import GroupCommit


def add(name: str) -> Any:
    return lambda conn, _topics: conn.execute(text("INSERT INTO notes VALUES (:name)"), {"name": name}).rowcount


Hooks = list[Callable[[], None]]


@pytest.fixture
def before_begin() -> Hooks:
    """What happens just before each transaction begins."""
    return []


@pytest.fixture
def engine(tmp_path: Any, before_begin: Hooks) -> Iterator[Engine]:
    connect = {"check_same_thread": False, "timeout": 0.1}
    engine = create_engine(f"sqlite:///{tmp_path / 'notes.db'}", connect_args=connect)

    @event.listens_for(engine, "connect")
    def connected(dbapi: Any, _record: Any) -> None:
        dbapi.isolation_level = None

    @event.listens_for(engine, "begin")
    def begun(conn: Any) -> None:
        for hook in before_begin:
            hook()
        conn.exec_driver_sql("BEGIN IMMEDIATE")

    with engine.begin() as conn:
        conn.execute(text("CREATE TABLE notes (name TEXT UNIQUE)"))
    yield engine
    engine.dispose()


@pytest.fixture
def writer(engine: Engine) -> Iterator[GroupCommit]:
    writer = GroupCommit(engine, lambda _topics: None)
    yield writer
    writer.close()


def names(engine: Engine) -> list[str]:
    with engine.connect() as conn:
        return list(conn.execute(text("SELECT name FROM notes ORDER BY name")).scalars())


def held_up(writer: GroupCommit) -> threading.Event:
    """Keep the writer busy until the event is set, so that what is submitted meanwhile is one batch."""
    go, busy = threading.Event(), threading.Event()

    def wait(_conn: Any, _topics: Any) -> None:
        busy.set()
        go.wait(10)

    writer.submit(wait)
    busy.wait(10)
    return go


def test_what_waits_is_committed_together(writer: GroupCommit, engine: Engine) -> None:
    commits = []
    event.listen(engine, "commit", lambda _conn: commits.append(1))
    go = held_up(writer)
    futures = [writer.submit(add(str(number))) for number in range(50)]
    go.set()
    assert [future.result(10) for future in futures] == [1] * 50
    assert len(names(engine)) == 50
    assert len(commits) == 2


def test_one_that_fails_leaves_the_others_of_its_batch(writer: GroupCommit, engine: Engine) -> None:
    go = held_up(writer)
    first, twice, third = writer.submit(add("a")), writer.submit(add("a")), writer.submit(add("b"))
    go.set()
    assert (first.result(10), third.result(10)) == (1, 1)
    with pytest.raises(Exception, match="UNIQUE"):
        twice.result(10)
    assert names(engine) == ["a", "b"]


def test_what_a_refused_one_wrote_is_undone(writer: GroupCommit, engine: Engine) -> None:
    def refuse(conn: Any, topics: Any) -> None:
        add("half")(conn, topics)
        raise errors.BudgetExhausted("no")

    with pytest.raises(errors.BudgetExhausted):
        writer.submit(refuse).result(10)
    assert names(engine) == []


def test_nothing_is_acknowledged_if_the_commit_fails(writer: GroupCommit, engine: Engine) -> None:
    failing = [True]

    def fail(_conn: Any) -> None:
        if failing[0]:
            raise OperationalError("COMMIT", {}, Exception("disk I/O error"))

    event.listen(engine, "commit", fail)
    go = held_up(writer)
    futures = [writer.submit(add(str(number))) for number in range(3)]
    go.set()
    for future in futures:
        with pytest.raises(errors.StorageFailed, match=r"(Nothing|It is not known whether this) was stored"):
            future.result(10)
    assert names(engine) == []
    failing[0] = False
    assert writer.submit(add("after")).result(10) == 1


def test_a_database_that_fails_in_one_leaves_the_others_of_its_batch(writer: GroupCommit, engine: Engine) -> None:
    def fail(_conn: Any, _topics: Any) -> None:
        raise OperationalError("INSERT", {}, Exception("database or disk is full"))

    go = held_up(writer)
    first, failing, last = writer.submit(add("a")), writer.submit(fail), writer.submit(add("b"))
    go.set()
    assert (first.result(10), last.result(10)) == (1, 1)
    with pytest.raises(errors.StorageFailed, match="full"):
        failing.result(10)
    assert names(engine) == ["a", "b"]


class Intruder:
    """Another process, which takes the store's lock just before the writer's n-th attempt from now on."""

    def __init__(self, engine: Engine, before_begin: Hooks) -> None:
        self._store = sqlite3.connect(str(engine.url.database), isolation_level=None, check_same_thread=False)
        self._before_begin = before_begin
        self.attempts = 0

    def lock_at(self, attempt: int) -> None:
        def attempted() -> None:
            self.attempts += 1
            if self.attempts == attempt:
                self._store.execute("BEGIN IMMEDIATE")

        self._before_begin.append(attempted)

    def leave(self) -> None:
        self._store.close()


@pytest.fixture
def intruder(engine: Engine, before_begin: Hooks) -> Iterator[Intruder]:
    intruder = Intruder(engine, before_begin)
    yield intruder
    intruder.leave()


def test_a_locked_store_keeps_nobody_waiting_longer_than_one_attempt(
    writer: GroupCommit, engine: Engine, intruder: Intruder
) -> None:
    go = held_up(writer)
    futures = [writer.submit(add(str(number))) for number in range(3 * GroupCommit.largest)]
    intruder.lock_at(1)
    go.set()
    for future in futures:
        with pytest.raises(errors.StorageFailed, match=r"Nothing was stored \(database is locked\)") as refused:
            future.result(10)
        assert refused.value.retry_after == 1
    assert intruder.attempts == 1
    intruder.leave()
    assert writer.submit(add("after")).result(10) == 1
    assert names(engine) == ["after"]


def test_a_store_that_is_locked_while_a_batch_is_repeated_is_tried_once(
    writer: GroupCommit, engine: Engine, intruder: Intruder
) -> None:
    def fail(_conn: Any, _topics: Any) -> None:
        raise OperationalError("INSERT", {}, Exception("disk I/O error"))

    go = held_up(writer)
    futures = [writer.submit(add("a")), writer.submit(fail), *(writer.submit(add(str(n))) for n in range(20))]
    intruder.lock_at(3)
    go.set()
    assert futures[0].result(10) == 1
    for future in futures[1:]:
        with pytest.raises(errors.StorageFailed, match="database is locked"):
            future.result(10)
    assert intruder.attempts == 3, "the batch, the first job by itself, and the one that found the lock"


def test_closing_a_locked_store_ends(engine: Engine, intruder: Intruder) -> None:
    writer = GroupCommit(engine, lambda _topics: None)
    go = held_up(writer)
    futures = [writer.submit(add(str(number))) for number in range(2 * GroupCommit.largest)]
    intruder.lock_at(1)
    closing = threading.Thread(target=writer.close)
    closing.start()
    go.set()
    closing.join(10)
    assert not closing.is_alive()
    assert all(isinstance(future.exception(0), errors.StorageFailed) for future in futures)


def test_wake_ups_follow_the_commit(engine: Engine) -> None:
    seen: list[list[str]] = []
    writer = GroupCommit(engine, lambda topics: seen.append([*topics, *names(engine)]))
    writer.submit(lambda conn, topics: (add("a")(conn, topics), topics.add("queue"))).result(10)
    writer.close()
    assert seen == [["queue", "a"]]


def test_a_waiter_that_gives_up_does_not_stop_the_writer(writer: GroupCommit, engine: Engine) -> None:
    go = held_up(writer)
    given_up: Future[int] = writer.submit(add("unwanted"))
    assert given_up.cancel()
    go.set()
    assert writer.submit(add("next")).result(10) == 1
    assert names(engine) == ["next"]


def test_closing_finishes_what_was_submitted(engine: Engine) -> None:
    writer = GroupCommit(engine, lambda _topics: None)
    futures = [writer.submit(add(str(number))) for number in range(20)]
    writer.close()
    assert all(future.done() for future in futures)
    assert len(names(engine)) == 20


def test_sqlite_syncs_every_commit_to_disk(sqlite_url: str) -> None:
    db = Database(sqlite_url)

    def pragma(name: str) -> Any:
        return lambda tx: tx.conn.exec_driver_sql(f"PRAGMA {name}").scalar_one()

    assert db.write_now(pragma("synchronous")) == 2, "FULL"
    assert db.write_now(pragma("journal_mode")) == "wal"
    assert db.write_now(pragma("foreign_keys")) == 1
    assert db.read_now(pragma("query_only")) == 1
    db.close()


def test_postgresql_syncs_every_commit_to_disk(cluster: Any) -> None:
    db = Database(cluster.create())
    assert db.write_now(lambda tx: tx.conn.exec_driver_sql("SHOW synchronous_commit").scalar_one()) == "on"
    db.close()


def test_time_is_the_databases(database_url: str) -> None:
    import time

    db = Database(database_url)

    def now(tx: Tx) -> float:
        return tx.now

    before, read, after = time.time(), db.read_now(now), time.time()
    assert before - 0.01 <= read <= after + 0.01
    assert db.write_now(lambda tx: tx.now == tx.now)
    db.close()


def test_deadlocks_are_tried_again(cluster: Any) -> None:
    url = cluster.create()
    db, other = Database(url), Database(url)
    db.write_now(
        lambda tx: tx.conn.exec_driver_sql("CREATE TABLE pairs AS SELECT x, 0 AS n FROM generate_series(1, 2) x")
    )
    both = threading.Barrier(2, timeout=10)
    tries = []

    def cross(first: int, second: int) -> Any:
        def work(tx: Tx) -> None:
            tries.append(first)
            tx.conn.execute(text("UPDATE pairs SET n = n + 1 WHERE x = :x"), {"x": first})
            if len(tries) <= 2:
                both.wait()
            tx.conn.execute(text("UPDATE pairs SET n = n + 1 WHERE x = :x"), {"x": second})

        return work

    threads = [
        threading.Thread(target=server.write_now, args=(cross(a, b),)) for server, a, b in ((db, 1, 2), (other, 2, 1))
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(tries) >= 3
    rows = db.read_now(lambda tx: tx.conn.exec_driver_sql("SELECT n FROM pairs").scalars().all())
    assert rows == [2, 2]
    db.close()
    other.close()
