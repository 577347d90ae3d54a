"""Pagination of rows that are shown newest first."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from sqlalchemy import ColumnElement, Select

T = TypeVar("T")


@dataclass(frozen=True)
class RowPage:
    """One page of rows: those older than the row `before`, or those just newer than the row `after`."""

    before: int | None = None
    after: int | None = None
    limit: int = 50

    def of(self, statement: Select[Any], key: ColumnElement[int]) -> Select[Any]:
        """Return the statement that selects this page. Then call `in_order` to sort its rows."""
        if self.before is not None:
            statement = statement.where(key < self.before)
        if self.after is not None:
            statement = statement.where(key > self.after)
        return statement.order_by(key.asc() if self.after is not None else key.desc()).limit(self.limit)

    def in_order(self, rows: Sequence[T]) -> Iterator[T]:
        """Yield the rows of this page, newest first."""
        return reversed(rows) if self.after is not None else iter(rows)
