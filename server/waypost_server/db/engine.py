"""The database: one request is one unit of work, run off the event loop and acknowledged after its commit.

SQLite is written by one thread through one connection, which commits many units of work at once (`server.writer`);
PostgreSQL runs each in a transaction of its own. Time is the database's clock.
"""

import asyncio
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any, TypeVar

from sqlalchemy import Connection, Engine, Float, Table, create_engine, event, make_url
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.engine import URL
from sqlalchemy.exc import ArgumentError, DBAPIError, NoSuchModuleError
from sqlalchemy.ext.compiler import compiles
from sqlalchemy.sql import select
from sqlalchemy.sql.functions import FunctionElement

from waypost_server import errors
from waypost_server.db import schema
from waypost_server.db.writer import CommittingThreads, GroupCommit, Topics, Writer

T = TypeVar("T")

READERS = 4
WRITERS = 8  # PostgreSQL only


class clock(FunctionElement[float]):  # noqa: N801 - a SQL function
    """The database's clock: seconds since the epoch."""

    inherit_cache = True
    type = Float()


@compiles(clock, "sqlite")
def _sqlite_clock(*_: Any, **_options: Any) -> str:
    return "((julianday('now') - 2440587.5) * 86400.0)"


@compiles(clock, "postgresql")
def _postgresql_clock(*_: Any, **_options: Any) -> str:
    return "CAST(extract(epoch FROM clock_timestamp()) AS double precision)"


_NOW = select(clock())

# An INSERT that can say what to do on a conflict: each database's own, and written alike.
UPSERTS: dict[str, Callable[[Table], Any]] = {"sqlite": sqlite.insert, "postgresql": postgresql.insert}


@dataclass
class Tx:
    """One unit of work's view of the database."""

    conn: Connection
    topics: Topics = field(default_factory=set)
    _now: float | None = None

    @property
    def now(self) -> float:
        """The database's time, read once per unit of work."""
        if self._now is None:
            self._now = float(self.conn.execute(_NOW).scalar_one())
        return self._now

    @property
    def one_writer(self) -> bool:
        """Whether units of work run one after the other, so that nothing needs a lock (SQLite)."""
        return self.conn.dialect.name == "sqlite"

    def upsert(self, table: Table) -> Any:
        """Return an INSERT that can say what to do `on_conflict`."""
        return UPSERTS[self.conn.dialect.name](table)

    def wake(self, *topics: str) -> None:
        """Have whoever waits on these topics look again, once this is committed."""
        self.topics.update(topics)


class BadDatabase(Exception):
    """The database URL cannot be used; the message says why and what to do."""


class Database:
    """An open store with this version's schema."""

    def __init__(self, url: str, committed: Callable[[Topics], None] = lambda _: None) -> None:
        self.url = parse(url)
        lite = self.url.get_backend_name() == "sqlite"
        self._engine = _sqlite(self.url, writes=True) if lite else _postgresql(self.url)
        self._read_engine = _sqlite(self.url, writes=False) if lite else self._engine
        try:
            schema.upgrade(self._engine)
        except DBAPIError as error:
            self._engine.dispose()
            raise BadDatabase(f"Cannot open {self.url.render_as_string()}: {_first_line(error)}") from None
        except schema.NewerStore:
            self._engine.dispose()
            raise
        self._readers = ThreadPoolExecutor(READERS, "waypost-read")
        self._writer: Writer = (
            GroupCommit(self._engine, committed) if lite else CommittingThreads(self._engine, committed, WRITERS)
        )

    def write_now(self, work: Callable[[Tx], T]) -> T:
        """Run a unit of work and return its result once it is on disk."""
        return self._writer.submit(lambda conn, topics: work(Tx(conn, topics))).result()

    def read_now(self, work: Callable[[Tx], T]) -> T:
        """Run reads against one consistent snapshot."""
        try:
            with self._read_engine.connect() as conn:
                return work(Tx(conn))
        except DBAPIError as error:
            raise errors.StorageFailed(f"The database could not be read: {_first_line(error)}") from error

    async def write(self, work: Callable[[Tx], T]) -> T:
        """Run a unit of work off the event loop; returns once it is on disk."""
        return await asyncio.wrap_future(self._writer.submit(lambda conn, topics: work(Tx(conn, topics))))

    async def read(self, work: Callable[[Tx], T]) -> T:
        """Run reads off the event loop."""
        return await asyncio.get_running_loop().run_in_executor(self._readers, self.read_now, work)

    def close(self) -> None:
        """Finish what was submitted and close every connection."""
        self._writer.close()
        self._readers.shutdown()
        self._read_engine.dispose()
        self._engine.dispose()


def parse(text: str) -> URL:
    """Return a database URL, or say what is wrong with it.

    Raises:
        BadDatabase: with one sentence for the operator.
    """
    try:
        url = make_url(text)
        if url.drivername in {"postgres", "postgresql"}:
            url = url.set(drivername="postgresql+psycopg")
        url.get_dialect()
    except (ArgumentError, NoSuchModuleError, ImportError):
        raise BadDatabase(f"{text!r} is no database URL; use sqlite:///FILE or postgresql://USER@HOST/NAME.") from None
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
        max_overflow=0,
        connect_args={"check_same_thread": False, "timeout": 15},
    )

    @event.listens_for(engine, "connect")
    def connected(dbapi: Any, _record: Any) -> None:
        dbapi.isolation_level = None
        cursor = dbapi.cursor()
        cursor.execute("PRAGMA foreign_keys = ON")
        if writes:
            cursor.execute("PRAGMA journal_mode = WAL")
            cursor.execute("PRAGMA synchronous = FULL")
        else:
            # One connection alone checkpoints: readers neither write nor truncate the log.
            cursor.execute("PRAGMA query_only = ON")
            cursor.execute("PRAGMA wal_autocheckpoint = 0")
        cursor.close()

    @event.listens_for(engine, "begin")
    def begun(conn: Connection) -> None:
        conn.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")

    return engine


def _postgresql(url: URL) -> Engine:
    options = "-c synchronous_commit=on -c statement_timeout=30000 -c idle_in_transaction_session_timeout=30000"
    return create_engine(
        url, pool_size=WRITERS + READERS, max_overflow=0, pool_pre_ping=True, connect_args={"options": options}
    )
