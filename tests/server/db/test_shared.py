"""On PostgreSQL, requests that wait are committed together, and two servers do not hold each other up."""

import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any

import pytest
from sqlalchemy import insert, select, text, update
from sqlalchemy.exc import IntegrityError
from tests.conftest import Cluster
from tests.server.kit import Json, in_process, query

from waypost import wire
from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import runs, users
from waypost_server.db.transaction import Tx
from waypost_server.db.wakeups import Topics
from waypost_server.leases import service as leases
from waypost_server.leases.request import LeaseRequest
from waypost_server.settings import Settings

ADD = Prepared(insert(users), ["name", "role", "created_at"])
NAMES = Prepared(select(users.c.name).order_by(users.c.name))


@pytest.fixture
def url(cluster: Cluster) -> str:
    return cluster.create()


@pytest.fixture
def db(url: str) -> Iterator[Database]:
    db = Database(url)
    yield db
    db.close()


@pytest.fixture
def other(url: str) -> Iterator[Database]:
    """Another server's."""
    db = Database(url)
    yield db
    db.close()


def add(name: str) -> Callable[[Tx], None]:
    """Return what adds a user by a statement that waits to be sent."""
    return lambda tx: ADD.run(tx.conn, {"name": name, "role": "viewer", "created_at": 0})


def names(tx: Tx) -> list[str]:
    return [row.name for row in NAMES.rows(tx.conn, {})]


def rename(old: str, new: str) -> Callable[[Tx], None]:
    def work(tx: Tx) -> None:
        assert tx.conn.execute(update(users).where(users.c.name == old).values(name=new)).rowcount == 1

    return work


@contextmanager
def group(db: Database) -> Iterator[Callable[[Callable[[], Any]], Future[Any]]]:
    """Yield what submits transactions, in their order, while another one keeps the writer busy: they are one group."""
    go, busy = threading.Event(), threading.Event()

    def hold(_: Tx) -> None:
        busy.set()
        assert go.wait(10)

    def submit(work: Callable[[], Any]) -> Future[Any]:
        before = db.load.waiting
        future = in_background(work)
        while db.load.waiting == before and not future.done():
            time.sleep(0.001)
        return future

    in_background(lambda: db.write_now(hold))
    assert busy.wait(10)
    yield submit
    go.set()


def together(db: Database, *works: Callable[[Tx], Any]) -> list[Future[Any]]:
    """Submit transactions that are one group."""
    with group(db) as submit:
        return [submit(lambda work=work: db.write_now(work)) for work in works]


def in_background(work: Callable[[], Any]) -> Future[Any]:
    future: Future[Any] = Future()

    def run() -> None:
        try:
            future.set_result(work())
        except Exception as error:
            future.set_exception(error)

    threading.Thread(target=run, daemon=True).start()
    return future


def test_what_waits_is_committed_together(db: Database) -> None:
    before = db.load.commits
    for future in together(db, *(add(f"user{number}") for number in range(20))):
        future.result(10)
    assert db.load.commits == before + 2
    assert len(db.read_now(names)) == 20


def test_one_that_is_refused_changes_nothing_and_the_others_stay(db: Database) -> None:
    def refuse(tx: Tx) -> None:
        add("half")(tx)
        raise errors.BudgetExhausted("no")

    first, refused, last = together(db, add("ann"), refuse, add("bea"))
    with pytest.raises(errors.BudgetExhausted):
        refused.result(10)
    assert (first.result(10), last.result(10)) == (None, None)
    assert db.read_now(names) == ["ann", "bea"]


@pytest.mark.parametrize("work", [names, add("cid"), lambda tx: None], ids=["read", "write", "nothing"])
@pytest.mark.parametrize("place", [0, 1, 2])
def test_a_statement_that_fails_late_fails_its_own_request(db: Database, place: int, work: Callable[[Tx], Any]) -> None:
    """It waits to be sent, so it fails within another request of the group, or with the commit."""
    db.write_now(add("ann"))
    works = [add("bea"), work]
    works.insert(place, add("ann"))
    futures = together(db, *works)
    with pytest.raises(IntegrityError, match="unique"):
        futures.pop(place).result(10)
    for future in futures:
        future.result(10)
    assert {"ann", "bea"} <= {*db.read_now(names)} <= {"ann", "bea", "cid"}


def test_a_request_after_one_that_failed_does_not_get_its_connection(db: Database) -> None:
    """psycopg may believe that a statement is prepared which the database never got."""

    def fail(tx: Tx) -> None:
        add("ann")(tx)
        names(tx)

    db.write_now(add("ann"))
    db.write_now(lambda tx: [names(tx) for _ in range(5)])  # it is prepared the next time
    first, failed, last = together(db, add("bea"), fail, names)
    with pytest.raises(IntegrityError, match="unique"):
        failed.result(10)
    assert (first.result(10), last.result(10)) == (None, ["ann", "bea"])


