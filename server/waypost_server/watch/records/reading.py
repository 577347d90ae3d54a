"""Reads the records of a run in pages, so that an export of any size needs little memory.

Queries are in the order of (episode, ordinal), ledger entries in the order of their booking, episodes by number.
"""

from collections import defaultdict
from collections.abc import Callable, Mapping
from typing import Any

from sqlalchemy import Row, select, tuple_

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.tables import answers, assignments, episodes, ledger, queries, users
from waypost_server.db.transaction import Tx
from waypost_server.queries.service import ANSWER, ASK
from waypost_server.runs import service as runs

PAGE = 200  # records read at once
_ORDINALS = 2**31  # the largest ordinal plus one


def page(tx: Tx, run: str, part: wire.RecordPart, after: int | None) -> wire.RecordPage:
    """Return the next records of a part of a run, at most `PAGE`.

    Args:
        tx: the transaction.
        run: the run's id.
        part: the part of the run.
        after: the cursor of the page before; None for the first page.

    Raises:
        NotFound: there is no such run.
    """
    runs.find(tx, run)
    return _PARTS[part](tx, run, -1 if after is None else after)


def _queries(tx: Tx, run: str, after: int) -> wire.RecordPage:
    place = tuple_(queries.c.episode, queries.c.ordinal)
    rows = tx.conn.execute(
        select(queries)
        .where(queries.c.run_id == run, place > divmod(after, _ORDINALS))
        .order_by(queries.c.episode, queries.c.ordinal)
        .limit(PAGE)
    ).all()
    histories = _histories(tx, [row.id for row in rows])
    cursor = rows[-1].episode * _ORDINALS + rows[-1].ordinal if len(rows) == PAGE else None
    return wire.RecordPage(records=[_query(row, histories[row.id]) for row in rows], cursor=cursor)


def _histories(tx: Tx, ids: list[int]) -> Mapping[int, list[tuple[Row[Any], Row[Any] | None]]]:
    """Return the assignments of queries, oldest first, each with its answer."""
    given = {
        row.assignment_id: row for row in tx.conn.execute(select(answers).where(answers.c.query_id.in_(ids))).all()
    }
    histories = defaultdict[int, list[tuple[Row[Any], Row[Any] | None]]](list)
    held = (
        select(assignments, users.c.name.label("annotator"))
        .join(users, users.c.id == assignments.c.user_id)
        .where(assignments.c.query_id.in_(ids))
        .order_by(assignments.c.id)
    )
    for row in tx.conn.execute(held):
        histories[row.query_id].append((row, given.get(row.id)))
    return histories


def _query(row: Row[Any], history: list[tuple[Row[Any], Row[Any] | None]]) -> wire.QueryRecord:
    counts = [answer is not None and answer.id == row.answer_id for _, answer in history]
    found = [_assignment(held, answer) for held, answer in history]
    return wire.QueryRecord(
        state=row.state,
        priority=row.priority,
        used=row.used,
        created_at=row.created_at,
        ask=ASK.validate_json(row.ask),
        answered=found[counts.index(True)] if True in counts else None,
        earlier=[one for one, counting in zip(found, counts, strict=True) if not counting],
    )


def _assignment(row: Row[Any], answer: Row[Any] | None) -> wire.AssignmentRecord:
    return wire.AssignmentRecord(
        annotator=row.annotator,
        state=row.state,
        deferring=row.deferring,
        reason=row.reason,
        leased_at=row.leased_at,
        expires_at=row.expires_at,
        ended_at=row.ended_at,
        answer=None if answer is None else _answer(answer),
    )


def _answer(row: Row[Any]) -> wire.AnswerRecord:
    return wire.AnswerRecord(
        content=ANSWER.validate_json(row.content),
        revision=row.revision,
        units=to_units(row.units),
        seconds=row.seconds,
        active_seconds=row.active_seconds,
        at=row.created_at,
    )


def _ledger(tx: Tx, run: str, after: int) -> wire.RecordPage:
    rows = tx.conn.execute(
        select(ledger, queries.c.ordinal, answers.c.revision)
        .join(queries, queries.c.id == ledger.c.query_id)
        .join(answers, answers.c.id == ledger.c.answer_id)
        .where(ledger.c.run_id == run, ledger.c.id > after)
        .order_by(ledger.c.id)
        .limit(PAGE)
    ).all()
    return wire.RecordPage(records=[_entry(row) for row in rows], cursor=rows[-1].id if len(rows) == PAGE else None)


def _entry(row: Row[Any]) -> wire.LedgerRecord:
    return wire.LedgerRecord(
        entry=row.entry,
        kind=row.kind,
        episode=row.episode,
        ordinal=row.ordinal,
        revision=row.revision,
        units=to_units(row.units),
        lo_units=to_units(row.lo_units),
        seconds=row.seconds,
        active_seconds=row.active_seconds,
        at=row.created_at,
    )


def _episodes(tx: Tx, run: str, after: int) -> wire.RecordPage:
    rows = tx.conn.execute(
        select(episodes)
        .where(episodes.c.run_id == run, episodes.c.episode > after)
        .order_by(episodes.c.episode)
        .limit(PAGE)
    ).all()
    return wire.RecordPage(
        records=[_episode(row) for row in rows], cursor=rows[-1].episode if len(rows) == PAGE else None
    )


def _episode(row: Row[Any]) -> wire.EpisodeRecord:
    return wire.EpisodeRecord(result=wire.EpisodeResult.model_validate_json(row.result), at=row.created_at)


_PARTS: Mapping[wire.RecordPart, Callable[[Tx, str, int], wire.RecordPage]] = {
    "queries": _queries,
    "ledger": _ledger,
    "episodes": _episodes,
}
