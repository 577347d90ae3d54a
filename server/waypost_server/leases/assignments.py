"""Finds and checks assignments. An assignment is one query leased to one annotator."""

import secrets
from dataclasses import dataclass

from sqlalchemy import bindparam, select

from waypost import prices as pricing
from waypost import wire
from waypost_server import errors
from waypost_server.db.tables import IS_LIVE, assignments
from waypost_server.db.tables import queries as query_table
from waypost_server.db.transaction import Tx
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs


@dataclass(frozen=True)
class OwnAssignment:
    """An assignment whose owner has shown its token."""

    id: int
    query: int
    run: str
    token: str
    state: str
    leased_at: float
    expires_at: float


_FIND = (
    select(assignments, query_table.c.run_id)
    .join(query_table, query_table.c.id == assignments.c.query_id)
    .where(assignments.c.id == bindparam("assignment"))
)


def find(tx: Tx, assignment: int, user: int, token: str) -> OwnAssignment:
    """Return an assignment to its owner.

    Raises:
        NotFound, NotYours, WrongToken: the user does not have this assignment.
    """
    row = tx.conn.execute(_FIND, {"assignment": assignment}).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no assignment {assignment}.")
    if row.user_id != user:
        raise errors.NotYours(f"Assignment {assignment} belongs to another annotator.")
    if not secrets.compare_digest(row.token.encode(), token.encode()):
        raise errors.WrongToken(f"This is not the token of assignment {assignment}.")
    return OwnAssignment(row.id, row.query_id, row.run_id, row.token, row.state, row.leased_at, row.expires_at)


def find_live(tx: Tx, assignment: int, user: int, token: str) -> OwnAssignment:
    """Return a live assignment to its owner, and lock its query.

    Raises:
        NotFound, NotYours, WrongToken: the user does not have this assignment.
        LeaseExpired, LeaseEnded, QueryCancelled: the lease is over, by the database's clock.
    """
    found = find(tx, assignment, user, token)
    if not tx.one_writer:
        tx.conn.execute(select(query_table.c.id).where(query_table.c.id == found.query).with_for_update())
        found = find(tx, assignment, user, token)
    check_live(found, tx.now)
    return found


def check_live(assignment: OwnAssignment, now: float) -> None:
    """Refuse an assignment whose lease is over.

    Raises:
        LeaseExpired, LeaseEnded, QueryCancelled: the reason why it is over.
    """
    if assignment.state == "cancelled":
        raise errors.QueryCancelled("The run ended, and its open queries were cancelled.")
    if assignment.state == "expired" or (assignment.state == "live" and assignment.expires_at <= now):
        raise errors.LeaseExpired("The lease had expired when this arrived; the query is back in the queue.")
    if assignment.state != "live":
        raise errors.LeaseEnded(f"The assignment was already {assignment.state}.")


def live_of(tx: Tx, user: int) -> wire.AssignmentList:
    """List an annotator's live assignments, oldest first."""
    ids = tx.conn.execute(
        select(assignments.c.id)
        .where(assignments.c.user_id == user, IS_LIVE, assignments.c.expires_at > tx.now)
        .order_by(assignments.c.id)
    ).scalars()
    return wire.AssignmentList(assignments=[view(tx, one) for one in ids.all()])


def leased_after(tx: Tx, assignment: int) -> wire.Assignment | None:
    """Return the live assignment that was leased with the answer to an earlier assignment, if there is one."""
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
