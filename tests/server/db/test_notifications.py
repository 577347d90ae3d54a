"""Notifications: a server process hears at once what another one committed, also after its connection was lost."""

import time
from collections.abc import Callable
from typing import Any

import pytest
from sqlalchemy import create_engine, text

from waypost_server.db.engine import Database
from waypost_server.db.notifications import CHANNEL, MOST_TOPICS
from waypost_server.db.wakeups import Topics

Heard = list[Topics]


@pytest.fixture
def two(cluster: Any) -> Any:
    """Two processes on one store: the first, and what the second hears."""
    url, heard = cluster.create(), Heard()
    one, other = Database(url, lambda _: None), Database(url, heard.append)
    yield one, heard
    one.close()
    other.close()


def commit(db: Database, *topics: str) -> None:
    db.write_now(lambda tx: tx.wake(*topics))


def until(is_so: Callable[[], bool], seconds: float = 10.0) -> bool:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if is_so():
            return True
        time.sleep(0.01)
    return False


def topics(heard: Heard) -> Topics:
    return set().union(*heard)


def test_another_process_hears_which_topics_changed(two: tuple[Database, Heard]) -> None:
    db, heard = two
    assert until(lambda: commit(db, "queue", "query:7") or topics(heard) == {"queue", "query:7"})


def test_more_topics_than_one_notification_takes_are_all_heard(two: tuple[Database, Heard]) -> None:
    db, heard = two
    many = {f"query:{number:012}" for number in range(5 * MOST_TOPICS + 3)}
    assert until(lambda: commit(db, "first") or topics(heard) == {"first"})
    commit(db, *many)
    assert until(lambda: topics(heard) == many | {"first"})


def test_what_is_committed_just_before_the_end_is_told(cluster: Any) -> None:
    url, heard = cluster.create(), Heard()
    other = Database(url, heard.append)
    for number in range(10):
        db = Database(url, lambda _: None)
        assert until(lambda db=db: commit(db, "first") or "first" in topics(heard))
        commit(db, f"last-{number}")
        db.close()
        heard_last = until(lambda number=number: f"last-{number}" in topics(heard), 2.0)
        heard.clear()
        assert heard_last
    other.close()


def test_a_process_does_not_hear_itself_again(cluster: Any) -> None:
    heard = Heard()
    db = Database(cluster.create(), heard.append)
    for _ in range(5):
        commit(db, "queue")
    time.sleep(0.3)
    db.close()
    assert heard == [{"queue"}] * 5


def test_it_hears_again_after_its_connections_were_cut(two: tuple[Database, Heard]) -> None:
    db, heard = two
    assert until(lambda: commit(db, "before") or topics(heard) == {"before"})
    engine = create_engine(db.url)
    with engine.begin() as conn:
        cut = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE query ~* :listening"
        assert conn.execute(text(cut), {"listening": f"^LISTEN {CHANNEL}|pg_notify"}).all()
    engine.dispose()
    assert until(lambda: commit(db, "after") or "after" in topics(heard))
