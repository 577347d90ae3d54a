"""Active seconds: how long an annotator has worked since the last answer, by the database's clock.

A lease, a heartbeat that says so, and an answer are signs of activity. The gap between two of them counts, but never
more than the idle cap, so a coffee costs nothing. A person's time counts once, however many queries they hold: one
that is leased ahead begins to cost when the one before it is answered.
"""

from typing import Any

from sqlalchemy import bindparam, exists, select, update

from waypost_server.db.engine import UPSERTS, Tx
from waypost_server.db.tables import IS_LIVE, activity, assignments

_KNOWN = select(activity).where(activity.c.user_id == bindparam("user")).with_for_update()
_NOTE = (
    update(activity)
    .where(activity.c.user_id == bindparam("user"))
    .values(active_seconds=bindparam("active"), signalled_at=bindparam("now"))
)


def _begin(insert: Any) -> Any:
    started = {"active_seconds": 0.0, "signalled_at": bindparam("now")}
    holding = exists().where(assignments.c.user_id == bindparam("user"), IS_LIVE)
    new = insert(activity).values(user_id=bindparam("user"), **started)
    return new.on_conflict_do_update(index_elements=["user_id"], set_=started, where=~holding)


_BEGIN = {name: _begin(insert) for name, insert in UPSERTS.items()}


def begin(tx: Tx, user: int) -> None:
    """Start the clock for an annotator who is given a query and holds no other."""
    tx.conn.execute(_BEGIN[tx.conn.dialect.name], {"user": user, "now": tx.now})


def signal(tx: Tx, user: int, idle_seconds: float) -> None:
    """Count the time since the last sign of activity, up to the cap."""
    _note(tx, user, _active(tx, user, idle_seconds))


def take(tx: Tx, user: int, idle_seconds: float) -> float:
    """Return the active seconds since the last answer, and start over."""
    active = _active(tx, user, idle_seconds)
    _note(tx, user, 0.0)
    return active


def _active(tx: Tx, user: int, idle_seconds: float) -> float:
    row = tx.conn.execute(_KNOWN, {"user": user}).one_or_none()
    if row is None:  # the lease is older than this table
        return 0.0
    return float(row.active_seconds + min(max(tx.now - row.signalled_at, 0.0), idle_seconds))


def _note(tx: Tx, user: int, active: float) -> None:
    tx.conn.execute(_NOTE, {"user": user, "active": active, "now": tx.now})
