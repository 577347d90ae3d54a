"""Active time: an annotator's seconds of work since the last answer, by the database's clock, without idle time.

A lease, a heartbeat marked active, and an answer are signs of activity. The gap between two signs counts at most
`idle_seconds`, so a break costs nothing. Time counts once, however many queries an annotator holds: the time for a
query leased ahead starts when the query before it is answered.
"""

from typing import Any

from sqlalchemy import bindparam, exists, select, update

from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import IS_LIVE, active_time, assignments
from waypost_server.db.transaction import UPSERTS, Tx

FIND = Prepared(select(active_time).where(active_time.c.user_id == bindparam("user")).with_for_update())
_RECORD = Prepared(
    update(active_time)
    .where(active_time.c.user_id == bindparam("user"))
    .values(active_seconds=bindparam("active"), signalled_at=bindparam("now"))
)


def _start(insert: Any) -> Any:
    started = {"active_seconds": 0.0, "signalled_at": bindparam("now")}
    holding = exists().where(assignments.c.user_id == bindparam("user"), IS_LIVE)
    new = insert(active_time).values(user_id=bindparam("user"), **started)
    return new.on_conflict_do_update(index_elements=["user_id"], set_=started, where=~holding)


_START = Prepared({name: _start(insert) for name, insert in UPSERTS.items()})


def start(tx: Tx, user: int) -> None:
    """Start the clock of an annotator who gets a query and holds no other."""
    _START.run(tx.conn, {"user": user, "now": tx.now})


def signal(tx: Tx, user: int, idle_seconds: float) -> None:
    """Count the time since the last sign of activity, at most `idle_seconds`."""
    _record(tx, user, _active(tx, user, idle_seconds))


def take(tx: Tx, user: int, idle_seconds: float) -> float:
    """Return the active seconds since the last answer, and start again from 0."""
    active = _active(tx, user, idle_seconds)
    _record(tx, user, 0.0)
    return active


def _active(tx: Tx, user: int, idle_seconds: float) -> float:
    row = FIND.first(tx.conn, {"user": user})
    if row is None:  # the lease was granted before this table existed
        return 0.0
    return float(row.active_seconds + min(max(tx.now - row.signalled_at, 0.0), idle_seconds))


def _record(tx: Tx, user: int, active: float) -> None:
    _RECORD.run(tx.conn, {"user": user, "active": active, "now": tx.now})
