"""How prepared statements get to the database: to SQLite each by itself, to PostgreSQL several in one round trip.

A round trip to PostgreSQL takes longer than a small statement. So a statement whose rows nobody needs yet waits. It is
sent with the next prepared statement whose rows are needed, or with the commit; or by itself before a statement of
SQLAlchemy, and at both ends of a part of a transaction. Only then can it fail. The order stays.
"""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import psycopg
from sqlalchemy import Connection
from sqlalchemy.exc import DBAPIError

from waypost_server import errors

Rows = list[Any]
"""Rows as the driver has them."""
BEGIN = "BEGIN"
LOCKED = "55P03"  # PostgreSQL: another transaction has locked the rows, and this one must not wait for it
TOGETHER = "together"
"""An option of engines: `BEGIN` and `COMMIT` go through the line, so statements may wait."""
_COMMIT = "COMMIT"
_LINE = "the line of a connection"  # in the information that the pool keeps of it


class MustWait(Exception):
    """A transaction that must not wait needs rows that another one has locked."""


class Line(Protocol):
    """The way of statements to the database, through one connection of the driver.

    Errors of the driver are raised as SQLAlchemy raises them, so that all statements fail alike.
    """

    lets_wait: bool
    """Whether statements wait to be sent together."""
    may_wait: bool
    """Whether a statement may wait for rows that others have locked. Otherwise it raises `MustWait`."""
    is_spoilt: bool
    """Whether no further transaction may use the connection."""

    def run(self, conn: Connection, sql: str, arguments: Any = (), /) -> None:
        """Run a statement whose rows nobody needs, at once or together with a later one."""
        ...

    def ahead(self, conn: Connection, sql: str, arguments: Any, /) -> None:
        """Send a read together with the next statement, if that saves a round trip. An equal `read` gets its rows.

        What comes between the two must not change what it reads.
        """
        ...

    def read(self, conn: Connection, sql: str, arguments: Any) -> Rows:
        """Return the rows of a statement."""
        ...

    def flush(self, conn: Connection) -> None:
        """Send what waits."""
        ...

    def commit(self, conn: Connection) -> None:
        """Commit what waits with the transaction."""
        ...

    def forget(self) -> None:
        """Forget what was read ahead: another request begins."""
        ...

    def drop(self) -> None:
        """Drop what waits, because it belongs to what is undone."""
        ...


def line_of(conn: Connection) -> Line:
    """Return the line of a connection."""
    pooled: Any = conn.connection
    line: Line | None = pooled.info.get(_LINE)
    if line is None:
        new = Together if TOGETHER in conn.get_execution_options() else Single
        line = pooled.info[_LINE] = new(pooled.dbapi_connection)
    return line


class Single:
    """Runs each statement when it comes (SQLite, and engines that `db.engine` did not make)."""

    lets_wait = False
    may_wait = True
    is_spoilt = False

    def __init__(self, driver: Any) -> None:
        self._cursor: Any = driver.cursor()

    def run(self, conn: Connection, sql: str, arguments: Any = ()) -> None:
        """Run a statement now."""
        self.read(conn, sql, arguments)

    def ahead(self, _conn: Connection, sql: str, arguments: Any) -> None:
        """Do nothing: it would save nothing."""

    def read(self, conn: Connection, sql: str, arguments: Any) -> Rows:
        """Return the rows. All are read: an unread row keeps its statement open in SQLite, even after a commit."""
        try:
            self._cursor.execute(sql, arguments)
            return self._cursor.fetchall() if self._cursor.description else []
        except conn.dialect.loaded_dbapi.Error as error:
            raise _raised(conn, error, sql) from error

    def flush(self, conn: Connection) -> None:
        """Do nothing: nothing waits."""

    def commit(self, conn: Connection) -> None:
        """Do nothing: SQLAlchemy commits."""

    def forget(self) -> None:
        """Do nothing: nothing is read ahead."""

    def drop(self) -> None:
        """Do nothing: nothing waits."""


class Sent:
    """A statement on its way, and its rows once they are there."""

    __slots__ = ("arguments", "rows", "sql")

    def __init__(self, sql: str, arguments: Mapping[str, Any] | Sequence[Any]) -> None:
        self.sql, self.arguments = sql, arguments
        self.rows: Rows | None = None


