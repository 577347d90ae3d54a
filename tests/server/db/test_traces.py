"""The trace of an episode has what was committed, and nothing else."""

from contextlib import suppress

import pytest

from waypost.tracing import Step
from waypost_server.db.engine import Database
from waypost_server.db.transaction import Tx
from waypost_server.errors import NotFound


def fail(_: Tx) -> None:
    raise NotFound("Nothing is here.")


def test_a_step_ends_when_its_transaction_is_committed_and_never_if_it_is_undone(
    database_url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    ended: list[str] = []
    monkeypatch.setattr(Step, "end", lambda step: ended.append(step.name))

    def half(tx: Tx) -> None:
        tx.trace("kept", "run", 0, query=1)
        with suppress(NotFound), tx.part():
            tx.trace("undone part", "run", 0)
            fail(tx)
        assert ended == []

    def undone(tx: Tx) -> None:
        tx.trace("undone", "run", 1)
        fail(tx)

    db = Database(database_url)
    try:
        db.write_now(half)
        with pytest.raises(NotFound):
            db.write_now(undone)
    finally:
        db.close()
    assert ended == ["kept"]
