"""The store: opens an SQLite or PostgreSQL database, and runs transactions on it.

Transactions run on threads, not on the event loop, and are acknowledged after their commit. One thread with one
connection writes and commits many transactions at once (`db.writers`).
"""

import asyncio
import sqlite3
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

from sqlalchemy import Connection, Engine, create_engine, event, make_url
from sqlalchemy.engine import URL, ExceptionContext
from sqlalchemy.exc import ArgumentError, DBAPIError, NoSuchModuleError

from waypost.tracing import Step
from waypost_server import errors
from waypost_server.db import audit, schema
from waypost_server.db.notifications import Notifications
from waypost_server.db.sending import BEGIN, LOCKED, TOGETHER, MustWait, line_of
from waypost_server.db.transaction import Count, Counts, Tx
from waypost_server.db.wakeups import Topics
from waypost_server.db.writers.group_commit import GroupCommit
from waypost_server.db.writers.load import Load
from waypost_server.db.writers.shared import SharedGroupCommit

T = TypeVar("T")

READERS = 4
BUSY_SECONDS = 15  # SQLite only: how long a transaction waits while another process writes


class BadDatabase(Exception):
    """The database URL cannot be used. The message tells the operator why and what to do."""


class Database:
    """An open store with this version's schema."""

    def __init__(self, url: str, committed: Callable[[Topics], None] | None = None, *, create: bool = True) -> None:
        """Open a store, or create it in an empty database.

        Args:
            url: the URL of the database.
            committed: is called with the topics of each commit, on PostgreSQL also of other processes.
            create: whether to create what does not exist.

        Raises:
            BadDatabase, WrongSchema: with one sentence for the operator.
        """
        self.url = parse(url)
        self.counts = Counts()
        lite = self.url.get_backend_name() == "sqlite"
        if lite and not create:
            _require_file(self.url)
        self._engine, _ = _prepared(self.url, schema.create if create else schema.require)
        self._read_engine = _sqlite(self.url, writes=False) if lite else _postgresql(self.url, writes=False)
        self._readers = ThreadPoolExecutor(READERS, "waypost-read")
        self._notifications = None if lite or committed is None else Notifications(self.url, committed)
        tell = self._notifications.committed if self._notifications else _nobody

        def changed(topics: Topics) -> None:
            (committed or _nobody)(topics)
            tell(topics)

        self._writer = (GroupCommit if lite else SharedGroupCommit)(self._engine, changed)

    def write_now(self, work: Callable[[Tx], T]) -> T:
        """Run a transaction and return its result once it is on disk.

        Raises:
            StorageFailed: nothing was stored, or it is not known whether.
            StoreBusy: nothing was stored.
        """
        return self._submit(work).result()

    def read_now(self, work: Callable[[Tx], T]) -> T:
        """Run reads against one consistent snapshot and return the result."""
        for connections in range(READERS, -1, -1):  # each may have been lost
            try:
                with self._read_engine.begin() as conn:  # psycopg forgets all prepared statements with a rollback
                    return work(Tx(conn))
            except DBAPIError as error:
                if not (error.connection_invalidated and connections):
                    raise errors.StorageFailed(f"The database could not be read: {_first_line(error)}") from error
        raise AssertionError("unreachable")

    async def write(self, work: Callable[[Tx], T]) -> T:
        """Run a transaction off the event loop and return its result once it is on disk.

        Raises:
            StorageFailed: nothing was stored, or it is not known whether.
            StoreBusy: nothing was stored.
        """
        return await asyncio.wrap_future(self._submit(work))

    async def read(self, work: Callable[[Tx], T]) -> T:
        """Run reads off the event loop and return the result."""
        return await asyncio.get_running_loop().run_in_executor(self._readers, self.read_now, work)

    @property
    def load(self) -> Load:
        """How much this process writes."""
        return self._writer.load

    def _submit(self, work: Callable[[Tx], T]) -> Future[T]:
        """Queue a transaction that ends with its rows of the audit log.

        Once it is committed, its counts are added, and its steps end.
        """
        counted: Mapping[Count, int] = {}
        traced: Sequence[Step] = ()

        def run(conn: Connection, topics: Topics) -> T:
            nonlocal counted, traced
            tx = Tx(conn, topics)
            result = work(tx)
            if tx.recorded:
                audit.append(conn, tx.recorded)
            counted, traced = tx.counted, tx.traced
            return result

        def done(future: Future[T]) -> None:
            if future.cancelled() or future.exception() is not None:
                return
            if counted:
                self.counts.add(counted)
            for step in traced:
                step.end()

        future = self._writer.submit(run)
        future.add_done_callback(done)
        return future

    def close(self) -> None:
        """Finish submitted transactions and close every connection."""
        self._writer.close()
        if self._notifications:
            self._notifications.close()
        self._readers.shutdown()
        self._read_engine.dispose()
        self._engine.dispose()


def migrate(url: str, keep: Callable[[], None] = lambda: None) -> schema.Migrated:
    """Bring a store up to this version's schema, or create it in an empty database.

    `keep` is called before a store is changed, while nobody else can migrate it.

    Raises:
        BadDatabase, NewerStore: with one sentence for the operator.
    """
    engine, migrated = _prepared(parse(url), lambda engine: schema.migrate(engine, keep))
    engine.dispose()
    return migrated


