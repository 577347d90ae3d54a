"""The history of one query: its assignments, answers and charges."""

from typing import Any

from sqlalchemy import Row, select, tuple_

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.tables import answers, assignments, ledger, queries, users
from waypost_server.db.transaction import Tx
from waypost_server.queries import comments
from waypost_server.queries.service import ANSWER, view
from waypost_server.watch.ledger_rows import ENTRIES, entries_of


def history(tx: Tx, query: int) -> wire.QueryHistory:
    """Return the history of a query, and the ids of the queries before and after it in the run.

    Raises:
        NotFound: there is no such query.
    """
    found = view(tx, query)
    given = {row.assignment_id: row for row in tx.conn.execute(select(answers).where(answers.c.query_id == query))}
    handed_out = (
        select(assignments, users.c.name.label("annotator"))
        .join(users, users.c.id == assignments.c.user_id)
        .where(assignments.c.query_id == query)
        .order_by(assignments.c.id)
    )
    past = [_assignment(row, given.get(row.id), found.answer_id) for row in tx.conn.execute(handed_out)]
    charged = ENTRIES.where(answers.c.query_id == query).order_by(ledger.c.id)
    return wire.QueryHistory(
        assignments=past,
        ledger=entries_of(tx, found.run, tx.conn.execute(charged).all()),
        comments=comments.of_query(tx, query),
        previous=_neighbor(tx, found, later=False),
        next=_neighbor(tx, found, later=True),
    )


def _assignment(row: Row[Any], given: Row[Any] | None, counting: int | None) -> wire.PastAssignment:
    return wire.PastAssignment(
        id=row.id,
        annotator=row.annotator,
        state=row.state,
        reason=row.reason,
        leased_at=row.leased_at,
        expires_at=row.expires_at,
        ended_at=row.ended_at,
        answer=None if given is None else _answer(given, counting),
    )


def _answer(row: Row[Any], counting: int | None) -> wire.PastAnswer:
    return wire.PastAnswer(
        id=row.id,
        content=ANSWER.validate_json(row.content),
        at=row.created_at,
        units=to_units(row.units),
        seconds=row.seconds,
        fate="late" if row.revision is None else "counts" if row.id == counting else "retracted",
    )


def _neighbor(tx: Tx, query: wire.Query, *, later: bool) -> int | None:
    place, here = tuple_(queries.c.episode, queries.c.ordinal), tuple_(query.ask.episode, query.ask.ordinal)
    order = (queries.c.episode, queries.c.ordinal) if later else (queries.c.episode.desc(), queries.c.ordinal.desc())
    beside = select(queries.c.id).where(queries.c.run_id == query.run, place > here if later else place < here)
    return tx.conn.execute(beside.order_by(*order).limit(1)).scalar_one_or_none()
