"""Leases the query that follows an answer. Nothing that fails here touches the answer: the receipt reports it instead.

A refusal or a status of 5xx would say that the answer was not stored, and its annotator would give it again.
"""

import logging
from dataclasses import dataclass
from typing import Any

from fastapi import Request
from sqlalchemy.exc import DBAPIError

from waypost import wire
from waypost_server import errors
from waypost_server.db.sending import MustWait, line_of
from waypost_server.db.transaction import Tx
from waypost_server.http import problems
from waypost_server.http.context import Context
from waypost_server.leases import service as leases
from waypost_server.leases import waiting
from waypost_server.leases.request import LeaseRequest

log = logging.getLogger("waypost")


@dataclass(frozen=True)
class Following:
    """The next assignment, or the problem because of which there is none. Neither means that no query is available."""

    assignment: wire.Assignment | None = None
    problem: wire.Problem | None = None

    @property
    def is_settled(self) -> bool:
        """Whether waiting for a query would change nothing."""
        return self.assignment is not None or self.problem is not None


def lease(tx: Tx, request: LeaseRequest) -> Following:
    """Lease the next query in the transaction of the answer. What fails is undone; the answer stays."""
    line_of(tx.conn).flush(tx.conn)  # what the answer itself needs must not fail as a part of the lease
    try:
        with tx.part():
            return Following(leases.lease(tx, request))
    except MustWait:
        raise  # the answer and the lease are tried again together
    except Exception as error:
        if isinstance(error, DBAPIError) and error.connection_invalidated:
            raise  # the transaction is lost, and the answer with it
        return Following(problem=_problem(error))


async def wait(context: Context, request: Request, wanted: LeaseRequest, seconds: float) -> Following:
    """Wait up to `seconds` for the next query, after the answer was committed."""
    try:
        return Following(await waiting.lease(context, request, wanted, seconds))
    except Exception as error:
        return Following(problem=_problem(error))


def _problem(error: Exception) -> wire.Problem:
    if isinstance(error, errors.Refusal) and not isinstance(error, errors.StorageFailed):
        return _of(error.status, error.name, error.title, error.detail)
    log.error("The answer is stored, but the next query could not be leased", exc_info=error)
    if isinstance(error, errors.StorageFailed | DBAPIError):
        failed = errors.StorageFailed
        return _of(failed.status, failed.name, failed.title, "the store failed; ask for it again.")
    return _of(*problems.INTERNAL, "the server failed, and its log says why; ask for it again.")


def _of(status: int, name: str, title: str, cause: str) -> wire.Problem:
    detail = f"The answer is stored, but the next query could not be leased: {cause}"
    document: dict[str, Any] = problems.document(status, name, title, detail)
    return wire.Problem.model_validate(document)
