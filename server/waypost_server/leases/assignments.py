"""Finds and checks assignments. An assignment is one query leased to one annotator."""

import secrets
from dataclasses import dataclass

from sqlalchemy import bindparam, exists, func, select

from waypost import prices as pricing
from waypost import wire
from waypost_server import errors
from waypost_server.db.prepared import Prepared, Record
from waypost_server.db.tables import IS_LIVE, answers, assignments, users
from waypost_server.db.tables import queries as query_table
from waypost_server.db.tables import runs as run_table
from waypost_server.db.transaction import Tx
from waypost_server.queries import comments
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
    has_answer: bool  # also one that came late or was retracted


FIND = Prepared(
    select(assignments, query_table.c.run_id)
    .add_columns(exists().where(answers.c.assignment_id == assignments.c.id).label("has_answer"))
    .join(query_table, query_table.c.id == assignments.c.query_id)
    .where(assignments.c.id == bindparam("assignment"))
)
_LOCK = Prepared(select(query_table.c.id).where(query_table.c.id == bindparam("query")).with_for_update(key_share=True))
_own = run_table.alias("own")
_VIEW = (
    select(assignments.c.id, assignments.c.token, assignments.c.leased_at, assignments.c.expires_at)
    .add_columns(query_table.c.id.label("query"), query_table.c.priority, query_table.c.created_at, query_table.c.ask)
    .add_columns(query_table.c.revision)
    .add_columns(run_table.c.id.label("run"), run_table.c.name, run_table.c.vocabulary, run_table.c.prices)
    .add_columns(users.c.name.label("annotator"))
    .join(query_table, query_table.c.id == assignments.c.query_id)
    .join(_own, _own.c.id == query_table.c.run_id)
    .join(run_table, run_table.c.id == func.coalesce(_own.c.gold_of, _own.c.id))  # a gold query looks like the others
    .join(users, users.c.id == assignments.c.user_id)
)
_VIEW_ONE = Prepared(_VIEW.where(assignments.c.id == bindparam("assignment")))
_VIEW_OF_QUERY = Prepared(_VIEW.where(assignments.c.query_id == bindparam("query"), IS_LIVE))


def find(tx: Tx, assignment: int, user: int, token: str) -> OwnAssignment:
    """Return an assignment to its owner.

    Raises:
        NotFound, NotYours, WrongToken: the user does not have this assignment.
    """
    row = FIND.first(tx.conn, {"assignment": assignment})
    if row is None:
        raise errors.NotFound(f"There is no assignment {assignment}.")
    if row.user_id != user:
        raise errors.NotYours(f"Assignment {assignment} belongs to another annotator.")
    if not secrets.compare_digest(row.token.encode(), token.encode()):
        raise errors.WrongToken(f"This is not the token of assignment {assignment}.")
    return OwnAssignment(
        row.id, row.query_id, row.run_id, row.token, row.state, row.leased_at, row.expires_at, row.has_answer
    )


def find_live(tx: Tx, assignment: int, user: int, token: str) -> OwnAssignment:
    """Return a live assignment to its owner, and lock its query.

    Raises:
        NotFound, NotYours, WrongToken: the user does not have this assignment.
        LeaseExpired, LeaseEnded, QueryCancelled: the lease is over, by the database's clock.
    """
    found = find(tx, assignment, user, token)
    if not tx.one_writer:
        _LOCK.run(tx.conn, {"query": found.query})
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
    """Return a live assignment as its owner sees it."""
    return _viewed(tx, _VIEW_ONE.one(tx.conn, {"assignment": assignment}))


def view_of_query(tx: Tx, query: int) -> wire.Assignment:
    """Return the live assignment of a leased query as its owner sees it."""
    return _viewed(tx, _VIEW_OF_QUERY.one(tx.conn, {"query": query}))


def _viewed(tx: Tx, row: Record) -> wire.Assignment:
    ask = queries.ASK.validate_json(row.ask)
    return wire.Assignment(
        id=row.id,
        token=row.token,
        query=wire.Query(
            id=row.query,
            run=row.run,
            state="leased",
            priority=row.priority,
            created_at=row.created_at,
            ask=ask,
            answer=None,
            answer_id=None,
            used=False,
            annotator=row.annotator,
            units=None,
            seconds=None,
            active_seconds=None,
        ),
        run=wire.AssignedRun(id=row.run, name=row.name, vocabulary=runs.vocabulary_of(row.vocabulary)),
        price=pricing.price(ask, runs.prices_of(row.prices)),
        comments=comments.sent_back(tx, row.query) if row.revision else [],  # most queries were never answered before
        leased_at=row.leased_at,
        expires_at=row.expires_at,
        lease_seconds=row.expires_at - row.leased_at,
    )
