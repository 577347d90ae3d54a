"""Writers: they run transactions and acknowledge each one only after the commit that made it durable.

One thread with one connection runs all waiting transactions together, each in a savepoint, and commits once.
"""

import logging
import random
import threading
import time
from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import dataclass
from itertools import chain
from queue import Empty, SimpleQueue
from typing import Any, Protocol, TypeVar

from sqlalchemy import Connection, Engine
from sqlalchemy.exc import DBAPIError, IntegrityError, OperationalError

from waypost_server import errors
from waypost_server.db.sending import MustWait, line_of
from waypost_server.db.wakeups import Topics

log = logging.getLogger("waypost")

T = TypeVar("T")
Work = Callable[[Connection, Topics], T]

# Far more than wait in a store that keeps up. Each keeps its request in memory, and the last one waits for all others.
MOST_WAITING = 1_000
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


Outcome = tuple[Any, Exception | None]
"""What a job returned, or the error that it raised."""


@dataclass(frozen=True)
class Group:
    """Jobs that are committed together, and the attempts at it that the database has undone."""

    jobs: list[Job]
    undone: int = 0


class GroupCommit:
    """The writer of SQLite, whose file one process writes at a time.

    With `synchronous=FULL` a commit costs a disk sync. Waiting requests share the sync, so many annotators are served
    as fast as one, and an answer is still acknowledged only after the sync.
    """

    largest = 128  # the most transactions of one commit

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
            if batch := self._take(self.largest, wait=True):
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
                self._fail_all(chain(group, *groups), error, unsure)
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

    def _fail_all(self, taken: Iterable[Job], error: Exception, unsure: bool = False) -> None:
        """Fail the jobs that were taken, and all that wait in the queue."""
        _fail(taken, error, unsure)
        _fail(self._take(self._jobs.qsize(), wait=False), error)

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
        """Undo what was not committed. The next batch takes another connection.

        Closing alone would roll back, which fails if the database is gone, and would end the thread.
        """
        conn, self._conn = self._conn, None
        if conn is not None:
            if not conn.invalidated:
                conn.invalidate()
            conn.close()

    def _commit(self, conn: Connection, group: list[Job]) -> None:
        topics: Topics = set()
        if len(group) == 1:
            outcomes = [_alone(conn, group[0].work, topics)]
        else:
            outcomes = [_in_savepoint(conn, job.work, topics, "job") for job in group]
        self._finish(conn, group, outcomes, topics)

    def _finish(self, conn: Connection, group: list[Job], outcomes: list[Outcome], topics: Topics) -> None:
        """Commit, and tell those who wait."""
        try:
            conn.commit()
        except DBAPIError as error:
            raise _CommitFailed(error) from error
        # The group is on disk from here on.
        self.load.committed(len(group))
        try:
            if topics:
                self._committed(topics)
        except Exception:
            log.exception("What was committed could not be announced")
        for job, (result, refusal) in zip(group, outcomes, strict=True):
            if refusal is None:
                job.future.set_result(result)
            else:
                job.future.set_exception(refusal)


