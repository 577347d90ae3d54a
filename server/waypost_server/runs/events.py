"""Events: the recorded changes of a run, in the order of their commits."""

import json
from collections.abc import Mapping
from typing import Any

from sqlalchemy import func, insert, select

from waypost import wire
from waypost_server.db.tables import events
from waypost_server.db.transaction import Tx

PAGE = 500  # events read at once
ANY = "events"  # the topic that a new event of any run wakes

_INSERT = insert(events).returning(events.c.id)


def topic(run: str) -> str:
    """Return the topic that a new event of a run wakes."""
    return f"events:{run}"


def add(tx: Tx, run: str, event: str, data: Mapping[str, Any]) -> int:
    """Record a change and return its id.

    The caller has locked the run's row, so the ids of a run grow in the order of the commits.
    """
    row = {"run_id": run, "event": event, "data": json.dumps(data), "created_at": tx.now}
    tx.wake(topic(run), ANY)
    return int(tx.conn.execute(_INSERT, row).scalar_one())


def newest(tx: Tx, run: str) -> int:
    """Return the id of a run's newest event, 0 before the first."""
    newest = select(func.coalesce(func.max(events.c.id), 0)).where(events.c.run_id == run)
    return int(tx.conn.execute(newest).scalar_one())


def newest_of_all(tx: Tx) -> int:
    """Return the id of the newest event of any run, 0 before the first."""
    return int(tx.conn.execute(select(func.coalesce(func.max(events.c.id), 0))).scalar_one())


def after(tx: Tx, run: str, cursor: int) -> list[wire.Event]:
    """Return the next events after a cursor, at most `PAGE`."""
    chosen = select(events).where(events.c.run_id == run, events.c.id > cursor).order_by(events.c.id).limit(PAGE)
    return [
        wire.Event(id=row.id, run=row.run_id, event=row.event, at=row.created_at, data=json.loads(row.data))
        for row in tx.conn.execute(chosen)
    ]
