"""Writers: they run transactions and acknowledge each one only after the commit that made it durable."""

import random
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from itertools import chain
from queue import Empty, SimpleQueue
from typing import Any, Protocol, TypeVar

from sqlalchemy import Connection, Engine
from sqlalchemy.exc import DBAPIError, OperationalError

from waypost_server import errors
from waypost_server.db.sending import line_of
from waypost_server.db.wakeups import Topics

T = TypeVar("T")
Work = Callable[[Connection, Topics], T]

# Far more than wait in a store that keeps up. Each keeps its request in memory, and the last one waits for all others.
MOST_WAITING = 1_000
LARGEST_BATCH = 128
ATTEMPTS = 8
RETRIED = {"40001", "40P01"}  # PostgreSQL: serialization failure, deadlock


class Writer(Protocol):
    """Runs transactions, each all or nothing."""

    load: "Load"

    def submit(self, work: Work[T]) -> Future[T]:
        """Queue a transaction; the future resolves after its commit.

        Raises:
            StorageFailed, StoreBusy: the transaction was not queued.
        """
        ...

    def close(self) -> None:
        """Finish submitted transactions, then stop."""
        ...


class Load:
    """How much a writer has to do: the places of transactions that wait or run, and the commits so far.

    With all places taken, the next transaction is refused.
    """

    def __init__(self) -> None:
        self.waiting = 0
        self.commits = 0
        self.transactions = 0
        self.largest = 0  # the most transactions that one commit had
        self._lock = threading.Lock()

    def take(self) -> None:
        """Take a place.

        Raises:
            StoreBusy: there is none.
        """
        with self._lock:
            if self.waiting >= MOST_WAITING:
                raise errors.StoreBusy(
                    "Too many requests wait to be stored, so nothing was stored; send the same request again.",
                    retry_after=1,
                )
            self.waiting += 1

    def leave(self, _future: Future[Any]) -> None:
        """Free the place of a transaction that is done."""
        with self._lock:
            self.waiting -= 1

    def committed(self, n: int) -> None:
        """Count a commit of so many transactions."""
        with self._lock:
            self.commits += 1
            self.transactions += n
            self.largest = max(self.largest, n)


@dataclass(frozen=True)
class Job:
    """A transaction and the future that its caller waits for."""

    work: Work[Any]
    future: Future[Any]


class GroupCommit:
    """One thread with one connection: all waiting transactions run together, each in a savepoint, and commit once.

    With `synchronous=FULL` a commit costs a disk sync. Waiting requests share the sync, so many annotators are served
    as fast as one, and an answer is still acknowledged only after the sync.
    """

    def __init__(self, engine: Engine, committed: Callable[[Topics], None]) -> None:
        self._engine = engine
        self._committed = committed
        self.load = Load()
        self._jobs: SimpleQueue[Job | None] = SimpleQueue()
        self._closing = False
        self._conn: Connection | None = None
        self._thread = threading.Thread(target=self._loop, name="waypost-write", daemon=True)
        self._thread.start()

    def submit(self, work: Work[T]) -> Future[T]:
        """Queue a transaction; the future resolves after its commit.

        Raises:
            StorageFailed: the thread has stopped, so the future would never resolve.
            StoreBusy: too many transactions wait.
        """
        if not self._thread.is_alive():
            raise errors.StorageFailed("The server's writer has stopped, so nothing can be stored: restart the server.")
        self.load.take()
        future: Future[T] = Future()
        future.add_done_callback(self.load.leave)
        self._jobs.put(Job(work, future))
        return future

    def close(self) -> None:
        """Finish submitted transactions, then stop."""
        self._jobs.put(None)
        self._thread.join()

    def _loop(self) -> None:
        while not self._closing:
            if batch := self._take(LARGEST_BATCH, wait=True):
                self._run(batch)
        self._disconnect()

    def _take(self, most: int, *, wait: bool) -> list[Job]:
        """Take the next jobs out of the queue. With `wait`, wait until there is one."""
        taken: list[Job] = []
        for place in range(most):
            try:
                job = self._jobs.get(block=wait and place == 0)
            except Empty:
                break
            if job is None:
                self._closing = True
                break
            # From here on, a caller can no longer cancel its future, so every outcome can be delivered.
            if job.future.set_running_or_notify_cancel():
                taken.append(job)
        return taken

    def _run(self, batch: list[Job]) -> None:
        """Commit a batch. If the database fails, run each job of the batch in a transaction by itself.

        A transaction that cannot begin has waited for another process (`BUSY_SECONDS`). Then all jobs fail, also those
        in the queue. Otherwise the wait would start anew for each of them.
        """
        groups = deque([batch])
        unsure = False  # whether the batch may be in the files although its commit failed
        while groups:
            group = groups.popleft()
            try:
                conn = self._begin()
            except Exception as error:
                _fail(chain(group, *groups), error, unsure)
                _fail(self._take(self._jobs.qsize(), wait=False), error)
                return
            try:
                self._commit(conn, group)
            except (DBAPIError, _CommitFailed) as error:
                self._disconnect()
                unsure = unsure or isinstance(error, _CommitFailed)
                if len(group) > 1:
                    groups.extend([job] for job in group)
                else:
                    _fail(group, error, unsure)
            except Exception as error:
                self._disconnect()
                _fail(group, error)

    def _begin(self) -> Connection:
        try:
            if self._conn is None:
                self._conn = self._engine.connect()
            self._conn.begin()
        except BaseException:
            self._disconnect()
            raise
        return self._conn

    def _disconnect(self) -> None:
        """Undo what was not committed. The next batch takes a connection from the pool again."""
        if self._conn is not None:
            self._conn.close()
            self._conn = None

    def _commit(self, conn: Connection, group: list[Job]) -> None:
        topics: Topics = set()
        if len(group) == 1:
            outcomes = [_alone(conn, group[0].work, topics)]
        else:
            outcomes = [_in_savepoint(conn, job.work, topics) for job in group]
        try:
            conn.commit()
        except DBAPIError as error:
            raise _CommitFailed(error) from error
        # The group is on disk from here on.
        self.load.committed(len(group))
        if topics:
            self._committed(topics)
        for job, (result, refusal) in zip(group, outcomes, strict=True):
            if refusal is None:
                job.future.set_result(result)
            else:
                job.future.set_exception(refusal)


