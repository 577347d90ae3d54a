"""Who is at work: annotators who asked of late or hold a lease, so that a bot can leave the queries to them."""

from collections.abc import Sequence
from typing import Any

from sqlalchemy import and_, bindparam, exists, false, or_, select
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.sql.elements import ColumnElement

from server import wire
from server.database import Tx
from server.tables import IS_LIVE, assignments, presence, queries, skips

REFRESH_SECONDS = 3.0

_KNOWN = select(presence).where(presence.c.user_id == bindparam("user"))


def note(tx: Tx, user: int, run: str | None, kinds: Sequence[wire.Kind] | None) -> None:
    """Note that an annotator asks for work; a waiting one is noted every few seconds only."""
    words = None if kinds is None else ",".join(sorted(kinds))
    known = tx.conn.execute(_KNOWN, {"user": user}).one_or_none()
    if known and (known.run_id, known.kinds) == (run, words) and known.asked_at > tx.now - REFRESH_SECONDS:
        return
    upsert = sqlite.insert if tx.conn.dialect.name == "sqlite" else postgresql.insert
    values: dict[str, Any] = {"run_id": run, "kinds": words, "asked_at": tx.now}
    tx.conn.execute(
        upsert(presence).values(user_id=user, **values).on_conflict_do_update(index_elements=["user_id"], set_=values)
    )


def who_would_take(tx: Tx, seconds: float) -> ColumnElement[bool]:
    """Return the condition that somebody at work takes a query: its kind, in its run, and has not skipped it."""
    busy = exists().where(
        assignments.c.user_id == presence.c.user_id,
        IS_LIVE,
        assignments.c.expires_at > tx.now,
        assignments.c.deferring.is_(False),
    )
    at_work = select(presence).where(or_(presence.c.asked_at > tx.now - seconds, busy))
    return or_(false(), *(_takes(row) for row in tx.conn.execute(at_work).all()))


def _takes(row: Any) -> ColumnElement[bool]:
    skipped = exists().where(skips.c.query_id == queries.c.id, skips.c.user_id == row.user_id)
    takes = [~skipped]
    if row.run_id is not None:
        takes.append(queries.c.run_id == row.run_id)
    if row.kinds is not None:
        takes.append(queries.c.kind.in_(row.kinds.split(",")))
    return and_(*takes)
