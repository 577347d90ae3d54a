"""Export of a run's tables as CSV or JSON Lines. Queries and ledger are read in parts, so that they need little memory.

Spreadsheets execute a CSV cell that begins like a formula. So in CSV, a text gets a leading apostrophe if it begins
with `= + - @` (also in full width), a tab or a line break. JSON Lines keep the text unchanged.
"""

import csv
import io
import json
from collections.abc import AsyncIterator, Callable, Iterable, Mapping, Sequence

from pydantic import JsonValue

from waypost import wire
from waypost_server.db import canonical
from waypost_server.db.tables import queries as query_table
from waypost_server.db.transaction import Tx
from waypost_server.http.context import Context
from waypost_server.queries import service as queries
from waypost_server.runs import curves
from waypost_server.watch import ledger_rows

PAGE = 500  # rows read at once
FORMULA = ("=", "+", "-", "@", "\t", "\r", "\n", "\uff1d", "\uff0b", "\uff0d", "\uff20")
MEDIA_TYPES: Mapping[wire.ExportFormat, str] = {"csv": "text/csv; charset=utf-8", "jsonl": "application/jsonl"}

Record = dict[str, JsonValue]
Records = list[tuple[int, Record]]  # each with the cursor after it
Read = Callable[[Tx, str, int], Records]  # a run's next rows after a cursor

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
    """Return a text that no spreadsheet treats as a formula."""
    return f"'{value}" if value.startswith(FORMULA) else value


def csv_line(values: Iterable[JsonValue]) -> str:
    """Return a line of CSV (RFC 4180). Null becomes an empty cell; nested values become JSON."""
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
    """Yield a table of a run, oldest rows first."""
    read_rows = READERS[table]
    columns = COLUMNS[table]
    if form == "csv":
        yield csv_line(columns)
    cursor = -1
    while records := await context.db.read(_following(read_rows, run, cursor)):
        if form == "csv":
            yield "".join(csv_line(record.get(name) for name in columns) for _, record in records)
        else:
            yield "".join(f"{json.dumps(record)}\n" for _, record in records)
        cursor = records[-1][0]


def _following(read_rows: Read, run: str, after: int) -> Callable[[Tx], Records]:
    return lambda tx: read_rows(tx, run, after)


def _curves(tx: Tx, run: str, after: int) -> Records:
    """Return one record per reported episode after a cursor."""
    found = curves.curves(tx, run, after).model_dump(mode="json")
    by_kind = found.pop("cost_by_kind")
    found |= {f"{_COST}{kind}": sums for kind, sums in by_kind.items()}
    by_subgoal = found.pop("reached")
    found["reached"] = [
        {name: rates[row] for name, rates in by_subgoal.items()} for row in range(len(found["episode"]))
    ]
    rows = (dict(zip(found, row, strict=True)) for row in zip(*found.values(), strict=True))
    return [(row["episode"], row) for row in rows]


def _ledger(tx: Tx, run: str, after: int) -> Records:
    """Return the next entries of the ledger."""
    return [(line.id, line.model_dump(mode="json")) for line in ledger_rows.ledger_after(tx, run, after, PAGE)]


def _queries(tx: Tx, run: str, after: int) -> Records:
    """Return the next queries, with their trajectories and answers."""
    chosen = queries.QUERIES.where(query_table.c.run_id == run, query_table.c.id > after)
    rows = tx.conn.execute(chosen.order_by(query_table.c.id).limit(PAGE))
    return [(row.id, _flat(queries.of_row(row))) for row in rows]


def _flat(query: wire.Query) -> Record:
    """Return a query with the columns of the table at the top level."""
    record: Record = query.model_dump(mode="json")
    ask = query.ask
    return record | {"episode": ask.episode, "ordinal": ask.ordinal, "kind": ask.kind, "question": ask.question}


READERS: Mapping[wire.ExportTable, Read] = {"curves": _curves, "ledger": _ledger, "queries": _queries}
