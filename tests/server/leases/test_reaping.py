"""The task that ends leases: also when the clock was set back, and after an error of the database."""

import time

import pytest
from sqlalchemy import update
from tests.server.kit import in_process, query

from waypost_server.db.tables import assignments, presence
from waypost_server.db.transaction import Tx


@pytest.mark.parametrize("hours", [1, 24])
def test_a_clock_that_is_set_back_keeps_no_lease(database_url: str, hours: int) -> None:
    with in_process(database_url, reap_seconds=0.1) as service:
        run = service.learner.create_run()
        service.learner.ask(run, query())
        held = service.annotator.lease()
        service.db.write_now(lambda tx: set_back(tx, hours * 3_600.0))
        again = service.user("otto", "annotator").lease(wait=30, defer=1)
        assert again["query"]["id"] == held["query"]["id"]
        assert service.annotator.renew(held, expect=409)["type"] == "/problems/lease-expired"
        service.annotator.answer(held, expect=409)
        assert service.learner.costs(run)["total"] == 0


def test_a_clock_that_is_set_back_a_little_takes_no_query_away(database_url: str) -> None:
    with in_process(database_url, reap_seconds=0.1) as service:
        service.learner.ask(service.learner.create_run(), query())
        held = service.annotator.lease()
        service.db.write_now(lambda tx: set_back(tx, 2.0))
        time.sleep(0.5)
        service.annotator.answer(held)


def test_leases_end_again_after_an_error_of_the_database(database_url: str) -> None:
    def rename(old: str, new: str) -> None:
        service.db.write_now(lambda tx: tx.conn.exec_driver_sql(f"ALTER TABLE {old} RENAME TO {new}"))

    with in_process(database_url, reap_seconds=0.1) as service:
        service.learner.ask(service.learner.create_run(), query())
        held = service.annotator.lease()
        rename("presence", "gone")
        time.sleep(0.5)
        rename("gone", "presence")
        service.db.write_now(lambda tx: set_back(tx, 3_600.0))
        again = service.user("otto", "annotator").lease(wait=30, defer=1)
        assert again["query"]["id"] == held["query"]["id"]


def set_back(tx: Tx, seconds: float) -> None:
    """Leave a store as it is after its clock was set back."""
    later = {column: column + seconds for column in (assignments.c.leased_at, assignments.c.expires_at)}
    tx.conn.execute(update(assignments).values(later))
    tx.conn.execute(update(presence).values(asked_at=presence.c.asked_at + seconds))
