"""The writer of PostgreSQL: it commits groups as well, but other servers write to the store at the same time."""

import random
import time
from collections import deque
from dataclasses import dataclass
from itertools import chain

from sqlalchemy import Connection
from sqlalchemy.exc import DBAPIError

from waypost_server.db.sending import MustWait, line_of
from waypost_server.db.wakeups import Topics
from waypost_server.db.writers.group_commit import GroupCommit
from waypost_server.db.writers.jobs import CommitFailed, Job, Outcome, fail, run_in_savepoint, undo

ATTEMPTS = 8
RETRIED = {"40001", "40P01"}  # serialization failure, deadlock


@dataclass(frozen=True)
class Group:
    """Jobs that are committed together, and the attempts at it that the database has undone."""

    jobs: list[Job]
    undone: int = 0


class SharedGroupCommit(GroupCommit):
    """A `GroupCommit` that holds up no other server for long.

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
                unsure = isinstance(error, CommitFailed) and error.cause.connection_invalidated
                if len(group.jobs) > 1 and not unsure:
                    groups.extendleft(Group([job]) for job in reversed(group.jobs))
                elif group.undone < ATTEMPTS - 1 and not unsure and _is_undone(error):
                    time.sleep(random.uniform(0, 0.01 * 2**group.undone))  # noqa: S311 - jitter
                    groups.appendleft(Group(group.jobs, group.undone + 1))
                else:
                    fail(group.jobs, error, unsure)
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
                    outcomes.append(run_in_savepoint(conn, job.work, topics, savepoint))
                except MustWait:
                    if not outcomes:
                        raise
                    undo(conn, savepoint)
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


def _is_undone(error: Exception) -> bool:
    """Whether nothing is stored, and another attempt may succeed."""
    cause = error.cause if isinstance(error, CommitFailed) else error
    return isinstance(cause, DBAPIError) and (
        cause.connection_invalidated or getattr(cause.orig, "sqlstate", None) in RETRIED
    )
