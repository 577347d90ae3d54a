"""The protocol of the play socket: who may play or offer a demonstration, and which messages are accepted."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError
from pydantic_core import from_json

from waypost import wire
from waypost_server import errors
from waypost_server.auth.access import check_owner
from waypost_server.db.transaction import Tx
from waypost_server.leases.assignments import check_live, find
from waypost_server.queries import checks
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs

MESSAGE_BYTES = 4 * 2**20  # the largest message: a demonstration with all its states, as in a query
MESSAGES_PER_SECOND = 60  # a key that is held down repeats about 30 times a second
BURST = 240

HELLO: TypeAdapter[wire.PlayHello] = TypeAdapter(wire.PlayHello)
MOVES = TypeAdapter(wire.PlayMoves)
STATES = TypeAdapter(wire.PlayStates)

M = TypeVar("M")


@dataclass(frozen=True)
class Demonstration:
    """The query and the names that moves are checked against."""

    ask: wire.AskHierDemo
    names: checks.Names


def read(schema: TypeAdapter[M], text: str) -> M:
    """Return a parsed message.

    Raises:
        Unprocessable: the text is not JSON, or not a message of this kind.
    """
    try:
        return schema.validate_python(from_json(text, allow_inf_nan=False))
    except ValidationError as error:
        fault = error.errors()[0]
        raise errors.Unprocessable(fault["loc"] or ["message"], fault["msg"]) from None
    except ValueError as error:
        raise errors.Unprocessable(["message"], f"is not JSON: {error}") from None


def check_taken(tx: Tx, query: int, user: int, hello: wire.PlayTake) -> Demonstration:
    """Return the demonstration that an annotator has leased.

    Raises:
        NotFound, NotYours, WrongToken: the caller does not have this assignment.
        LeaseExpired, LeaseEnded, QueryCancelled: the lease is over.
        NotPlayable: the query is of another kind.
    """
    assignment = find(tx, hello.assignment, user, hello.token)
    if assignment.query != query:
        raise errors.NotFound(f"Assignment {hello.assignment} belongs to another query than {query}.")
    check_live(assignment, tx.now)
    return _demonstration(tx, queries.view(tx, query))


def check_offer(tx: Tx, query: int, user: int, role: wire.Role) -> None:
    """Refuse a learner who may not offer the environment of a query.

    Raises:
        NotFound: there is no such query.
        Forbidden: the run belongs to another learner.
        NotPlayable: the query is not an open demonstration.
    """
    found = queries.view(tx, query)
    check_owner(tx, found.run, runs.find(tx, found.run).user_id, user, role)
    _demonstration(tx, found)
    if found.state in queries.CLOSED:
        raise errors.NotPlayable(f"Query {query} is {found.state}.")


def check_moves(demonstration: Demonstration, moves: wire.PlayMoves) -> None:
    """Refuse moves that could not be an answer. No moves at all are accepted too.

    Raises:
        Unprocessable: a name that the run does not have, or more moves than the horizons allow.
    """
    if moves.segments:
        answer = wire.HierDemoAnswer(kind="hier_demo", segments=moves.segments)
        checks.check_answer(checks.Outline.of(demonstration.ask), answer, demonstration.names, [])


def _demonstration(tx: Tx, query: wire.Query) -> Demonstration:
    if not isinstance(query.ask, wire.AskHierDemo):
        raise errors.NotPlayable(f"Query {query.id} is {query.ask.kind}; only demonstrations are played.")
    return Demonstration(query.ask, checks.Names.of(runs.view(tx, query.run).vocabulary))


class RateLimit:
    """Limits messages to `MESSAGES_PER_SECOND` in the long run, with bursts of up to `BURST`."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._left, self._at = float(BURST), clock()

    def count(self) -> None:
        """Count one message.

        Raises:
            TooManyMessages: the limit is exceeded.
        """
        now = self._clock()
        self._left = min(BURST, self._left + (now - self._at) * MESSAGES_PER_SECOND) - 1
        self._at = now
        if self._left < 0:
            raise errors.TooManyMessages(f"Send at most {MESSAGES_PER_SECOND} messages per second.")
