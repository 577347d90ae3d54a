"""Leases: granting, renewing, releasing and expiring them."""

import secrets
from collections.abc import Sequence

from sqlalchemy import bindparam, insert, select, update
from sqlalchemy.sql.elements import ColumnElement

from waypost import wire
from waypost_server.auth.access import ACCESS, LOCKED_USER, check_still
from waypost_server.db import wakeups
from waypost_server.db.functions import clock
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import IS_LIVE, assignments, queries, skips
from waypost_server.db.transaction import Tx
from waypost_server.gold import schedule, second, shadow
from waypost_server.leases import active_time, closed_tabs, presence, selection
from waypost_server.leases.assignments import find_live, view_of_query
from waypost_server.leases.request import LeaseRequest
from waypost_server.runs import service as runs
from waypost_server.settings import Settings

SLEW_SECONDS = 5.0  # by how much a clock may go back without an effect on leases

_SET_LEASED = Prepared(update(queries).where(queries.c.id == bindparam("query")).values(state="leased"))
_INSERT = Prepared(
    insert(assignments),
    ["query_id", "user_id", "token", "state", "deferring", "after_id", "tab", "leased_at", "expires_at"],
)
_EXPIRED = Prepared(
    select(queries.c.id)
    .join(assignments, assignments.c.query_id == queries.c.id)
    .where(IS_LIVE, assignments.c.expires_at <= clock())
    .with_for_update(skip_locked=True, key_share=True, of=queries)
)


def lease(tx: Tx, request: LeaseRequest) -> wire.Assignment | None:
    """Lease the next query to an annotator; return None if there is none.

    Raises:
        NotFound: the request names an unknown run.
        Unauthenticated, Forbidden: the user may no longer answer.
    """
    _begin(tx, request)
    if request.tab is not None and closed_tabs.is_closed(tx, request.user, request.tab):
        return None
    query = selection.select_next(tx, request)
    if query is not None:
        return _hand_out(tx, request, query)
    if request.ahead or request.defer > 0:  # second answers are for people who would otherwise wait
        return None
    copy = second.take(tx, request.user, request.kinds, request.run)
    return None if copy is None else _grant(tx, request, copy)


def lease_batch(tx: Tx, request: LeaseRequest, count: int) -> list[wire.Assignment]:
    """Lease the next queries to an annotator, at most `count`.

    Raises:
        NotFound, Unauthenticated, Forbidden: as in `lease`.
    """
    _begin(tx, request)
    return [_hand_out(tx, request, query) for query in selection.select_several(tx, request, count)]


def _begin(tx: Tx, request: LeaseRequest) -> None:
    _look_ahead(tx, request)
    expire(tx)
    check_still(tx, ACCESS["lease"], request.user)
    if request.run is not None:
        runs.find(tx, request.run)
    if request.defer == 0:
        presence.record(tx, request.user, request.run, request.kinds)


def _look_ahead(tx: Tx, request: LeaseRequest) -> None:
    """Lock and read in one round trip what every lease needs."""
    if tx.one_writer or not (request.run is None or runs.is_id(request.run)):
        return  # there are no round trips, or there is no such run
    user = {"user": request.user}
    LOCKED_USER.ahead(tx.conn, user)
    _EXPIRED.ahead(tx.conn, {})
    if request.run is not None:
        runs.FIND.ahead(tx.conn, {"run": request.run})
    presence.ROW_OF.ahead(tx.conn, user)
    presence.OTHERS.ahead(tx.conn, {**user, "run": request.run, "seconds": request.presence_seconds})
    selection.LAST_ANSWERED.ahead(tx.conn, user)
    tx.read_time_ahead()


def _hand_out(tx: Tx, request: LeaseRequest, query: int) -> wire.Assignment:
    """Lease a selected query, or a query of the run's shadow in its place: for a second answer, or gold."""
    due = shadow.due(tx, query)
    if due is None:
        return _grant(tx, request, query)
    if due.second_answers > 0 and request.defer == 0:
        copy = second.take(tx, request.user, request.kinds, due.run)
        if copy is not None:
            tx.wake(wakeups.QUEUE)  # `query` is free for other annotators who wait
            return _grant(tx, request, copy)
    return _grant(tx, request, schedule.replace_with_gold(tx, request.user, request.kinds, query, due))


def _grant(tx: Tx, request: LeaseRequest, query: int) -> wire.Assignment:
    grant(
        tx,
        query,
        request.user,
        request.lease_seconds,
        deferring=request.defer > 0,
        after=request.after,
        tab=request.tab,
    )
    leased = view_of_query(tx, query)
    ask = leased.query.ask
    tx.trace("lease", leased.run.id, ask.episode, query=query, kind=ask.kind, assignment=leased.id)
    return leased


