"""The queue: the life of a lease, from the moment a query is handed out until it ends by itself or otherwise."""

import secrets
from collections.abc import Sequence
from dataclasses import dataclass

from sqlalchemy import bindparam, insert, select, update
from sqlalchemy.sql.elements import ColumnElement

from waypost import prices as pricing
from waypost import wire
from waypost_server import errors
from waypost_server.db import wakeups
from waypost_server.db.engine import Tx
from waypost_server.db.tables import IS_LIVE, assignments, skips
from waypost_server.db.tables import queries as query_table
from waypost_server.gold import schedule
from waypost_server.leases import active_time, closed_tabs, presence, selection
from waypost_server.leases.selection import Taker
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs
from waypost_server.settings import Settings
from waypost_server.users import service as users


@dataclass(frozen=True)
class Terms:
    """How a query is leased: how long, to a deferring bot or not, with the reply to which answer, to which page."""

    seconds: float
    deferring: bool = False
    after: int | None = None
    tab: str | None = None


@dataclass(frozen=True)
class Wish:
    """What an annotator would take, and on which terms it is leased."""

    taker: Taker
    terms: Terms

    @classmethod
    def of(cls, lease: wire.Lease, user: int, settings: Settings, after: int | None = None) -> "Wish":
        """Return the wish a message states."""
        kinds = None if lease.kinds is None else tuple(sorted(set(lease.kinds)))
        taker = Taker(
            user,
            kinds,
            lease.run,
            lease.defer,
            lease.ahead,
            settings.presence_seconds,
            settings.follow_up_seconds,
        )
        return cls(taker, Terms(settings.lease_seconds, lease.defer > 0, after, lease.tab))


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


_LEASED = update(query_table).where(query_table.c.id == bindparam("query")).values(state="leased")
_GRANT = insert(assignments).returning(assignments.c.id)
_DUE = (
    select(query_table.c.id)
    .join(assignments, assignments.c.query_id == query_table.c.id)
    .where(IS_LIVE, assignments.c.expires_at <= bindparam("now"))
    .with_for_update(skip_locked=True, of=query_table)
)
_FIND = (
    select(assignments, query_table.c.run_id)
    .join(query_table, query_table.c.id == assignments.c.query_id)
    .where(assignments.c.id == bindparam("assignment"))
)


def lease(tx: Tx, wish: Wish) -> wire.Assignment | None:
    """Lease the next query to an annotator, if there is one."""
    taker = wish.taker
    expire(tx)
    users.refuse_gone(tx, taker.user)
    if taker.run is not None:
        runs.find(tx, taker.run)
    if wish.terms.tab is not None and closed_tabs.known(tx, taker.user, wish.terms.tab):
        return None
    if taker.defer == 0:
        presence.note(tx, taker.user, taker.run, taker.kinds)
    query = selection.take(tx, taker)
    if query is None:
        return None
    query = schedule.instead(tx, taker, query)
    return view(tx, grant(tx, query, taker.user, wish.terms))


def grant(tx: Tx, query: int, user: int, terms: Terms) -> int:
    """Give a query to an annotator; the store allows one live assignment per query."""
    active_time.begin(tx, user)
    tx.conn.execute(_LEASED, {"query": query})
    lease = {
        "query_id": query,
        "user_id": user,
        "token": secrets.token_urlsafe(16),
        "state": "live",
        "deferring": terms.deferring,
        "after_id": terms.after,
        "tab": terms.tab,
        "leased_at": tx.now,
        "expires_at": tx.now + terms.seconds,
    }
    return int(tx.conn.execute(_GRANT, lease).scalar_one())


def expire(tx: Tx) -> int:
    """End the leases whose time is up; their queries are open again. Returns how many."""
    ids = tx.conn.execute(_DUE, {"now": tx.now}).scalars().all()
    if ids:
        reopen(tx, ids, "expired", [assignments.c.expires_at <= tx.now])
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
    tx.wake(wakeups.QUEUE)


def find(tx: Tx, assignment: int, user: int, token: str) -> Held:
    """Return an assignment its owner names; on PostgreSQL its query is locked.

    Raises:
        NotFound, NotYours, WrongToken: if the caller does not hold it.
    """
    row = tx.conn.execute(_FIND, {"assignment": assignment}).one_or_none()
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
    if not tx.one_writer:
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


def renew(tx: Tx, assignment: int, user: int, body: wire.Renew, settings: Settings) -> wire.Renewal:
    """Let a live lease start anew, but never past its cap."""
    held = hold(tx, assignment, user, body.token)
    if body.active:
        active_time.signal(tx, user, settings.idle_seconds)
    expires_at = min(tx.now + settings.lease_seconds, held.leased_at + settings.lease_cap_seconds)
    expires_at = max(expires_at, held.expires_at)
    tx.conn.execute(update(assignments).where(assignments.c.id == held.id).values(expires_at=expires_at))
    return wire.Renewal(expires_at=expires_at)


def release(tx: Tx, assignment: int, user: int, body: wire.Release, settings: Settings) -> None:
    """Give a query back; a skipped one is not offered to this annotator again."""
    held = hold(tx, assignment, user, body.token)
    reopen(tx, [held.query], "skipped" if body.skip else "released", reason=body.reason)
    if body.skip:
        active_time.take(tx, user, settings.idle_seconds)  # it is not the next query's
        tx.conn.execute(insert(skips).values(query_id=held.query, user_id=user))


def leave(tx: Tx, user: int, body: wire.Leave) -> None:
    """Give back what a page holds, but what it is still answering; nothing more is leased to it."""
    closed_tabs.note(tx, user, body.tab)
    theirs = (assignments.c.user_id == user, assignments.c.tab == body.tab, assignments.c.id.not_in(body.keep))
    ids = tx.conn.execute(
        select(query_table.c.id)
        .join(assignments, assignments.c.query_id == query_table.c.id)
        .where(*theirs, IS_LIVE)
        .with_for_update(of=query_table)
    ).scalars()
    reopen(tx, ids.all(), "released", theirs)


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
    row = tx.conn.execute(_FIND, {"assignment": assignment}).one()
    query = queries.view(tx, row.query_id)
    run = runs.view(tx, query.run)
    return wire.Assignment(
        id=row.id,
        token=row.token,
        query=query,
        run=run,
        price=pricing.price(query.ask, run.prices),
        leased_at=row.leased_at,
        expires_at=row.expires_at,
        lease_seconds=row.expires_at - row.leased_at,
    )