def _prepared(url: URL, prepare: Callable[[Engine], T]) -> tuple[Engine, T]:
    """Return the engine that writes to a database, and the result of `prepare`; if that fails, close the engine."""
    engine = _sqlite(url, writes=True) if url.get_backend_name() == "sqlite" else _postgresql(url, writes=True)
    try:
        return engine, prepare(engine)
    except DBAPIError as error:
        engine.dispose()
        raise BadDatabase(f"Cannot open {url.render_as_string()}: {_first_line(error)}") from None
    except BaseException:
        engine.dispose()
        raise


def _require_file(url: URL) -> None:
    """Refuse to go on without the file of an SQLite store: to open it would create it."""
    file = Path(str(url.database))
    if not file.is_file() or not file.stat().st_size:
        raise schema.NoStore(f"There is no store {file}.")


def parse(text: str) -> URL:
    """Return a parsed database URL.

    Raises:
        BadDatabase: with one sentence for the operator.
    """
    try:
        url = make_url(text)
        if url.drivername in {"postgres", "postgresql"}:
            url = url.set(drivername="postgresql+psycopg")
        url.get_dialect()
    except (ArgumentError, NoSuchModuleError, ImportError):
        raise BadDatabase(
            f"{text!r} is not a database URL; use sqlite:///FILE or postgresql://USER@HOST/NAME."
        ) from None
    if url.get_backend_name() not in {"sqlite", "postgresql"}:
        raise BadDatabase(f"{url.get_backend_name()} is not supported; use sqlite:///FILE or postgresql://....")
    if url.get_backend_name() == "sqlite" and url.database in {None, "", ":memory:"}:
        raise BadDatabase("An SQLite store needs a file: sqlite:///FILE.")
    return url


def _first_line(error: DBAPIError) -> str:
    return str(error.orig).strip().partition("\n")[0]


def _sqlite(url: URL, *, writes: bool) -> Engine:
    engine = create_engine(
        url,
        pool_size=1 if writes else READERS,
        hide_parameters=True,  # errors are logged, and parameters are answers and hashes of secrets
        max_overflow=0,
        connect_args={"check_same_thread": False, "timeout": BUSY_SECONDS},
    )

    @event.listens_for(engine, "connect")
    def connected(dbapi: Any, _record: Any) -> None:
        dbapi.isolation_level = None
        cursor = dbapi.cursor()
        cursor.execute("PRAGMA foreign_keys = ON")
        if writes:
            _use_wal(cursor)
            cursor.execute("PRAGMA synchronous = FULL")
            # What a savepoint would undo is kept in memory, not in a file that is created for each transaction.
            cursor.execute("PRAGMA temp_store = MEMORY")
            cursor.execute("PRAGMA secure_delete = ON")  # what is deleted is overwritten
        else:
            # Only the writing connection checkpoints; readers neither write nor truncate the log.
            cursor.execute("PRAGMA query_only = ON")
            cursor.execute("PRAGMA wal_autocheckpoint = 0")
        cursor.close()

    @event.listens_for(engine, "begin")
    def begun(conn: Connection) -> None:
        line_of(conn).run(conn, "BEGIN IMMEDIATE" if writes else "BEGIN")

    return engine


def _use_wal(cursor: Any) -> None:
    """Turn on the write-ahead log. While another process does so in a new file, SQLite refuses it without waiting."""
    give_up = time.monotonic() + BUSY_SECONDS
    while True:
        try:
            cursor.execute("PRAGMA journal_mode = WAL")
        except sqlite3.OperationalError:
            if time.monotonic() > give_up:
                raise
            time.sleep(0.01)
        else:
            return


def _nobody(_: Topics) -> None:
    """Nobody waits for what is committed."""


# For connections that write. PostgreSQL plans each prepared statement once, not for each set of parameters. psycopg
# prepares what a connection runs more than five times, so each such statement must find its rows by an index, and in
# its order: a bitmap, which has none, looks cheap while a table is small.
_PLANS = "-c plan_cache_mode=force_generic_plan -c enable_bitmapscan=off"
_WRITES = f"-c synchronous_commit=on -c lock_timeout=0 {_PLANS}"
# One snapshot for all statements of a transaction; by default, each has its own.
_READS = "-c default_transaction_isolation=repeatable\\ read -c default_transaction_read_only=on"


def _postgresql(url: URL, *, writes: bool) -> Engine:
    limits = "-c statement_timeout=30000 -c idle_in_transaction_session_timeout=30000"
    options = f"{_WRITES if writes else _READS} {limits}"
    engine = create_engine(
        url,
        pool_size=1 if writes else READERS,
        hide_parameters=True,
        max_overflow=0,
        connect_args={"options": options, "autocommit": True},  # the line of a connection sends BEGIN and COMMIT
        execution_options={TOGETHER: True},
    )

    @event.listens_for(engine, "begin")
    def begun(conn: Connection) -> None:
        line = line_of(conn)
        line.drop()  # what is left of a transaction that was undone
        line.run(conn, BEGIN)

    @event.listens_for(engine, "before_cursor_execute")
    def executing(conn: Connection, *_: Any) -> None:
        line_of(conn).flush(conn)

    @event.listens_for(engine, "handle_error")
    def failed(context: ExceptionContext) -> None:
        if writes and getattr(context.original_exception, "sqlstate", None) == LOCKED:
            raise MustWait from context.original_exception

    @event.listens_for(engine, "commit")
    def committing(conn: Connection) -> None:
        line_of(conn).commit(conn)

    return engine