def grant(
    tx: Tx,
    query: int,
    user: int,
    seconds: float,
    *,
    deferring: bool = False,
    after: int | None = None,
    tab: str | None = None,
) -> None:
    """Lease a query to an annotator for `seconds`.

    The store allows one live assignment per query (`uq_assignments_live`).
    """
    active_time.start(tx, user)
    tx.count("leases", "granted")
    _SET_LEASED.run(tx.conn, {"query": query})
    assignment = {
        "query_id": query,
        "user_id": user,
        "token": secrets.token_urlsafe(16),
        "state": "live",
        "deferring": deferring,
        "after_id": after,
        "tab": tab,
        "leased_at": tx.now,
        "expires_at": tx.now + seconds,
    }
    _INSERT.run(tx.conn, assignment)


def expire(tx: Tx) -> int:
    """End the leases whose time is over and reopen their queries; return how many."""
    ids = [row.id for row in _EXPIRED.rows(tx.conn, {})]
    if ids:
        _reopen(tx, ids, "expired", [assignments.c.expires_at <= tx.now])
    return len(ids)


def end_future(tx: Tx) -> None:
    """End the leases that begin in the future, and forget who asked for queries then: the clock was set back.

    Until the clock gets there again, they would not expire, and these annotators would count as at work.
    """
    future = tx.now + SLEW_SECONDS
    _end_where(tx, "expired", assignments.c.leased_at > future)
    presence.forget(tx, future)


def renew(tx: Tx, assignment: int, user: int, body: wire.Renew, settings: Settings) -> wire.Renewal:
    """Extend a live lease to its full length from now, but not past the cap.

    Raises:
        NotFound, NotYours, WrongToken, LeaseExpired, LeaseEnded, QueryCancelled: the user has no such live lease.
    """
    found = find_live(tx, assignment, user, body.token)
    if body.active:
        active_time.signal(tx, user, settings.idle_seconds)
    expires_at = min(tx.now + settings.lease_seconds, found.leased_at + settings.lease_cap_seconds)
    expires_at = max(expires_at, found.expires_at)
    tx.conn.execute(update(assignments).where(assignments.c.id == found.id).values(expires_at=expires_at))
    return wire.Renewal(expires_at=expires_at)


def release(tx: Tx, assignment: int, user: int, body: wire.Release, settings: Settings) -> None:
    """Return a query to the queue. With `skip`, this annotator does not get it again.

    Raises:
        NotFound, NotYours, WrongToken, LeaseExpired, LeaseEnded, QueryCancelled: the user has no such live lease.
    """
    found = find_live(tx, assignment, user, body.token)
    _reopen(tx, [found.query], "skipped" if body.skip else "released", reason=body.reason)
    if body.skip:
        active_time.take(tx, user, settings.idle_seconds)  # do not bill skipped time to the next query
        # On PostgreSQL an annotator can, very rarely, get a query in one request while skipping it in another.
        tx.conn.execute(tx.upsert(skips).values(query_id=found.query, user_id=user).on_conflict_do_nothing())


def close_tab(tx: Tx, user: int, body: wire.Leave) -> None:
    """Release what a browser tab holds, except assignments listed in `keep`. The tab gets no new leases."""
    closed_tabs.record(tx, user, body.tab)
    of_tab = (assignments.c.user_id == user, assignments.c.tab == body.tab)
    _end_where(tx, "released", *of_tab, assignments.c.id.not_in(body.keep))


def release_all(tx: Tx, user: int) -> None:
    """Release all leases of a user who may no longer answer."""
    _end_where(tx, "released", assignments.c.user_id == user)


def _end_where(tx: Tx, ending: str, *conditions: ColumnElement[bool]) -> None:
    locked = (
        select(queries.c.id)
        .join(assignments, assignments.c.query_id == queries.c.id)
        .where(*conditions, IS_LIVE)
        .with_for_update(key_share=True, of=queries)
    )
    ids = tx.conn.execute(locked).scalars().all()
    if ids:
        _reopen(tx, ids, ending, conditions)


def _reopen(
    tx: Tx,
    ids: Sequence[int],
    ending: str,
    conditions: Sequence[ColumnElement[bool]] = (),
    reason: str | None = None,
) -> None:
    """End the live assignments of locked queries and reopen the queries."""
    ended = tx.conn.execute(
        update(assignments)
        .where(assignments.c.query_id.in_(ids), IS_LIVE, *conditions)
        .values(state=ending, ended_at=tx.now, reason=reason)
        .returning(assignments.c.query_id)
    ).scalars()
    reopened = list(ended)
    tx.count("leases", ending, len(reopened))
    tx.conn.execute(update(queries).where(queries.c.id.in_(reopened), queries.c.state == "leased").values(state="open"))
    tx.wake(wakeups.QUEUE)
