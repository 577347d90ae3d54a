"""Who is at work: annotators who asked of late or hold a lease, so that a bot can leave the queries to them."""

from collections import defaultdict
from collections.abc import Sequence
from typing import Any

from sqlalchemy import Row, and_, bindparam, exists, false, func, literal, or_, select
from sqlalchemy.sql.elements import ColumnElement

from waypost import wire
from waypost_server.db.engine import Tx
from waypost_server.db.tables import IS_LIVE, assignments, presence, queries, runs, skips, users

REFRESH_SECONDS = 3.0

_KNOWN = select(presence).where(presence.c.user_id == bindparam("user"))


def note(tx: Tx, user: int, run: str | None, kinds: Sequence[wire.Kind] | None) -> None:
    """Note that an annotator asks for work; a waiting one is noted every few seconds only."""
    words = None if kinds is None else ",".join(sorted(kinds))
    known = tx.conn.execute(_KNOWN, {"user": user}).one_or_none()
    if known and (known.run_id, known.kinds) == (run, words) and known.asked_at > tx.now - REFRESH_SECONDS:
        return
    values: dict[str, Any] = {"run_id": run, "kinds": words, "asked_at": tx.now}
    new = tx.upsert(presence).values(user_id=user, **values)
    tx.conn.execute(new.on_conflict_do_update(index_elements=["user_id"], set_=values))


# Asked after `since`, or holds a lease `now`.
AT_WORK = or_(
    presence.c.asked_at > bindparam("since"),
    exists().where(
        assignments.c.user_id == presence.c.user_id,
        IS_LIVE,
        assignments.c.expires_at > bindparam("now"),
        assignments.c.deferring.is_(False),
    ),
)
_AT_WORK = select(presence).where(AT_WORK)
_OTHERS = select(func.count()).where(
    AT_WORK,
    presence.c.user_id != bindparam("user"),
    or_(presence.c.run_id.is_(None), presence.c.run_id == func.coalesce(bindparam("run"), presence.c.run_id)),
)


def who_would_take(tx: Tx, seconds: float) -> ColumnElement[bool]:
    """Return the condition that somebody at work takes a query: its kind, in its run, and has not skipped it."""
    at_work = tx.conn.execute(_AT_WORK, {"since": tx.now - seconds, "now": tx.now}).all()
    return or_(false(), *(_takes(row) for row in at_work))


def others(tx: Tx, user: int, run: str | None, seconds: float) -> int:
    """Return how many other annotators are at work who take queries of that run, or of any run."""
    known = {"since": tx.now - seconds, "now": tx.now, "user": user, "run": run}
    return int(tx.conn.execute(_OTHERS, known).scalar_one())


def takes() -> ColumnElement[bool]:
    """Return the condition that whoever a row of `presence` is about takes a query."""
    skipped = exists().where(skips.c.query_id == queries.c.id, skips.c.user_id == presence.c.user_id)
    kinds = literal(",") + presence.c.kinds + ","
    return and_(
        ~skipped,
        or_(presence.c.run_id.is_(None), presence.c.run_id == queries.c.run_id),
        or_(presence.c.kinds.is_(None), kinds.like("%," + queries.c.kind + ",%")),
    )


def _takes(row: Any) -> ColumnElement[bool]:
    skipped = exists().where(skips.c.query_id == queries.c.id, skips.c.user_id == row.user_id)
    takes = [~skipped]
    if row.run_id is not None:
        takes.append(queries.c.run_id == row.run_id)
    if row.kinds is not None:
        takes.append(queries.c.kind.in_(row.kinds.split(",")))
    return and_(*takes)


def at_work(tx: Tx, presence_seconds: float, lease_seconds: float, run: str | None) -> wire.AtWorkList:
    """Return who asked for work of late or holds a query, bots too; of one run, or of all."""
    held = _held(tx, lease_seconds)
    names = select(users.c.id, users.c.name, presence).outerjoin(presence, presence.c.user_id == users.c.id)
    there = or_(presence.c.asked_at > tx.now - presence_seconds, users.c.id.in_(list(held)))
    found = [_at_work(row, held.get(row.id, [])) for row in tx.conn.execute(names.where(there))]
    chosen = [one for one in found if run is None or _works_on(one, run)]
    return wire.AtWorkList(annotators=sorted(chosen, key=lambda one: (-one.seen_at, one.annotator)))


def _held(tx: Tx, lease_seconds: float) -> dict[int, list[tuple[float, wire.Holding]]]:
    """Return what each user holds, oldest first, each with when its lease was last taken or renewed."""
    live = (
        select(assignments, queries.c.run_id, queries.c.kind, queries.c.episode)
        .join(queries, queries.c.id == assignments.c.query_id)
        .join(runs, runs.c.id == queries.c.run_id)
        .where(IS_LIVE, assignments.c.expires_at > tx.now, runs.c.gold_of.is_(None))
        .order_by(assignments.c.id)
    )
    held: dict[int, list[tuple[float, wire.Holding]]] = defaultdict(list)
    for row in tx.conn.execute(live):
        holding = wire.Holding(
            query=row.query_id, run=row.run_id, kind=row.kind, episode=row.episode, leased_at=row.leased_at
        )
        held[row.user_id].append((max(row.leased_at, row.expires_at - lease_seconds), holding))
    return held


def _at_work(row: Row[Any], held: Sequence[tuple[float, wire.Holding]]) -> wire.AtWork:
    return wire.AtWork(
        annotator=row.name,
        run=row.run_id,
        kinds=row.kinds.split(",") if row.kinds else None,
        seen_at=max([row.asked_at or 0.0, *(renewed_at for renewed_at, _ in held)]),
        holds=[holding for _, holding in held],
    )


def _works_on(one: wire.AtWork, run: str) -> bool:
    """Say whether somebody holds a query of a run, or waits for one."""
    if one.holds:
        return any(holding.run == run for holding in one.holds)
    return one.run in (None, run)
