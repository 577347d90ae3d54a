"""Inserts the queries of a run that is being recreated, with their assignments and answers."""

import secrets
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from typing import Any

from sqlalchemy import bindparam, insert, update

from waypost import prices as pricing
from waypost import wire
from waypost.prices import to_micro
from waypost_server.db import canonical
from waypost_server.db.tables import answers, assignments, queries
from waypost_server.db.transaction import Tx
from waypost_server.errors import Location, Unprocessable
from waypost_server.gold import scoring
from waypost_server.queries import checks, frame_uses
from waypost_server.queries.service import Content

FindAnnotator = Callable[[Tx, str], int]
"""Returns the id of an annotator by name."""

_INSERT_QUERY = insert(queries).returning(queries.c.id, sort_by_parameter_order=True)
_INSERT_ASSIGNMENT = insert(assignments).returning(assignments.c.id, sort_by_parameter_order=True)
_INSERT_ANSWER = insert(answers).returning(answers.c.id, sort_by_parameter_order=True)
_ANSWERED = (
    update(queries)
    .where(queries.c.id == bindparam("query"))
    .values(state="answered", answer_id=bindparam("answer"), used=bindparam("is_used"), differs=bindparam("unlike"))
)


@dataclass(frozen=True)
class Target:
    """The run that is being recreated."""

    run: wire.Run
    names: checks.Names
    find_annotator: FindAnnotator
    annotators: dict[str, int] = field(default_factory=dict)  # ids by name


def insert_queries(tx: Tx, target: Target, records: Sequence[wire.QueryRecord]) -> None:
    """Insert queries with their assignments and answers.

    A query and its answer refer to each other, so the query gets its answer and its state after the answer is there.

    Raises:
        Unprocessable: a query, an answer or its history is not valid in the run.
    """
    for record in records:
        _check_query(record, target.names)
    frame_uses.check_stored(tx, target.run.id, [record.ask for record in records])
    ids = tx.conn.execute(_INSERT_QUERY, [_query_row(target, record) for record in records]).scalars().all()
    held = [(query, one) for query, record in zip(ids, records, strict=True) for one in _history(record)]
    if not held:
        return
    rows = [_assignment_row(tx, target, query, one) for query, one in held]
    places = tx.conn.execute(_INSERT_ASSIGNMENT, rows).scalars().all()
    given = [
        _answer_row(target, row, assignment, one.answer)
        for (_, one), row, assignment in zip(held, rows, places, strict=True)
        if one.answer is not None
    ]
    if not given:
        return
    contents = [past.answer.content for record in records for past in _history(record) if past.answer is not None]
    frame_uses.show(tx, target.run.id, chain.from_iterable(frame_uses.of_answer(content) for content in contents))
    numbers = tx.conn.execute(_INSERT_ANSWER, given).scalars().all()
    last = dict(zip((row["query_id"] for row in given), numbers, strict=True))  # the answer that counts is the last
    counting = [
        {"query": query, "answer": last[query], "is_used": record.used, "unlike": _differs(record)}
        for query, record in zip(ids, records, strict=True)
        if record.answered is not None
    ]
    if counting:
        tx.conn.execute(_ANSWERED, counting)


def _differs(record: wire.QueryRecord) -> bool | None:
    answer = None if record.answered is None else record.answered.answer
    return None if answer is None else scoring.differ(record.ask.suggestion, answer.content)


def _history(record: wire.QueryRecord) -> list[wire.AssignmentRecord]:
    return [*record.earlier, *([] if record.answered is None else [record.answered])]


def _check_query(record: wire.QueryRecord, names: checks.Names) -> None:
    at: Location = ["episode", record.ask.episode, "query", record.ask.ordinal]
    checks.check_ask(record.ask, names, [*at, "ask"])
    if record.state not in {"answered", "cancelled"}:
        raise Unprocessable([*at, "state"], f"is {record.state}, but the run is finished")
    answered = record.answered is not None and record.answered.answer is not None
    if answered != (record.state == "answered") or (record.answered is not None) != answered:
        raise Unprocessable([*at, "state"], f"is {record.state}, but the answer says otherwise")
    if record.used and not answered:
        raise Unprocessable([*at, "used"], "is true, but there is no answer")
    history = _history(record)
    if any(one.state == "live" for one in history):
        raise Unprocessable([*at, "earlier"], "has a live assignment, but the run is finished")
    given = [one.answer for one in history if one.answer is not None]
    for one in given:
        checks.check_answer(checks.Outline.of(record.ask), one.content, names, [*at, "answer"])
    revisions = [one.revision for one in given if one.revision is not None]
    if revisions != list(range(len(revisions))) or (answered and given[-1].revision is None):
        raise Unprocessable([*at, "answer", "revision"], "does not count the retractions: 0, 1, and so on")


def _query_row(target: Target, record: wire.QueryRecord) -> dict[str, Any]:
    content = Content.of(record.ask)
    refunded = [one for one in record.earlier if one.answer is not None and one.answer.revision is not None]
    return {
        "run_id": target.run.id,
        "episode": record.ask.episode,
        "ordinal": record.ask.ordinal,
        "kind": record.ask.kind,
        "state": "cancelled",
        "priority": record.priority,
        "run_priority": target.run.priority,
        "ask": content.text,
        "digest": content.digest,
        "reserve": pricing.highest_cost(record.ask, target.run.prices).units,
        "revision": len(refunded),
        "used": False,
        "created_at": record.created_at,
    }


def _assignment_row(tx: Tx, target: Target, query: int, record: wire.AssignmentRecord) -> dict[str, Any]:
    if record.annotator not in target.annotators:
        target.annotators[record.annotator] = target.find_annotator(tx, record.annotator)
    return {
        "query_id": query,
        "user_id": target.annotators[record.annotator],
        "token": secrets.token_hex(16),  # nobody knows it, and the lease is over
        "state": record.state,
        "deferring": record.deferring,
        "reason": record.reason,
        "leased_at": record.leased_at,
        "expires_at": record.expires_at,
        "ended_at": record.ended_at,
    }


def _answer_row(
    target: Target, assignment: Mapping[str, Any], number: int, answer: wire.AnswerRecord
) -> dict[str, Any]:
    text = canonical.text(answer.content.model_dump(mode="json"))
    return {
        "run_id": target.run.id,
        "query_id": assignment["query_id"],
        "assignment_id": number,
        "user_id": assignment["user_id"],
        "content": text,
        "digest": canonical.digest(text),
        "revision": answer.revision,
        "units": to_micro(answer.units),
        "seconds": answer.seconds,
        "active_seconds": answer.active_seconds,
        "created_at": answer.at,
    }