def _fail(jobs: Iterable[Job], error: Exception, unsure: bool = False) -> None:
    cause = error.cause if isinstance(error, _CommitFailed) else error
    for job in jobs:
        job.future.set_exception(_storage_failed(cause, unsure) if isinstance(cause, DBAPIError) else cause)


def _alone(conn: Connection, work: Work[Any], topics: Topics) -> tuple[Any, Exception | None]:
    """Run the only job of a batch, which needs no savepoint: to undo it is to undo all."""
    try:
        return work(conn, topics), None
    except OperationalError:
        raise
    except Exception as error:
        conn.rollback()
        conn.begin()
        topics.clear()
        return None, error


def _in_savepoint(conn: Connection, work: Work[Any], topics: Topics) -> tuple[Any, Exception | None]:
    """Run one job. A refusal changes nothing in the store; a failing database fails the whole batch."""
    woken: Topics = set()
    line = line_of(conn)
    line.run(conn, "SAVEPOINT job")
    try:
        result = work(conn, woken)
    except OperationalError:
        raise
    except Exception as error:
        line.run(conn, "ROLLBACK TO SAVEPOINT job")
        line.run(conn, "RELEASE SAVEPOINT job")
        return None, error
    line.run(conn, "RELEASE SAVEPOINT job")
    topics |= woken
    return result, None


class CommittingThreads:
    """A few threads: each job is a transaction by itself. It is run again if the database undid it."""

    def __init__(self, engine: Engine, committed: Callable[[Topics], None], threads: int) -> None:
        self._engine = engine
        self._committed = committed
        self.load = Load()
        self._pool = ThreadPoolExecutor(threads, "waypost-write")

    def submit(self, work: Work[T]) -> Future[T]:
        """Queue a transaction; the future resolves after its commit.

        Raises:
            StoreBusy: too many transactions wait.
        """
        self.load.take()
        future = self._pool.submit(self._run, work)
        future.add_done_callback(self.load.leave)
        return future

    def close(self) -> None:
        """Finish submitted transactions, then stop."""
        self._pool.shutdown()

    def _run(self, work: Work[T]) -> T:
        for attempt in range(ATTEMPTS):
            topics: Topics = set()
            committing = False
            try:
                with self._engine.begin() as conn:
                    result = work(conn, topics)
                    committing = True
            except OperationalError as error:
                lost = error.connection_invalidated and not committing
                undone = lost or getattr(error.orig, "sqlstate", None) in RETRIED
                if not undone or attempt == ATTEMPTS - 1:
                    raise _storage_failed(error, unsure=committing and not undone) from error
                time.sleep(random.uniform(0, 0.01 * 2**attempt))  # noqa: S311 - jitter
                continue
            self.load.committed(1)
            if topics:
                self._committed(topics)
            return result
        raise AssertionError("unreachable")


class _CommitFailed(Exception):
    """A commit failed. What it was to store may be in the files nevertheless, or be committed by a lost server."""

    def __init__(self, cause: DBAPIError) -> None:
        super().__init__(str(cause))
        self.cause = cause


def _storage_failed(error: DBAPIError, unsure: bool) -> errors.StorageFailed:
    cause = str(error.orig).strip().partition("\n")[0]
    known = "It is not known whether this was stored" if unsure else "Nothing was stored"
    return errors.StorageFailed(f"{known} ({cause}); send the same request again.", retry_after=1)
