"""What whoever watches a run leafs through: its queries, its ledger, and the history of one query."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, Row, Select, and_, func, or_, select, tuple_
from sqlalchemy.sql.selectable import FromClause

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.engine import Tx
from waypost_server.db.tables import IS_LIVE, answers, assignments, ledger, queries, users
from waypost_server.queries.service import ANSWER, view
from waypost_server.runs import service as runs


@dataclass(frozen=True)
class Page:
    """Which page of rows that are shown newest first: those before one id, or those just after another."""

    before: int | None = None
    after: int | None = None
    limit: int = 50

    def of(self, statement: Select[Any], key: ColumnElement[int]) -> Select[Any]:
        """Return the statement for this page; `in_order` puts its rows right."""
        if self.before is not None:
            statement = statement.where(key < self.before)
        if self.after is not None:
            statement = statement.where(key > self.after)
        return statement.order_by(key.asc() if self.after is not None else key.desc()).limit(self.limit)

    def in_order(self, rows: Sequence[Row[Any]]) -> Iterator[Row[Any]]:
        """Yield a page's rows, newest first."""
        return reversed(rows) if self.after is not None else iter(rows)


@dataclass(frozen=True)
class QueryFilter:
    """Which queries of a run to show."""

    state: wire.QueryState | None = None
    kind: wire.Kind | None = None
    episode: int | None = None
    annotator: str | None = None


@dataclass(frozen=True)
class LedgerFilter:
    """Which lines of a run's ledger to show."""

    kind: wire.Kind | None = None
    entry: wire.LedgerEntryKind | None = None


_annotator = users.alias("annotator")
_holder = users.alias("holder")


_FROM = (
    queries.outerjoin(answers, answers.c.id == queries.c.answer_id)
    .outerjoin(_annotator, _annotator.c.id == answers.c.user_id)
    .outerjoin(assignments, and_(assignments.c.query_id == queries.c.id, IS_LIVE))
    .outerjoin(_holder, _holder.c.id == assignments.c.user_id)
)
_ROWS: Select[Any] = select(
    queries,
    answers.c.content,
    answers.c.units,
    answers.c.seconds,
    answers.c.created_at.label("answered_at"),
    func.coalesce(_annotator.c.name, _holder.c.name).label("annotator"),
).select_from(_FROM)


def query_page(tx: Tx, run: str, chosen: QueryFilter, page: Page) -> wire.QueryPage:
    """Return a page of a run's queries, without their trajectories."""
    runs.find(tx, run)
    conditions = _query_conditions(run, chosen)
    counted = select(func.count(), func.max(queries.c.id), func.min(queries.c.id)).where(*conditions)
    joined: FromClause = queries if chosen.annotator is None else _FROM
    total, newest, oldest = tx.conn.execute(counted.select_from(joined)).one()
    rows = list(page.in_order(tx.conn.execute(page.of(_ROWS.where(*conditions), queries.c.id)).all()))
    endings = _endings(tx, [row.id for row in rows])
    shown = [_query_row(row, endings) for row in rows]
    return wire.QueryPage(rows=shown, total=total, newest=newest, oldest=oldest)


def _query_conditions(run: str, chosen: QueryFilter) -> list[ColumnElement[bool]]:
    conditions: list[ColumnElement[bool]] = [queries.c.run_id == run]
    if chosen.state is not None:
        conditions.append(queries.c.state == chosen.state)
    if chosen.kind is not None:
        conditions.append(queries.c.kind == chosen.kind)
    if chosen.episode is not None:
        conditions.append(queries.c.episode == chosen.episode)
    if chosen.annotator is not None:
        conditions.append(or_(_annotator.c.name == chosen.annotator, _holder.c.name == chosen.annotator))
    return conditions


def _endings(tx: Tx, ids: Sequence[int]) -> dict[tuple[int, str], int]:
    """Return how many assignments of these queries ended in each way."""
    counted = (
        select(assignments.c.query_id, assignments.c.state, func.count())
        .where(assignments.c.query_id.in_(ids))
        .group_by(assignments.c.query_id, assignments.c.state)
    )
    return {(row[0], row[1]): row[2] for row in tx.conn.execute(counted)}


