"""The table and the export of the audit log."""

from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any

from sqlalchemy import ColumnElement, Row, func, select

from waypost import wire
from waypost_server.db import audit as chain
from waypost_server.db import canonical
from waypost_server.db.engine import Database
from waypost_server.db.tables import audit
from waypost_server.db.transaction import Tx
from waypost_server.watch.export import csv_line
from waypost_server.watch.row_pages import RowPage

COLUMNS = ("number", "at", "user", "actor", "address", "action", "object", "details", "previous", "hash")


@dataclass(frozen=True)
class AuditFilter:
    """The filter of the audit log; `since` and `until` are seconds since the epoch, and `until` itself is left out."""

    actor: str | None = None
    action: wire.AuditAction | None = None
    since: float | None = None
    until: float | None = None


def audit_page(tx: Tx, chosen: AuditFilter, page: RowPage) -> wire.AuditPage:
    """Return one page of the audit log, newest first."""
    conditions = _conditions(chosen)
    counted = select(func.count(), func.max(audit.c.number), func.min(audit.c.number)).where(*conditions)
    total, newest, oldest = tx.conn.execute(counted).one()
    rows = tx.conn.execute(page.of(select(audit).where(*conditions), audit.c.number)).all()
    shown = [wire.AuditRow.model_validate(_record(row)) for row in page.in_order(rows)]
    head = chain.head(tx.conn)
    return wire.AuditPage(
        rows=shown, total=total, newest=newest, oldest=oldest, head=None if head is None else str(head)
    )


def _conditions(chosen: AuditFilter) -> list[ColumnElement[bool]]:
    conditions: list[ColumnElement[bool]] = []
    if chosen.actor is not None:
        conditions.append(audit.c.actor == chosen.actor)
    if chosen.action is not None:
        conditions.append(audit.c.action == chosen.action)
    if chosen.since is not None:
        conditions.append(audit.c.at >= chain.moment(chosen.since))
    if chosen.until is not None:
        conditions.append(audit.c.at < chain.moment(chosen.until))
    return conditions


async def stream(db: Database, form: wire.ExportFormat) -> AsyncIterator[str]:
    """Yield the whole audit log, oldest rows first. Lines of JSON are canonical, as what the hashes are made of."""
    if form == "csv":
        yield csv_line(COLUMNS)
    number = 0
    while records := await db.read(_following(number)):
        if form == "csv":
            yield "".join(csv_line(record[name] for name in COLUMNS) for record in records)
        else:
            yield "".join(f"{canonical.text(record)}\n" for record in records)
        number = records[-1]["number"]


def _following(number: int) -> Any:
    return lambda tx: [_record(row) for row in chain.rows_after(tx.conn, number)]


def _record(row: Row[Any]) -> dict[str, Any]:
    return chain.content(row._asdict()) | {"hash": row.hash}
