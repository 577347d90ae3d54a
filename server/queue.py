"""The queue: which query an annotator gets next, and the life of a lease."""

import secrets
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Select, exists, insert, not_, or_, select, update
from sqlalchemy.sql.elements import ColumnElement

from server import errors, live, presence, queries, runs, wire
from server.database import Tx
from server.settings import Settings
from server.tables import IS_LIVE, IS_OPEN, answers, assignments, skips
from server.tables import queries as query_table
from server.tables import runs as run_table


@dataclass(frozen=True)
class Wish:
    """What an annotator would take, and on which terms it is leased."""

    user: int
    kinds: tuple[wire.Kind, ...] | None
    run: str | None
    defer: float
    lease_seconds: float
    presence_seconds: float
    after: int | None = None

    @classmethod
    def of(cls, lease: wire.Lease, user: int, settings: Settings, after: int | None = None) -> "Wish":
        """Return the wish a message states."""
        kinds = None if lease.kinds is None else tuple(lease.kinds)
        return cls(user, kinds, lease.run, lease.defer, settings.lease_seconds, settings.presence_seconds, after)


@dataclass(frozen=True)
class Held:
    """An assignment as its owner holds it."""

    id: int
    query: int
    run: str
    token: str
    state: str
    leased_at: float
    expires_at: float


def lease(tx: Tx, wish: Wish) -> wire.Assignment | None:
    """Lease the next query to an annotator: by priority, then the episode it last answered, then age."""
    expire(tx)
    if wish.run is not None:
        runs.find(tx, wish.run)
    if wish.defer == 0:
        presence.note(tx, wish.user, wish.run, wish.kinds)
    query = _take(tx, wish)
    if query is None:
        return None
    assignment = grant(tx, query, wish.user, wish.lease_seconds, deferring=wish.defer > 0, after=wish.after)
    return view(tx, assignment)


def grant(tx: Tx, query: int, user: int, seconds: float, *, deferring: bool, after: int | None = None) -> int:
    """Give a query to an annotator; the store allows one live assignment per query."""
    tx.conn.execute(update(query_table).where(query_table.c.id == query).values(state="leased"))
    return int(
        tx.conn.execute(
            insert(assignments)
            .values(
                query_id=query,
                user_id=user,
                token=secrets.token_urlsafe(16),
                state="live",
                deferring=deferring,
                after_id=after,
                leased_at=tx.now,
                expires_at=tx.now + seconds,
            )
            .returning(assignments.c.id)
        ).scalar_one()
    )


def _take(tx: Tx, wish: Wish) -> int | None:
    """Lock and return the next query: a follow-up if nothing has a higher priority, else the first."""
    offered = _offered(tx, wish)
    first = tx.conn.execute(offered.limit(1)).one_or_none()
    if first is None:
        return None
    last = _last_answered(tx, wish.user)
    if last is not None:
        same = offered.where(query_table.c.run_id == last[0], query_table.c.episode == last[1])
        follow_up = tx.conn.execute(same.where(query_table.c.priority >= first.priority).limit(1)).one_or_none()
        first = follow_up or first
    # On PostgreSQL others may be taking the same: lock it, or whichever is next and free.
    locked = tx.conn.execute(
        select(query_table.c.id).where(query_table.c.id == first.id, IS_OPEN).with_for_update(skip_locked=True)
    ).one_or_none()
    if locked is None:
        locked = tx.conn.execute(offered.limit(1).with_for_update(skip_locked=True, of=query_table)).one_or_none()
    return None if locked is None else int(locked.id)


def _offered(tx: Tx, wish: Wish) -> Select[Any]:
    """Return the open queries this annotator may have, best first."""
    skipped = exists().where(skips.c.query_id == query_table.c.id, skips.c.user_id == wish.user)
    running = exists().where(run_table.c.id == query_table.c.run_id, run_table.c.state == "running")
    offered = (
        select(query_table.c.id, query_table.c.priority)
        .where(IS_OPEN, running, ~skipped)
        .order_by(query_table.c.priority.desc(), query_table.c.id)
    )
    if wish.kinds is not None:
        offered = offered.where(query_table.c.kind.in_(wish.kinds))
    if wish.run is not None:
        offered = offered.where(query_table.c.run_id == wish.run)
    if wish.defer > 0:
        others = presence.who_would_take(tx, wish.presence_seconds)
        old = query_table.c.created_at <= tx.now - wish.defer
        offered = offered.where(or_(old, not_(others)))
    return offered


def _last_answered(tx: Tx, user: int) -> tuple[str, int] | None:
    """Return the run and episode this annotator answered last."""
    row = tx.conn.execute(
        select(query_table.c.run_id, query_table.c.episode)
        .join(answers, answers.c.query_id == query_table.c.id)
        .where(answers.c.user_id == user)
        .order_by(answers.c.id.desc())
        .limit(1)
    ).one_or_none()
    return None if row is None else (row.run_id, row.episode)


