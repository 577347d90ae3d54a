"""A transaction: connection, time, audit log, topics to wake, counts, traces. Every SQL statement runs in one."""

import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy import Connection, Table
from sqlalchemy.dialects import postgresql, sqlite
from sqlalchemy.sql import select

from waypost.tracing import Step
from waypost_server.db.audit import Entry
from waypost_server.db.functions import clock
from waypost_server.db.prepared import Prepared
from waypost_server.db.sending import line_of
from waypost_server.db.wakeups import Topics

_NOW = Prepared(select(clock().label("now")))

NANO = 1_000_000_000

UPSERTS: dict[str, Callable[[Table], Any]] = {"sqlite": sqlite.insert, "postgresql": postgresql.insert}
"""By dialect: an INSERT with `on_conflict_do_...`."""

Count = tuple[str, str]
"""What is counted, and which kind of it."""


class Counts:
    """What this process has committed since it started, for metrics. Threads add to it, after each commit."""

    def __init__(self) -> None:
        self._counts = Counter[Count]()
        self._lock = threading.Lock()

    def add(self, more: Mapping[Count, int]) -> None:
        """Add the counts of a transaction that was committed."""
        with self._lock:
            self._counts.update(more)

    def of(self, what: str, *kinds: str) -> list[tuple[str, int]]:
        """Return the counts of these kinds, also those that are 0."""
        with self._lock:
            return [(kind, self._counts[what, kind]) for kind in kinds]


@dataclass
class Tx:
    """One transaction of one request."""

    conn: Connection
    topics: Topics = field(default_factory=set)
    recorded: list[Entry] = field(default_factory=list)
    counted: Counter[Count] = field(default_factory=Counter)
    traced: list[Step] = field(default_factory=list)
    _began: int = field(default_factory=time.time_ns)
    _now: float | None = None

    @property
    def now(self) -> float:
        """The database's time in seconds since the epoch, read once per transaction."""
        if self._now is None:
            self._now = float(_NOW.value(self.conn, {}))
        return self._now

    def read_time_ahead(self) -> None:
        """Read the time, unless it is known, together with the next statement (`Prepared.ahead`)."""
        if self._now is None:
            _NOW.ahead(self.conn, {})

    @property
    def one_writer(self) -> bool:
        """Whether transactions run one after the other, so that rows need no locks (SQLite)."""
        return self.conn.dialect.name == "sqlite"

    @property
    def may_wait(self) -> bool:
        """Whether this may wait for rows that others have locked. If not, `sending.MustWait` puts it off."""
        return line_of(self.conn).may_wait

    @contextmanager
    def part(self) -> Iterator[None]:
        """Run a part of the transaction. If it fails, only the part is undone.

        What waited before it (`sending`) is sent first, and can fail here.
        """
        line = line_of(self.conn)
        line.run(self.conn, "SAVEPOINT part")
        line.flush(self.conn)  # what came before is not undone with the part
        recorded, counted, traced = len(self.recorded), self.counted.copy(), len(self.traced)
        try:
            yield
            line.run(self.conn, "RELEASE SAVEPOINT part")
            line.flush(self.conn)  # what fails does so in this part
        except BaseException:
            del self.recorded[recorded:]
            del self.traced[traced:]
            self.counted = counted
            if not self.conn.invalidated:
                line.drop()
                line.run(self.conn, "ROLLBACK TO SAVEPOINT part")
                line.run(self.conn, "RELEASE SAVEPOINT part")
            raise

    def upsert(self, table: Table) -> Any:
        """Return an INSERT with `on_conflict_do_update` and `on_conflict_do_nothing`."""
        return UPSERTS[self.conn.dialect.name](table)

    def wake(self, *topics: str) -> None:
        """Wake the waiters of these topics after the commit."""
        self.topics.update(topics)

    def count(self, what: str, kind: str, n: int = 1) -> None:
        """Count for metrics what this transaction does. Once it is committed, they are added to `Counts`."""
        self.counted[what, kind] += n

    def trace(
        self, name: str, run: str, episode: int, since: float | None = None, **attributes: str | int | float
    ) -> None:
        """Add what this transaction does to the trace of an episode. Once it is committed, the step ends.

        It began with the transaction, or at `since`, in seconds since the epoch.
        """
        named = {f"waypost.{attribute}": value for attribute, value in attributes.items()}
        began = self._began if since is None else int(since * NANO)
        self.traced.append(Step(name, run, episode, named, began))

    def record(self, entry: Entry) -> None:
        """Record in the audit log what this transaction does. The row is appended as its last statement."""
        self.recorded.append(entry)
