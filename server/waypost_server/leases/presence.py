"""Presence: which annotators are at work, so that a bot can leave queries to them.

An annotator is at work if they asked for a query recently or hold a lease. Requests with `defer` do not count.
"""

from collections.abc import Sequence
from typing import Any

from sqlalchemy import and_, bindparam, delete, exists, func, literal, or_, select
from sqlalchemy.sql.elements import ColumnElement

from waypost import wire
from waypost_server.db.functions import clock
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import IS_LIVE, assignments, presence, queries, skips
from waypost_server.db.transaction import UPSERTS, Tx

REFRESH_SECONDS = 3.0

ROW_OF = Prepared(select(presence).where(presence.c.user_id == bindparam("user")))
_ASKED = ("run_id", "kinds", "asked_at")
_RECORD = Prepared(
    {
        name: (new := insert(presence)).on_conflict_do_update(
            index_elements=["user_id"], set_={column: new.excluded[column] for column in _ASKED}
        )
        for name, insert in UPSERTS.items()
    },
    ["user_id", *_ASKED],
)


def record(tx: Tx, user: int, run: str | None, kinds: Sequence[wire.Kind] | None) -> None:
    """Record that an annotator asks for a query; while the annotator waits, write only every `REFRESH_SECONDS`."""
    names = None if kinds is None else ",".join(sorted(kinds))
    row = ROW_OF.first(tx.conn, {"user": user})
    if row and (row.run_id, row.kinds) == (run, names) and row.asked_at > tx.now - REFRESH_SECONDS:
        return
    _RECORD.run(tx.conn, {"user_id": user, "run_id": run, "kinds": names, "asked_at": tx.now})


def forget(tx: Tx, after: float) -> None:
    """Forget who asked for a query later than this time."""
    tx.conn.execute(delete(presence).where(presence.c.asked_at > after))


def _at_work(since: ColumnElement[Any], now: ColumnElement[Any]) -> ColumnElement[bool]:
    """Return the condition that an annotator asked after `since`, or holds a lease not requested with `defer`."""
    held = (assignments.c.user_id == presence.c.user_id, IS_LIVE, assignments.c.expires_at > now)
    return or_(presence.c.asked_at > since, exists().where(*held, assignments.c.deferring.is_(False)))


AT_WORK = _at_work(bindparam("since"), bindparam("now"))
OTHERS = Prepared(
    select(func.count()).where(
        _at_work(clock() - bindparam("seconds"), clock()),
        presence.c.user_id != bindparam("user"),
        or_(presence.c.run_id.is_(None), presence.c.run_id == func.coalesce(bindparam("run"), presence.c.run_id)),
    )
)


def others(tx: Tx, user: int, run: str | None, seconds: float) -> int:
    """Return how many other annotators at work accept queries of this run, or of any run."""
    return int(OTHERS.value(tx.conn, {"user": user, "run": run, "seconds": seconds}))


def takes() -> ColumnElement[bool]:
    """Return the condition that the annotator in a row of `presence` accepts a query."""
    return and_(~has_skipped(), accepts())


def has_skipped() -> ColumnElement[bool]:
    """Return the condition that the annotator in a row of `presence` has skipped a query."""
    by_them = exists().where(skips.c.query_id == queries.c.id, skips.c.user_id == presence.c.user_id)
    return by_them.correlate(queries, presence)  # both, also where only one of them is in the enclosing statement


def accepts() -> ColumnElement[bool]:
    """Return the condition that the annotator in a row of `presence` asked for the kind and run of a query, or any."""
    kinds = literal(",") + presence.c.kinds + ","
    return and_(
        or_(presence.c.run_id.is_(None), presence.c.run_id == queries.c.run_id),
        or_(presence.c.kinds.is_(None), kinds.like("%," + queries.c.kind + ",%")),
    )


def somebody_would_take() -> ColumnElement[bool]:
    """Return the condition that an annotator at work accepts the kind and run of a query, and did not skip it."""
    return exists().where(AT_WORK, takes())