@pytest.mark.parametrize("n", [1, 2])
def test_a_database_that_goes_away_after_an_error_does_not_stop_the_writer(db: Database, n: int) -> None:
    tries = []

    def fail_once(tx: Tx) -> None:
        tries.append(tx)
        process = tx.conn.execute(text("SELECT pg_backend_pid()")).scalar_one()
        if len(tries) == 1:
            try:
                tx.conn.execute(text("SET LOCAL statement_timeout = 50"))
                tx.conn.execute(text("SELECT pg_sleep(10)"))
            finally:
                db.read_now(lambda tx: tx.conn.execute(text(f"SELECT pg_terminate_backend({process}, 5000)")).all())

    futures = together(db, fail_once, add("ann"))[:n]
    for future in futures:
        future.exception(10)
    db.write_now(add("bea"))
    assert "bea" in db.read_now(names)


def test_what_is_committed_is_not_repeated_if_nobody_can_be_told(url: str) -> None:
    def tell(_: Topics) -> None:
        raise RuntimeError("The event loop is closed")

    def add_and_wake(tx: Tx) -> None:
        add(f"user{len(names(tx))}")(tx)
        tx.wake("queue")

    db = Database(url, tell)
    for future in together(db, add_and_wake, add_and_wake):
        assert future.result(10) is None
    assert db.read_now(names) == ["user0", "user1"]
    assert db.load.commits == 2
    db.close()


def test_what_was_read_ahead_is_not_taken_for_what_another_request_reads(db: Database) -> None:
    def announce(tx: Tx) -> None:
        NAMES.ahead(tx.conn, {})

    futures = together(db, add("ann"), announce, add("bea"), names)
    assert futures[-1].result(10) == ["ann", "bea"]


def test_groups_of_two_servers_that_need_each_others_rows_both_go_on(db: Database, other: Database) -> None:
    db.write_now(lambda tx: [add(name)(tx) for name in ("ann", "bea")] and None)
    holding, committed = threading.Event(), threading.Event()

    def hold(tx: Tx) -> None:
        tx.conn.execute(select(users).where(users.c.name == "bea").with_for_update()).all()
        holding.set()
        assert committed.wait(10), "the other server did not commit what it had"

    held = in_background(lambda: other.write_now(hold))
    assert holding.wait(10)
    first, second, third = together(db, rename("ann", "art"), rename("bea", "ben"), add("cid"))
    first.result(10)  # is committed although the second one waits for the other server
    assert not second.done()
    committed.set()
    for future in (held, second, third):
        future.result(10)
    assert db.read_now(names) == ["art", "ben", "cid"]


def test_an_answer_waits_for_another_server_without_holding_up_its_group(url: str, other: Database) -> None:
    with in_process(url) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query())
        held: Json = service.annotator.lease()
        holding, committed = threading.Event(), threading.Event()

        def hold(tx: Tx) -> None:
            tx.conn.execute(select(runs).where(runs.c.id == run).with_for_update(key_share=True)).all()
            holding.set()
            assert committed.wait(10), "the other server did not commit what it had"

        locked = in_background(lambda: other.write_now(hold))
        assert holding.wait(10)
        with group(service.db) as submit:
            first = submit(lambda: service.db.write_now(add("first")))
            receipt = submit(lambda: service.annotator.answer(held))
        first.result(10)  # is committed although the answer waits for the other server
        assert not receipt.done()
        committed.set()
        locked.result(10)
        assert receipt.result(10)["query"] == held["query"]["id"]


def test_a_lease_reads_few_rows_however_many_its_annotator_answered(cluster: Cluster) -> None:
    """Tables that were never analyzed look small, and PostgreSQL plans a prepared statement once."""
    with in_process(cluster.create()) as service:
        run = service.learner.create_run()
        service.learner.ask(run, *(query(episode=episode) for episode in range(120)))
        for _ in range(100):
            service.annotator.answer(service.annotator.lease())
        own = service.db.read_now(
            lambda tx: tx.conn.execute(select(users.c.id).where(users.c.name == "abe")).scalar_one()
        )
        wish = LeaseRequest.of(wire.Lease(run=run), own, Settings())

        def read(tx: Tx) -> int:
            counts = "SELECT sum(seq_tup_read + coalesce(idx_tup_fetch, 0)) FROM pg_stat_xact_user_tables"
            return int(tx.conn.execute(text(f"{counts} WHERE relname IN ('answers', 'queries')")).scalar_one())

        def lease(tx: Tx) -> int:
            before = read(tx)
            assert leases.lease(tx, wish) is not None
            return read(tx) - before

        assert service.db.write_now(lease) < 50
