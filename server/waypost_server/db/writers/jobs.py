"""One transaction of a group: run in a savepoint or alone, undone, or failed."""

from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeVar

from sqlalchemy import Connection
from sqlalchemy.exc import DBAPIError, IntegrityError, OperationalError

from waypost_server import errors
from waypost_server.db.sending import MustWait, line_of
from waypost_server.db.wakeups import Topics

T = TypeVar("T")
Work = Callable[[Connection, Topics], T]


@dataclass(frozen=True)
class Job:
    """A transaction and the future that its caller waits for."""

    work: Work[Any]
    future: Future[Any]


Outcome = tuple[Any, Exception | None]
"""What a job returned, or the error that it raised."""


def run_alone(conn: Connection, work: Work[Any], topics: Topics) -> Outcome:
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


def run_in_savepoint(conn: Connection, work: Work[Any], topics: Topics, savepoint: str) -> Outcome:
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
        undo(conn, savepoint)
        return None, error
    line.run(conn, f"RELEASE SAVEPOINT {savepoint}")
    topics |= woken
    return result, None


def _fails_all(error: Exception) -> bool:
    """Whether an error in a job says that the database failed, not that the job is refused."""
    lost = isinstance(error, DBAPIError) and error.connection_invalidated
    return lost or isinstance(error, OperationalError | MustWait)


def undo(conn: Connection, savepoint: str) -> None:
    """Undo a job.

    On PostgreSQL, statements wait (`sending`), so the failure of an earlier job may show in this one. Each has another
    savepoint. So this one's does not exist then, and the group fails when this is sent.
    """
    line = line_of(conn)
    line.run(conn, f"ROLLBACK TO SAVEPOINT {savepoint}")
    line.run(conn, f"RELEASE SAVEPOINT {savepoint}")


class CommitFailed(Exception):
    """A commit failed. What it was to store may be in the files nevertheless, or be committed by a lost server."""

    def __init__(self, cause: DBAPIError) -> None:
        super().__init__(str(cause))
        self.cause = cause


def fail(jobs: Iterable[Job], error: Exception, unsure: bool = False) -> None:
    """Tell those who wait for these jobs why nothing was stored, or that nobody knows whether it was."""
    cause = error.cause if isinstance(error, CommitFailed) else error
    if isinstance(cause, DBAPIError) and not isinstance(cause, IntegrityError):  # to send it again would not help
        cause = _storage_failed(cause, unsure)
    for job in jobs:
        job.future.set_exception(cause)


def _storage_failed(error: DBAPIError, unsure: bool) -> errors.StorageFailed:
    cause = str(error.orig).strip().partition("\n")[0]
    known = "It is not known whether this was stored" if unsure else "Nothing was stored"
    return errors.StorageFailed(f"{known} ({cause}); send the same request again.", retry_after=1)