def expire(tx: Tx) -> int:
    """End the leases whose time is up; their queries are open again. Returns how many."""
    due = (
        select(query_table.c.id)
        .join(assignments, assignments.c.query_id == query_table.c.id)
        .where(IS_LIVE, assignments.c.expires_at <= tx.now)
        .with_for_update(skip_locked=True, of=query_table)
    )
    ids = tx.conn.execute(due).scalars().all()
    if ids:
        late = [assignments.c.expires_at <= tx.now]
        reopen(tx, ids, "expired", late)
    return len(ids)


def reopen(
    tx: Tx,
    ids: Sequence[int],
    ending: str,
    conditions: Sequence[ColumnElement[bool]] = (),
    reason: str | None = None,
) -> None:
    """End the live assignments of locked queries and put the queries back."""
    ended = tx.conn.execute(
        update(assignments)
        .where(assignments.c.query_id.in_(ids), IS_LIVE, *conditions)
        .values(state=ending, ended_at=tx.now, reason=reason)
        .returning(assignments.c.query_id)
    ).scalars()
    tx.conn.execute(
        update(query_table)
        .where(query_table.c.id.in_(list(ended)), query_table.c.state == "leased")
        .values(state="open")
    )
    tx.wake(live.QUEUE)


def find(tx: Tx, assignment: int, user: int, token: str) -> Held:
    """Return an assignment its owner names; on PostgreSQL its query is locked.

    Raises:
        NotFound, NotYours, WrongToken: if the caller does not hold it.
    """
    row = tx.conn.execute(
        select(assignments, query_table.c.run_id)
        .join(query_table, query_table.c.id == assignments.c.query_id)
        .where(assignments.c.id == assignment)
    ).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no assignment {assignment}.")
    if row.user_id != user:
        raise errors.NotYours(f"Assignment {assignment} belongs to another annotator.")
    if not secrets.compare_digest(row.token.encode(), token.encode()):
        raise errors.WrongToken(f"This is not the token of assignment {assignment}.")
    return Held(row.id, row.query_id, row.run_id, row.token, row.state, row.leased_at, row.expires_at)


def hold(tx: Tx, assignment: int, user: int, token: str) -> Held:
    """Return a live assignment its owner names, its query locked.

    Raises:
        LeaseExpired, LeaseEnded: if the lease is over, by the database's clock.
    """
    held = find(tx, assignment, user, token)
    tx.conn.execute(select(query_table.c.id).where(query_table.c.id == held.query).with_for_update())
    held = find(tx, assignment, user, token)
    refuse_ended(held, tx.now)
    return held


def refuse_ended(held: Held, now: float) -> None:
    """Refuse an assignment whose lease is over."""
    if held.state == "cancelled":
        raise errors.QueryCancelled("The run ended, and its open queries with it.")
    if held.state == "expired" or (held.state == "live" and held.expires_at <= now):
        raise errors.LeaseExpired("The lease ended before this came; the query is back in the queue.")
    if held.state != "live":
        raise errors.LeaseEnded(f"The assignment was {held.state} before.")


def renew(tx: Tx, assignment: int, user: int, token: str, settings: Settings) -> wire.Renewal:
    """Let a live lease start anew, but never past its cap."""
    held = hold(tx, assignment, user, token)
    expires_at = min(tx.now + settings.lease_seconds, held.leased_at + settings.lease_cap_seconds)
    expires_at = max(expires_at, held.expires_at)
    tx.conn.execute(update(assignments).where(assignments.c.id == held.id).values(expires_at=expires_at))
    return wire.Renewal(expires_at=expires_at)


def release(tx: Tx, assignment: int, user: int, body: wire.Release) -> None:
    """Give a query back; a skipped one is not offered to this annotator again."""
    held = hold(tx, assignment, user, body.token)
    reopen(tx, [held.query], "skipped" if body.skip else "released", reason=body.reason)
    if body.skip:
        tx.conn.execute(insert(skips).values(query_id=held.query, user_id=user))


def held(tx: Tx, user: int) -> wire.AssignmentList:
    """List an annotator's live assignments, oldest first."""
    ids = tx.conn.execute(
        select(assignments.c.id)
        .where(assignments.c.user_id == user, IS_LIVE, assignments.c.expires_at > tx.now)
        .order_by(assignments.c.id)
    ).scalars()
    return wire.AssignmentList(assignments=[view(tx, one) for one in ids.all()])


def granted_after(tx: Tx, assignment: int) -> wire.Assignment | None:
    """Return the live assignment that the reply to an earlier answer handed out."""
    one = tx.conn.execute(
        select(assignments.c.id)
        .where(assignments.c.after_id == assignment, IS_LIVE, assignments.c.expires_at > tx.now)
        .order_by(assignments.c.id.desc())
        .limit(1)
    ).scalar_one_or_none()
    return None if one is None else view(tx, one)


def view(tx: Tx, assignment: int) -> wire.Assignment:
    """Return an assignment as its owner sees it."""
    row = tx.conn.execute(select(assignments).where(assignments.c.id == assignment)).one()
    query = queries.view(tx, row.query_id)
    return wire.Assignment(
        id=row.id,
        token=row.token,
        query=query,
        run=runs.view(tx, query.run),
        leased_at=row.leased_at,
        expires_at=row.expires_at,
        lease_seconds=row.expires_at - row.leased_at,
    )
