"""Statements that are compiled once and then run by the database driver itself.

SQLAlchemy takes about 35 microseconds to run a small statement, SQLite's driver 2. A lease and an answer run some
thirty, so the statements on their way are prepared. All others run as usual. Both kinds share the transaction.
"""

from collections import namedtuple
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

from sqlalchemy import Boolean, Connection, Delete, Dialect, Insert, Select, Update

from waypost_server.db.sending import Line, Rows, line_of

Statement = Select[Any] | Insert | Update | Delete
Parameters = Mapping[str, Any]
Record = Any
"""A row: its columns are attributes."""
Columns = Any
"""Rows by column: each attribute has a column's values."""

_TRUTHS = {0: False, 1: True}


@dataclass(frozen=True)
class Compiled:
    """A statement in the words of one database."""

    sql: str
    arrange: Callable[[Parameters], Any]  # arranges its parameters as the driver takes them: by place or by name
    constants: Parameters  # the values that the statement itself contains
    row: Any  # the named tuple of its rows; None if it returns none
    truths: Sequence[int]  # the columns that this database stores as 0 and 1

    def arguments(self, parameters: Parameters) -> Any:
        """Return the parameters as the driver takes them.

        Raises:
            KeyError: one is missing.
        """
        return self.arrange({**self.constants, **parameters} if self.constants else parameters)

    def row_of(self, values: Sequence[Any]) -> Any:
        """Return a row of the driver as a named tuple."""
        if self.truths:
            values = list(values)
            for place in self.truths:
                values[place] = _TRUTHS.get(values[place])
        return self.row._make(values)


class Prepared:
    """A statement that is run often. Its rows are named tuples with the names of its columns.

    Its methods take the connection of the transaction, and raise errors as SQLAlchemy does.

    Args:
        statement: with a `bindparam` for every value that changes, and without `in_`, whose values are written into
            the statement only when it is run. If databases need different statements: by dialect.
        columns: of an INSERT without values: the columns that get parameters of the same names.
    """

    def __init__(self, statement: Statement | Mapping[str, Statement], columns: Collection[str] | None = None) -> None:
        self._statement, self._columns = statement, columns
        self._compiled: dict[str, Compiled] = {}

    def run(self, conn: Connection, parameters: Parameters) -> None:
        """Run a statement whose rows nobody needs. On PostgreSQL, a later one sends it, or fails with it."""
        line, compiled = self._line(conn)
        line.run(conn, compiled.sql, compiled.arguments(parameters))

    def ahead(self, conn: Connection, parameters: Parameters) -> None:
        """Say that a read with these parameters will follow, so that PostgreSQL gets it together with others.

        It reads, and locks, before those: what comes between the two must not change what it reads.
        """
        line, compiled = self._line(conn)
        if line.lets_wait:
            line.ahead(conn, compiled.sql, compiled.arguments(parameters))

    def rows(self, conn: Connection, parameters: Parameters) -> list[Record]:
        """Return all rows."""
        compiled, found = self._read(conn, parameters)
        return list(map(compiled.row_of, found))

    def columns(self, conn: Connection, parameters: Parameters) -> Columns:
        """Return all rows by column, which takes half the time of many records."""
        compiled, found = self._read(conn, parameters)
        columns: list[Sequence[Any]] = list(zip(*found, strict=True)) if found else [()] * len(compiled.row._fields)
        for place in compiled.truths:
            columns[place] = [_TRUTHS.get(value) for value in columns[place]]
        return compiled.row._make(columns)

    def first(self, conn: Connection, parameters: Parameters) -> Record | None:
        """Return the first row, or None if there is none."""
        compiled, found = self._read(conn, parameters)
        return compiled.row_of(found[0]) if found else None

    def one(self, conn: Connection, parameters: Parameters) -> Record:
        """Return the first row of a statement that always has one."""
        compiled, found = self._read(conn, parameters)
        return compiled.row_of(found[0])

    def value(self, conn: Connection, parameters: Parameters) -> Any:
        """Return the first column of the first row of a statement that always has one."""
        _, found = self._read(conn, parameters)
        return found[0][0]

    def _read(self, conn: Connection, parameters: Parameters) -> tuple[Compiled, Rows]:
        line, compiled = self._line(conn)
        return compiled, line.read(conn, compiled.sql, compiled.arguments(parameters))

    def _line(self, conn: Connection) -> tuple[Line, Compiled]:
        if not conn.in_transaction():
            conn.begin()  # as SQLAlchemy does, which would otherwise not know of the transaction
        return line_of(conn), self._in(conn.dialect)

    def _in(self, dialect: Dialect) -> Compiled:
        compiled = self._compiled.get(dialect.name)
        if compiled is None:
            compiled = self._compiled[dialect.name] = self._compile(dialect)
        return compiled

    def _compile(self, dialect: Dialect) -> Compiled:
        statement = self._statement[dialect.name] if isinstance(self._statement, Mapping) else self._statement
        columns = None if self._columns is None else list(self._columns)
        sql = statement.compile(dialect=dialect, column_keys=columns)
        returned = statement.exported_columns
        names = [str(name) for name in returned.keys()]  # noqa: SIM118 - it is no dict
        return Compiled(
            str(sql),
            _by_place(sql.positiontup or []) if sql.positional else _by_name([*dict.fromkeys(sql.bind_names.values())]),
            {name: bind.value for bind, name in sql.bind_names.items() if not bind.required},
            namedtuple("Row", names) if names else None,
            ()
            if dialect.supports_native_boolean
            else [place for place, column in enumerate(returned) if isinstance(column.type, Boolean)],
        )


def _by_place(order: Sequence[str]) -> Callable[[Parameters], Any]:
    """Return what arranges parameters in an order."""
    if len(order) > 1:
        return itemgetter(*order)  # in C, as these functions run for every statement
    return lambda given: [given[name] for name in order]


def _by_name(names: Sequence[str]) -> Callable[[Parameters], Any]:
    """Return what takes the parameters with these names, and leaves others out."""
    values = _by_place(names)
    return lambda given: dict(zip(names, values(given), strict=True))
