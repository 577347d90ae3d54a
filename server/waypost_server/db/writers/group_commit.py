"""The writer of SQLite: it runs all waiting transactions together, and commits once.

It acknowledges each one only after the commit that made it durable.
"""

import logging
import threading
from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from itertools import chain
from queue import Empty, SimpleQueue

from sqlalchemy import Connection, Engine
from sqlalchemy.exc import DBAPIError

from waypost_server import errors
from waypost_server.db.wakeups import Topics
from waypost_server.db.writers.jobs import CommitFailed, Job, Outcome, T, Work, fail, run_alone, run_in_savepoint
from waypost_server.db.writers.load import Load

log = logging.getLogger("waypost")


class GroupCommit:
    """One thread with one connection: all waiting transactions run together, each in a savepoint, and commit once.

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
            except (DBAPIError, CommitFailed) as error:
                self._disconnect()
                unsure = unsure or isinstance(error, CommitFailed)
                if len(group) > 1:
                    groups.extend([job] for job in group)
                else:
                    fail(group, error, unsure)
            except Exception as error:
                self._disconnect()
                fail(group, error)

    def _fail_all(self, taken: Iterable[Job], error: Exception, unsure: bool = False) -> None:
        """Fail the jobs that were taken, and all that wait in the queue."""
        fail(taken, error, unsure)
        fail(self._take(self._jobs.qsize(), wait=False), error)

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
            outcomes = [run_alone(conn, group[0].work, topics)]
        else:
            outcomes = [run_in_savepoint(conn, job.work, topics, "job") for job in group]
        self._finish(conn, group, outcomes, topics)

    def _finish(self, conn: Connection, group: list[Job], outcomes: list[Outcome], topics: Topics) -> None:
        """Commit, and tell those who wait."""
        try:
            conn.commit()
        except DBAPIError as error:
            raise CommitFailed(error) from error
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