class SharedGroupCommit(GroupCommit):
    """The writer of PostgreSQL, which other servers write to at the same time.

    Two servers that held rows for one request while they wait for rows of another could wait for each other. So only
    the first job of a group waits for rows that others have locked. A later one that needs such rows is undone and
    begins the next group, once this one is committed.
    """

    largest = 32  # while a group runs, other servers may wait for its rows

    def _run(self, batch: list[Job]) -> None:
        """Commit a batch. If the database fails, run each job of the group in a transaction by itself.

        A transaction that the database has undone, or whose connection is lost before the commit, is tried again.
        """
        groups = deque([Group(batch)])
        while groups:
            group = groups.popleft()
            try:
                conn = self._begin()
            except Exception as error:
                self._fail_all(chain(group.jobs, *(later.jobs for later in groups)), error)
                return
            try:
                rest = self._commit_some(conn, group.jobs)
            except Exception as error:
                self._disconnect()
                unsure = isinstance(error, _CommitFailed) and error.cause.connection_invalidated
                if len(group.jobs) > 1 and not unsure:
                    groups.extendleft(Group([job]) for job in reversed(group.jobs))
                elif group.undone < ATTEMPTS - 1 and not unsure and _is_undone(error):
                    time.sleep(random.uniform(0, 0.01 * 2**group.undone))  # noqa: S311 - jitter
                    groups.appendleft(Group(group.jobs, group.undone + 1))
                else:
                    _fail(group.jobs, error, unsure)
            else:
                if line_of(conn).is_spoilt:
                    self._disconnect()
                if rest:
                    groups.appendleft(Group(rest))

    def _commit_some(self, conn: Connection, group: list[Job]) -> list[Job]:
        """Commit the jobs up to the first one that must wait or that spoilt the connection, and return the others."""
        if len(group) == 1:
            self._commit(conn, group)
            return []
        topics: Topics = set()
        outcomes: list[Outcome] = []
        line = line_of(conn)
        try:
            for place, job in enumerate(group):
                savepoint = f"job_{place}"
                try:
                    outcomes.append(_in_savepoint(conn, job.work, topics, savepoint))
                except MustWait:
                    if not outcomes:
                        raise
                    _undo(conn, savepoint)
                    break
                if line.is_spoilt:
                    break
                if line.may_wait:
                    line.run(conn, "SET LOCAL lock_timeout = 1")  # ms, the least that there is
                    line.may_wait = False
        finally:
            line.may_wait = True
        done = len(outcomes)
        self._finish(conn, group[:done], outcomes, topics)
        return group[done:]


def _fail(jobs: Iterable[Job], error: Exception, unsure: bool = False) -> None:
    cause = error.cause if isinstance(error, _CommitFailed) else error
    if isinstance(cause, DBAPIError) and not isinstance(cause, IntegrityError):  # which the same request has again
        cause = _storage_failed(cause, unsure)
    for job in jobs:
        job.future.set_exception(cause)


def _alone(conn: Connection, work: Work[Any], topics: Topics) -> Outcome:
    """Run the only job of a batch, which needs no savepoint: to undo it is to undo all."""
    try:
        return work(conn, topics), None
    except Exception as error:
        if _fails_all(error):
            raise
        conn.rollback()
        conn.begin()
        topics.clear()
        return None, error


def _in_savepoint(conn: Connection, work: Work[Any], topics: Topics, savepoint: str) -> Outcome:
    """Run one job. A refusal changes nothing in the store; a failing database fails the whole batch."""
    woken: Topics = set()
    line = line_of(conn)
    line.forget()
    line.run(conn, f"SAVEPOINT {savepoint}")
    try:
        result = work(conn, woken)
    except Exception as error:
        if _fails_all(error):
            raise
        _undo(conn, savepoint)
        return None, error
    line.run(conn, f"RELEASE SAVEPOINT {savepoint}")
    topics |= woken
    return result, None


def _fails_all(error: Exception) -> bool:
    """Whether an error in a job says that the database failed, not that the job is refused."""
    lost = isinstance(error, DBAPIError) and error.connection_invalidated
    return lost or isinstance(error, OperationalError | MustWait)


def _undo(conn: Connection, savepoint: str) -> None:
    """Undo a job.

    On PostgreSQL, statements wait (`sending`), so the failure of an earlier job may show in this one. Each has another
    savepoint. So this one's does not exist then, and the group fails when this is sent.
    """
    line = line_of(conn)
    line.run(conn, f"ROLLBACK TO SAVEPOINT {savepoint}")
    line.run(conn, f"RELEASE SAVEPOINT {savepoint}")


def _is_undone(error: Exception) -> bool:
    """Whether nothing is stored, and another attempt may succeed."""
    cause = error.cause if isinstance(error, _CommitFailed) else error
    return isinstance(cause, DBAPIError) and (
        cause.connection_invalidated or getattr(cause.orig, "sqlstate", None) in RETRIED
    )


class _CommitFailed(Exception):
    """A commit failed. What it was to store may be in the files nevertheless, or be committed by a lost server."""

    def __init__(self, cause: DBAPIError) -> None:
        super().__init__(str(cause))
        self.cause = cause


def _storage_failed(error: DBAPIError, unsure: bool) -> errors.StorageFailed:
    cause = str(error.orig).strip().partition("\n")[0]
    known = "It is not known whether this was stored" if unsure else "Nothing was stored"
    return errors.StorageFailed(f"{known} ({cause}); send the same request again.", retry_after=1)
