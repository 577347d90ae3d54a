"""The table of a run's ledger."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, Row, Select, func, select

from waypost import wire
from waypost.prices import to_units
from waypost_server.db.tables import answers, ledger, queries, users
from waypost_server.db.transaction import Tx
from waypost_server.runs import service as runs
from waypost_server.watch.row_pages import RowPage


@dataclass(frozen=True)
class LedgerFilter:
    """The filter of a run's ledger."""

    kind: wire.Kind | None = None
    entry: wire.LedgerEntryKind | None = None


ENTRIES: Select[Any] = (
    select(ledger, queries.c.ordinal, users.c.name.label("annotator"))
    .join(queries, queries.c.id == ledger.c.query_id)
    .join(answers, answers.c.id == ledger.c.answer_id)
    .join(users, users.c.id == answers.c.user_id)
)


def ledger_page(tx: Tx, run: str, chosen: LedgerFilter, page: RowPage) -> wire.LedgerPage:
    """Return one page of a run's ledger, newest first, and the sums over all pages."""
    account = runs.find_account(tx, run)
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
    rows = tx.conn.execute(page.of(ENTRIES.where(*conditions), ledger.c.id)).all()
    return wire.LedgerPage(
        entries=entries_of(tx, run, list(page.in_order(rows))),
        total=sums[0],
        newest=sums[1],
        oldest=sums[2],
        units=to_units(int(sums[3])),
        lo_units=to_units(int(sums[4])),
        seconds=float(sums[5]),
        spent=to_units(account.spent),
    )


def ledger_after(tx: Tx, run: str, after: int, limit: int) -> list[wire.LedgerEntry]:
    """Return the next entries of a run's ledger, oldest first."""
    page = ENTRIES.where(ledger.c.run_id == run, ledger.c.id > after).order_by(ledger.c.id).limit(limit)
    return entries_of(tx, run, tx.conn.execute(page).all())


def entries_of(tx: Tx, run: str, rows: Sequence[Row[Any]]) -> list[wire.LedgerEntry]:
    """Return entries of a run's ledger, each with the balance after it: the units that the run had spent."""
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
