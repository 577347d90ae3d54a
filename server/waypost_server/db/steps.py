"""The steps of a deletion: each names rows, and says what becomes of them. A dry run counts the same rows."""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy import ColumnElement, Table, delete, func, select, text, update

from waypost_server.db.transaction import Tx


@dataclass(frozen=True)
class Step:
    """Some rows of a table.

    Args:
        counted_as: the field of the reply in which they are counted.
        table: the table.
        rows: the condition that they fulfil.
        becomes: the columns that lose their content, with what they have instead; empty if the rows are deleted.
    """

    counted_as: str
    table: Table
    rows: ColumnElement[bool]
    becomes: Mapping[str, Any] = field(default_factory=dict)


def count(tx: Tx, steps: Iterable[Step]) -> Counter[str]:
    """Return how many rows the steps would change, by the field in which they are counted."""
    found = Counter[str]()
    for step in steps:
        rows = select(func.count()).select_from(step.table).where(step.rows)
        found[step.counted_as] += int(tx.conn.execute(rows).scalar_one())
    return found


def take(tx: Tx, steps: Iterable[Step]) -> Counter[str]:
    """Carry out the steps; return how many rows they changed, by the field in which they are counted."""
    done = Counter[str]()
    for step in steps:
        change: Any = update(step.table).values(**step.becomes) if step.becomes else delete(step.table)
        done[step.counted_as] += tx.conn.execute(change.where(step.rows)).rowcount
    return done


def take_time(tx: Tx) -> None:
    """Let the statements of this transaction take as long as they need: a run can have a million queries."""
    if not tx.one_writer:
        tx.conn.execute(text("SET LOCAL statement_timeout = 0"))
