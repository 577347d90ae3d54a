"""A run's tables as CSV or JSON Lines, streamed a page of rows at a time, however long the run is.

CSV is often opened in a spreadsheet, which would carry out a cell that begins like a formula. Text that people or
programs chose (names, questions) is therefore preceded by an apostrophe there if it begins with one of
`= + - @`, a tab or a line break. JSON Lines carry it as it is.
"""

import csv
import io
import json
from collections.abc import AsyncIterator, Callable, Iterable, Mapping, Sequence

from pydantic import JsonValue

from waypost import wire
from waypost_server.db import canonical
from waypost_server.db.engine import Tx
from waypost_server.db.tables import queries as query_table
from waypost_server.http.context import Context
from waypost_server.queries import service as queries
from waypost_server.runs import curves
from waypost_server.watch import browsing

PAGE = 500
FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "\uff1d", "\uff0b", "\uff0d", "\uff20")
MEDIA_TYPES: Mapping[wire.ExportFormat, str] = {"csv": "text/csv; charset=utf-8", "jsonl": "application/jsonl"}

Record = dict[str, JsonValue]
Records = list[tuple[int, Record]]  # each with where to go on after it
Look = Callable[[Tx, str, int], Records]  # a run's rows past a cursor

LEDGER_COLUMNS = tuple(wire.LedgerEntry.model_fields)
QUERY_COLUMNS = (
    "id",
    "episode",
    "ordinal",
    "kind",
    "state",
    "priority",
    "question",
    "created_at",
    "annotator",
    "units",
    "seconds",
    "used",
    "answer",
)
_COST = "cost_"
CURVE_COLUMNS = (
    *(name for name in wire.Curves.model_fields if name != "cost_by_kind"),
    *(f"{_COST}{kind}" for kind in wire.KINDS),
)
COLUMNS: Mapping[wire.ExportTable, Sequence[str]] = {
    "curves": CURVE_COLUMNS,
    "ledger": LEDGER_COLUMNS,
    "queries": QUERY_COLUMNS,
}


def harmless(value: str) -> str:
    """Return a text that no spreadsheet takes for a formula."""
    return f"'{value}" if value.startswith(FORMULA) else value


def csv_line(values: Iterable[JsonValue]) -> str:
    """Return a line of CSV (RFC 4180): nothing for null, JSON for what is nested."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\r\n").writerow([_cell(value) for value in values])
    return text.getvalue()


def _cell(value: JsonValue) -> JsonValue:
    if isinstance(value, str):
        return harmless(value)
    if isinstance(value, bool):
        return str(value).lower()
    return canonical.text(value) if isinstance(value, dict | list) else value


async def stream(context: Context, run: str, table: wire.ExportTable, form: wire.ExportFormat) -> AsyncIterator[str]:
    """Yield a table of a run, in the order things happened."""
    look = LOOKS[table]
    columns = COLUMNS[table]
    if form == "csv":
        yield csv_line(columns)
    cursor = -1
    while records := await context.db.read(_following(look, run, cursor)):
        if form == "csv":
            yield "".join(csv_line(record.get(name) for name in columns) for _, record in records)
        else:
            yield "".join(f"{json.dumps(record)}\n" for _, record in records)
        cursor = records[-1][0]


def _following(look: Look, run: str, after: int) -> Callable[[Tx], Records]:
    return lambda tx: look(tx, run, after)


def _curves(tx: Tx, run: str, after: int) -> Records:
    """Return a record per reported episode past one."""
    found = curves.curves(tx, run, after).model_dump(mode="json")
    by_kind = found.pop("cost_by_kind")
    found |= {f"{_COST}{kind}": sums for kind, sums in by_kind.items()}
    rows = (dict(zip(found, row, strict=True)) for row in zip(*found.values(), strict=True))
    return [(row["episode"], row) for row in rows]


def _ledger(tx: Tx, run: str, after: int) -> Records:
    """Return the next lines of the ledger."""
    return [(line.id, line.model_dump(mode="json")) for line in browsing.ledger_after(tx, run, after, PAGE)]


def _queries(tx: Tx, run: str, after: int) -> Records:
    """Return the next queries, whole: what was asked with its trajectory, and the answer."""
    chosen = queries.QUERIES.where(query_table.c.run_id == run, query_table.c.id > after)
    rows = tx.conn.execute(chosen.order_by(query_table.c.id).limit(PAGE))
    return [(row.id, _flat(queries.of_row(row))) for row in rows]


def _flat(query: wire.Query) -> Record:
    """Return a query with what names it beside it, where a table looks for it."""
    record: Record = query.model_dump(mode="json")
    ask = query.ask
    return record | {"episode": ask.episode, "ordinal": ask.ordinal, "kind": ask.kind, "question": ask.question}


LOOKS: Mapping[wire.ExportTable, Look] = {"curves": _curves, "ledger": _ledger, "queries": _queries}