class Together:
    """Sends statements in pipelines (PostgreSQL)."""

    lets_wait = True
    may_wait = True
    is_spoilt = False

    def __init__(self, driver: psycopg.Connection[Any]) -> None:
        self._driver = driver
        self._cursors: dict[str, psycopg.Cursor[Any]] = {}  # by statement: the second time, a cursor has less to do
        self._waiting: list[Sent] = []
        self._ahead: dict[tuple[Any, ...], Sent] = {}

    @property
    def is_waiting(self) -> bool:
        """Whether a statement waits."""
        return bool(self._waiting)

    def run(self, _conn: Connection, sql: str, arguments: Any = ()) -> None:
        """Let a statement wait."""
        self._waiting.append(Sent(sql, arguments))

    def ahead(self, _conn: Connection, sql: str, arguments: Mapping[str, Any]) -> None:
        """Let a read wait, and keep its rows for the next equal one."""
        self._waiting.append(Sent(sql, arguments))
        self._ahead[sql, *arguments.values()] = self._waiting[-1]

    def read(self, conn: Connection, sql: str, arguments: Mapping[str, Any]) -> Rows:
        """Return the rows of a statement. If they are not there yet, send it with what waits."""
        sent = self._ahead.pop((sql, *arguments.values()), None) if self._ahead else None
        if sent is None:
            sent = Sent(sql, arguments)
            self._waiting.append(sent)
        if sent.rows is None:
            self.flush(conn)
        assert sent.rows is not None
        return sent.rows

    def flush(self, conn: Connection) -> None:
        """Send what waits, and wait for the rows. If a statement fails, none of the later ones is run."""
        if not self.is_waiting:
            return
        sending, self._waiting = self._waiting, []
        try:
            if len(sending) == 1:
                cursors = [self._execute(sending[0], set())]
            else:
                busy: set[str] = set()
                with self._driver.pipeline():
                    cursors = [self._execute(sent, busy) for sent in sending]
            for sent, cursor in zip(sending, cursors, strict=True):
                sent.rows = cursor.fetchall() if cursor.pgresult and cursor.pgresult.nfields else []
        except psycopg.Error as error:
            self.drop()
            raised = _raised(conn, error, "; ".join(sent.sql for sent in sending))
            if not raised.connection_invalidated:
                # psycopg may believe a statement prepared that was never sent: use another connection next time.
                self.is_spoilt = True
                conn.connection.invalidate(soft=True)
            raise (MustWait() if error.sqlstate == LOCKED else raised) from error

    def commit(self, conn: Connection) -> None:
        """Send what waits with the commit. SQLAlchemy's own commit, which follows, has nothing left to do."""
        if len(self._waiting) == 1 and self._waiting[0].sql == BEGIN:  # nothing was done
            self.drop()
        else:
            self.run(conn, _COMMIT)
            self.flush(conn)
            # After an error that nobody minded, PostgreSQL answers with ROLLBACK, and reports no other error.
            if self._cursors[_COMMIT].statusmessage != _COMMIT:
                raise errors.StorageFailed(
                    "Nothing was stored, because a statement failed; send the same request again."
                )

    def forget(self) -> None:
        """Forget what was read ahead."""
        self._ahead.clear()

    def drop(self) -> None:
        """Forget what waits, and what was read ahead."""
        self._waiting.clear()
        self._ahead.clear()

    def _execute(self, sent: Sent, busy: set[str]) -> psycopg.Cursor[Any]:
        """Execute a statement with a cursor that has no rows of another one of the same pipeline."""
        if sent.sql in busy:
            cursor = self._driver.cursor()
        else:
            busy.add(sent.sql)
            cursor = self._cursors.get(sent.sql) or self._cursors.setdefault(sent.sql, self._driver.cursor())
        return cursor.execute(sent.sql, sent.arguments)


def _raised(conn: Connection, error: Any, sql: str) -> DBAPIError:
    """Return an error of the driver as SQLAlchemy raises it."""
    dialect = conn.dialect
    base = dialect.loaded_dbapi.Error
    lost = dialect.is_disconnect(error, conn.connection.dbapi_connection, None)
    if lost:
        conn.invalidate(error)
    raised: Any = DBAPIError.instance(sql, None, error, base, connection_invalidated=lost, dialect=dialect)
    assert isinstance(raised, DBAPIError)
    return raised
