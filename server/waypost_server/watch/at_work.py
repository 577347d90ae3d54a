"""The list of annotators at work, bots included. A gold query is listed as the query that it looks like."""

import json
from collections import defaultdict
from collections.abc import Sequence
from typing import Any

from sqlalchemy import Row, case, func, or_, select

from waypost import wire
from waypost_server.db.functions import by_value
from waypost_server.db.tables import IS_LIVE, assignments, presence, queries, runs, users
from waypost_server.db.transaction import Tx


def at_work(tx: Tx, presence_seconds: float, lease_seconds: float, run: str | None) -> wire.AtWorkList:
    """List the annotators who asked for a query recently or hold one, in one run or in all, last seen first."""
    leases = _leases_by_user(tx, lease_seconds)
    names = select(users.c.id, users.c.name, presence).outerjoin(presence, presence.c.user_id == users.c.id)
    is_listed = or_(presence.c.asked_at > tx.now - presence_seconds, users.c.id.in_(list(leases)))
    found = [_at_work(row, leases.get(row.id, [])) for row in tx.conn.execute(names.where(is_listed))]
    chosen = [one for one in found if run is None or _works_on(one, run)]
    return wire.AtWorkList(annotators=sorted(chosen, key=lambda one: (-one.seen_at, one.annotator)))


def _leases_by_user(tx: Tx, lease_seconds: float) -> dict[int, list[tuple[float, wire.Holding]]]:
    """Return each user's leased queries, oldest first, each with the time its lease was last renewed."""
    live = (
        select(assignments, queries.c.kind, queries.c.episode)
        .add_columns(func.coalesce(runs.c.gold_of, runs.c.id).label("run"))
        .add_columns(case((runs.c.gold_of.is_not(None), queries.c.ask)).label("gold_ask"))
        .join(queries, queries.c.id == assignments.c.query_id)
        .join(runs, runs.c.id == queries.c.run_id)
        .where(IS_LIVE, assignments.c.expires_at > tx.now)
        .order_by(by_value(assignments.c.id))
    )
    leases: dict[int, list[tuple[float, wire.Holding]]] = defaultdict(list)
    for row in tx.conn.execute(live):
        episode = row.episode if row.gold_ask is None else json.loads(row.gold_ask)["episode"]
        holding = wire.Holding(query=row.query_id, run=row.run, kind=row.kind, episode=episode, leased_at=row.leased_at)
        leases[row.user_id].append((max(row.leased_at, row.expires_at - lease_seconds), holding))
    return leases


def _at_work(row: Row[Any], leases: Sequence[tuple[float, wire.Holding]]) -> wire.AtWork:
    return wire.AtWork(
        annotator=row.name,
        run=row.run_id,
        kinds=row.kinds.split(",") if row.kinds else None,
        seen_at=max([row.asked_at or 0.0, *(renewed_at for renewed_at, _ in leases)]),
        holds=[holding for _, holding in leases],
    )


def _works_on(one: wire.AtWork, run: str) -> bool:
    """Return whether an annotator holds a query of a run, or waits for one."""
    if one.holds:
        return any(holding.run == run for holding in one.holds)
    return one.run in (None, run)