def _query_row(row: Row[Any], endings: dict[tuple[int, str], int]) -> wire.QueryRow:
    return wire.QueryRow(
        id=row.id,
        episode=row.episode,
        ordinal=row.ordinal,
        kind=row.kind,
        state=row.state,
        priority=row.priority,
        question=json.loads(row.ask)["question"],
        created_at=row.created_at,
        answered_at=row.answered_at,
        answer=None if row.content is None else ANSWER.validate_json(row.content),
        used=row.used,
        annotator=row.annotator,
        units=None if row.units is None else to_units(row.units),
        seconds=row.seconds,
        skips=endings.get((row.id, "skipped"), 0),
        expiries=endings.get((row.id, "expired"), 0),
    )


# --- the ledger -----------------------------------------------------------------------------------------------------


_LINES: Select[Any] = (
    select(ledger, queries.c.ordinal, users.c.name.label("annotator"))
    .join(queries, queries.c.id == ledger.c.query_id)
    .join(answers, answers.c.id == ledger.c.answer_id)
    .join(users, users.c.id == answers.c.user_id)
)


def ledger_page(tx: Tx, run: str, chosen: LedgerFilter, page: Page) -> wire.LedgerPage:
    """Return a page of a run's ledger, and the sums of all its pages."""
    account = runs.find(tx, run)
    conditions: list[ColumnElement[bool]] = [ledger.c.run_id == run]
    if chosen.kind is not None:
        conditions.append(ledger.c.kind == chosen.kind)
    if chosen.entry is not None:
        conditions.append(ledger.c.entry == chosen.entry)
    sums = tx.conn.execute(
        select(
            func.count(),
            func.max(ledger.c.id),
            func.min(ledger.c.id),
            func.coalesce(func.sum(ledger.c.units), 0),
            func.coalesce(func.sum(ledger.c.lo_units), 0),
            func.coalesce(func.sum(ledger.c.seconds), 0.0),
        ).where(*conditions)
    ).one()
    rows = tx.conn.execute(page.of(_LINES.where(*conditions), ledger.c.id)).all()
    return wire.LedgerPage(
        entries=_entries(tx, run, list(page.in_order(rows))),
        total=sums[0],
        newest=sums[1],
        oldest=sums[2],
        units=to_units(int(sums[3])),
        lo_units=to_units(int(sums[4])),
        seconds=float(sums[5]),
        spent=to_units(account.spent),
    )


def ledger_after(tx: Tx, run: str, after: int, limit: int) -> list[wire.LedgerEntry]:
    """Return the next lines of a run's ledger, oldest first."""
    page = _LINES.where(ledger.c.run_id == run, ledger.c.id > after).order_by(ledger.c.id).limit(limit)
    return _entries(tx, run, tx.conn.execute(page).all())


def _entries(tx: Tx, run: str, rows: Sequence[Row[Any]]) -> list[wire.LedgerEntry]:
    """Return lines of a run's ledger, each with what the run had spent by then."""
    if not rows:
        return []
    ids = [row.id for row in rows]
    of_run, within = ledger.c.run_id == run, ledger.c.id.between(min(ids), max(ids))
    before = select(func.coalesce(func.sum(ledger.c.units), 0)).where(of_run, ledger.c.id < min(ids))
    spent_before = int(tx.conn.execute(before).scalar_one())
    spent = func.sum(ledger.c.units).over(order_by=ledger.c.id).label("spent")
    running = select(ledger.c.id, spent).where(of_run, within).subquery()
    sums = tx.conn.execute(select(running).where(running.c.id.in_(ids)))
    balances = {row.id: spent_before + int(row.spent) for row in sums}
    return [_entry(row, balances[row.id]) for row in rows]


def _entry(row: Row[Any], balance: int) -> wire.LedgerEntry:
    return wire.LedgerEntry(
        id=row.id,
        at=row.created_at,
        entry=row.entry,
        kind=row.kind,
        query=row.query_id,
        episode=row.episode,
        ordinal=row.ordinal,
        annotator=row.annotator,
        units=to_units(row.units),
        lo_units=to_units(row.lo_units),
        seconds=row.seconds,
        balance=to_units(balance),
    )


# --- one query ------------------------------------------------------------------------------------------------------


def history(tx: Tx, query: int) -> wire.QueryHistory:
    """Return everything that became of a query, and its neighbors in its run.

    Raises:
        NotFound: if there is no such query.
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
    charged = _LINES.where(ledger.c.query_id == query, ledger.c.run_id == found.run).order_by(ledger.c.id)
    return wire.QueryHistory(
        assignments=past,
        ledger=_entries(tx, found.run, tx.conn.execute(charged).all()),
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
