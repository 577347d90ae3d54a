"""`/readyz` says whether this server can store an answer now."""

import resource
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from sqlalchemy import create_engine, text
from tests.server.kit import Service, in_process

from waypost_server.db.engine import parse
from waypost_server.db.transaction import Tx


def status(service: Service) -> int:
    return service.client.get("/readyz").status_code


def becomes(service: Service, wanted: int) -> bool:
    """Whether the reply has this status soon: a server may repeat what it found a second ago."""
    deadline = time.monotonic() + 10
    while status(service) != wanted:
        if time.monotonic() > deadline:
            return False
        time.sleep(0.1)
    return True


@contextmanager
def full_disk() -> Iterator[None]:
    """Let no file of this process grow past 16 KiB; the store's log is longer than that already."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (16_384, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))


def test_a_server_whose_disk_is_full_is_not_ready_until_there_is_space(lite: Service) -> None:
    with full_disk():
        reply = lite.client.get("/readyz")
        assert (reply.status_code, reply.json()["type"]) == (503, "/problems/storage-failed")
        assert lite.client.get("/healthz").status_code == 200
    assert becomes(lite, 200)


def stop_writer(tx: Tx) -> None:
    sys.exit()


@pytest.mark.filterwarnings("ignore:Exception in thread waypost-write")
def test_a_server_whose_writer_has_stopped_is_not_ready_and_keeps_nobody_waiting(lite: Service) -> None:
    threading.Thread(target=lambda: lite.db.write_now(stop_writer), daemon=True).start()
    assert becomes(lite, 503)
    assert lite.viewer.get("/runs")["runs"] == [], "reading still works"
    assert "restart" in lite.annotator.lease(503)["detail"]


def test_a_server_whose_store_is_locked_by_somebody_else_says_so_within_seconds(database_url: str) -> None:
    with in_process(database_url) as service:
        other = create_engine(parse(database_url))
        locked = "BEGIN IMMEDIATE" if other.dialect.name == "sqlite" else "LOCK TABLE alembic_version"
        with other.connect() as conn:
            conn.execute(text(locked))
            took = []
            while min(took, default=9.0) >= 8 and len(took) < 3:  # the machine may stall
                began = time.monotonic()
                assert status(service) == 503
                took.append(time.monotonic() - began)
            assert min(took) < 8
            conn.rollback()
        other.dispose()
        assert becomes(service, 200)


def test_asking_often_writes_seldom(lite: Service) -> None:
    def changes(tx: Tx) -> int:
        return int(tx.conn.execute(text("SELECT total_changes()")).scalar_one())

    before = lite.db.write_now(changes)
    assert [status(lite) for _ in range(20)] == [200] * 20
    assert lite.db.write_now(changes) - before <= 5, "it is checked once a second, and anybody may ask"
