"""The queries of a run that are stuck: nobody takes them, their leases expire, or everybody skips them."""

from typing import Any

from sqlalchemy import Row, and_, exists, func, select

from waypost import wire
from waypost_server.db.functions import by_value
from waypost_server.db.tables import IS_UNANSWERED, assignments, comments, presence, queries, users
from waypost_server.db.transaction import Tx
from waypost_server.leases.presence import accepts, has_skipped
from waypost_server.runs import service as runs

WAITING_SECONDS = 10 * 60.0
EXPIRIES = 2
DAY = 24 * 3600.0
SHOWN = 20


def stuck(tx: Tx, run: str) -> wire.Stuck:
    """Return the oldest queries of a run that are stuck. Nothing is stuck in a run that is paused or finished.

    Raises:
        NotFound: there is no such run.
    """
    if runs.find(tx, run).state != "running":
        return wire.Stuck(queries=[], total=0)
    found = [one for row in tx.conn.execute(_pending(tx, run)) if (one := _stuck(row, tx.now)).reasons]
    return wire.Stuck(queries=found[:SHOWN], total=len(found))


def _pending(tx: Tx, run: str) -> Any:
    """Select the queries of a run that have no answer, oldest first, with their leases and skips."""
    leases = assignments.c.query_id == queries.c.id
    ended = select(func.max(assignments.c.ended_at)).where(leases).scalar_subquery()
    returns = comments.c.query_id == queries.c.id, comments.c.answer_id.is_not(None)
    returned = select(func.max(comments.c.created_at)).where(*returns).scalar_subquery()
    expiries = select(func.count()).where(leases, assignments.c.state == "expired").scalar_subquery()
    recent = and_(
        presence.c.asked_at > tx.now - DAY,
        exists().where(users.c.id == presence.c.user_id, users.c.deactivated_at.is_(None)),
        accepts(),
    )
    return (
        select(queries.c.id, queries.c.episode, queries.c.kind, queries.c.state, queries.c.created_at)
        .add_columns(ended.label("ended_at"), returned.label("returned_at"), expiries.label("expiries"))
        .add_columns(and_(exists().where(recent), ~exists().where(recent, ~has_skipped())).label("skipped"))
        .where(queries.c.run_id == run, IS_UNANSWERED)
        .order_by(by_value(queries.c.id))
    )


def _stuck(row: Row[Any], now: float) -> wire.StuckQuery:
    since = max(row.created_at, row.ended_at or 0.0, row.returned_at or 0.0)
    waits = row.state == "open"
    reasons: dict[wire.StuckReason, bool] = {
        "waiting": waits and since < now - WAITING_SECONDS,
        "expired": row.expiries >= EXPIRIES,
        "skipped": waits and row.skipped,
    }
    return wire.StuckQuery(
        query=row.id,
        episode=row.episode,
        kind=row.kind,
        reasons=[reason for reason, holds in reasons.items() if holds],
        open_since=since,
        expiries=row.expiries,
    )
