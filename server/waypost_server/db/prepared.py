"""Statements that are compiled once and then run by the database driver itself.

SQLAlchemy takes about 35 microseconds to run a small statement, the driver 2. A lease and an answer run some thirty, so
the statements on their way are prepared. All others run as usual. Both kinds share the transaction.
"""

from collections import namedtuple
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

from sqlalchemy import Boolean, Connection, Delete, Dialect, Insert, Select, Update
from sqlalchemy.exc import DBAPIError

Statement = Select[Any] | Insert | Update | Delete
Parameters = Mapping[str, Any]
Record = Any
"""A row: its columns are attributes."""

_TRUTHS = {0: False, 1: True}
_CURSOR = "the cursor of prepared statements"  # in the information that the pool keeps of a connection


@dataclass(frozen=True)
class Compiled:
    """A statement in the words of one database."""

    sql: str
    in_order: Callable[[Parameters], Any] | None  # arranges its parameters, where they have places instead of names
    constants: Parameters  # the values that the statement itself contains
    row: Any  # the named tuple of its rows; None if it returns none
    truths: Sequence[int]  # the columns that this database stores as 0 and 1

    def arguments(self, parameters: Parameters) -> Any:
        """Return the parameters as the driver takes them.

        Raises:
            KeyError: one is missing.
        """
        given = {**self.constants, **parameters} if self.constants else parameters
        return given if self.in_order is None else self.in_order(given)

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
        """Run a statement that returns no rows."""
        self._execute(conn, self._in(conn.dialect), parameters)

    def rows(self, conn: Connection, parameters: Parameters) -> list[Record]:
        """Return all rows."""
        compiled, found = self._read(conn, parameters)
        return list(map(compiled.row_of, found))

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

    def _read(self, conn: Connection, parameters: Parameters) -> tuple[Compiled, list[Any]]:
        """Return all rows as the driver has them. SQLite keeps what an unread row belongs to, even after a commit."""
        compiled = self._in(conn.dialect)
        return compiled, self._execute(conn, compiled, parameters).fetchall()

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
            _arranging(sql.positiontup or []) if sql.positional else None,
            {name: bind.value for bind, name in sql.bind_names.items() if not bind.required},
            namedtuple("Row", names) if names else None,
            ()
            if dialect.supports_native_boolean
            else [place for place, column in enumerate(returned) if isinstance(column.type, Boolean)],
        )

    def _execute(self, conn: Connection, compiled: Compiled, parameters: Parameters) -> Any:
        if not conn.in_transaction():
            conn.begin()  # as SQLAlchemy does, which would otherwise not know of the transaction
        return run_sql(conn, compiled.sql, compiled.arguments(parameters))


def _arranging(order: Sequence[str]) -> Callable[[Parameters], Any]:
    """Return what arranges parameters in an order."""
    if len(order) > 1:
        return itemgetter(*order)  # in C, as these functions run for every statement
    return lambda given: [given[name] for name in order]


def run_sql(conn: Connection, sql: str, arguments: Any = ()) -> Any:
    """Let the driver run a statement, and return its cursor, which the next statement of the connection uses again.

    Raises:
        DBAPIError: as SQLAlchemy raises it, so that all statements fail alike.
    """
    pooled: Any = conn.connection
    cursor = pooled.info.get(_CURSOR)
    if cursor is None:  # psycopg takes as long to make a cursor as to run a small statement
        cursor = pooled.info[_CURSOR] = pooled.dbapi_connection.cursor()
    dialect = conn.dialect
    try:
        cursor.execute(sql, arguments)
    except dialect.loaded_dbapi.Error as error:
        lost = dialect.is_disconnect(error, pooled.dbapi_connection, cursor)
        if lost:
            conn.invalidate(error)
        base = dialect.loaded_dbapi.Error
        raise DBAPIError.instance(sql, None, error, base, connection_invalidated=lost, dialect=dialect) from error
    return cursor
