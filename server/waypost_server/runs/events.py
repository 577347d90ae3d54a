"""Events: the recorded changes of a run, in the order of their commits."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from pydantic_core import to_json
from sqlalchemy import Text, cast, func, insert, select

from waypost import wire
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import events
from waypost_server.db.transaction import Tx
from waypost_server.webhooks import outbox

PAGE = 500  # events read at once
ANY = "events"  # the topic that a new event of any run wakes

_INSERT = Prepared(insert(events), ["run_id", "event", "data", "created_at"])
_NEWEST = select(func.coalesce(func.max(events.c.id), 0))
_RUNNING = select(cast(func.pg_current_snapshot(), Text))  # "xmin:xmax:xid,xid"; both selects have one snapshot


@dataclass(frozen=True)
class Newest:
    """The newest event of all runs, and the transactions that can still commit an older one.

    Runs do not lock each other, so an event can be committed after one with a higher id. Its transaction was running
    when the newer event was read.
    """

    id: int
    running: frozenset[str] = frozenset()

    def since(self, earlier: "Newest") -> "Newest":
        """Return what is known after an earlier look; equal to it if no event was committed in between.

        The end of a transaction counts as a change, although it may have committed no event.
        """
        return self if self.id != earlier.id else Newest(self.id, earlier.running & self.running)


def topic(run: str) -> str:
    """Return the topic that a new event of a run wakes."""
    return f"events:{run}"


def add(tx: Tx, run: str, event: str, data: Mapping[str, Any]) -> None:
    """Record a change; then it is the `newest` of the run.

    The caller has locked the run's row, so the ids of a run grow in the order of the commits.
    """
    row = {"run_id": run, "event": event, "data": to_json(data).decode(), "created_at": tx.now}
    tx.wake(topic(run), ANY)
    _INSERT.run(tx.conn, row)


def announce(tx: Tx, topic: wire.WebhookTopic, run: str, data: Mapping[str, Any]) -> None:
    """Announce the newest event of a run to the webhooks with this topic.

    Args:
        tx: the transaction of the change.
        topic: the kind of change.
        run: the run's id.
        data: the fields of the message's data, except `run` and `event`.
    """
    if webhooks := outbox.wanting(tx, topic):
        outbox.announce(tx, webhooks, topic, run, {"event": newest(tx, run), **data})


def newest(tx: Tx, run: str) -> int:
    """Return the id of a run's newest event, 0 before the first."""
    return int(tx.conn.execute(_NEWEST.where(events.c.run_id == run)).scalar_one())


def newest_of_all(tx: Tx) -> Newest:
    """Return the newest event of all runs; its id is 0 before the first."""
    if tx.one_writer:
        return Newest(tx.conn.execute(_NEWEST).scalar_one())
    row = tx.conn.execute(select(_NEWEST.scalar_subquery(), _RUNNING.scalar_subquery())).one()
    return Newest(row[0], frozenset(filter(None, row[1].split(":")[2].split(","))))


def after(tx: Tx, run: str, cursor: int) -> list[wire.Event]:
    """Return the next events after a cursor, at most `PAGE`."""
    chosen = select(events).where(events.c.run_id == run, events.c.id > cursor).order_by(events.c.id).limit(PAGE)
    return [
        wire.Event(id=row.id, run=row.run_id, event=row.event, at=row.created_at, data=json.loads(row.data))
        for row in tx.conn.execute(chosen)
    ]
