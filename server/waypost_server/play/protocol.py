"""Playing a demonstration: who may, and what may be said on the play socket."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

from pydantic import TypeAdapter, ValidationError
from pydantic_core import from_json

from waypost import wire
from waypost_server import errors
from waypost_server.db.engine import Tx
from waypost_server.leases import service as leases
from waypost_server.queries import checks
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs

MESSAGE_BYTES = 4 * 2**20  # the largest message: a demonstration with all its states, as in a query
MESSAGES_PER_SECOND = 60  # a held key repeats at half of that
BURST = 240

HELLO: TypeAdapter[wire.PlayHello] = TypeAdapter(wire.PlayHello)
MOVES = TypeAdapter(wire.PlayMoves)
STATES = TypeAdapter(wire.PlayStates)

M = TypeVar("M")


@dataclass(frozen=True)
class Demonstration:
    """What moves are checked against."""

    ask: wire.AskHierDemo
    names: checks.Names


def read(schema: TypeAdapter[M], text: str) -> M:
    """Return a message.

    Raises:
        Unprocessable: it is not JSON, or not such a message.
    """
    try:
        return schema.validate_python(from_json(text, allow_inf_nan=False))
    except ValidationError as error:
        fault = error.errors()[0]
        raise errors.Unprocessable(fault["loc"] or ["message"], fault["msg"]) from None
    except ValueError as error:
        raise errors.Unprocessable(["message"], f"is not JSON: {error}") from None


def taken(tx: Tx, query: int, user: int, hello: wire.PlayTake) -> Demonstration:
    """Return the demonstration that an annotator holds.

    Raises:
        NotFound, NotYours, WrongToken: the caller does not hold it.
        LeaseExpired, LeaseEnded, QueryCancelled: not any more.
        NotPlayable: it is another kind of query.
    """
    held = leases.find(tx, hello.assignment, user, hello.token)
    if held.query != query:
        raise errors.NotFound(f"Assignment {hello.assignment} is not of query {query}.")
    leases.refuse_ended(held, tx.now)
    return _demonstration(tx, queries.view(tx, query))


def offered(tx: Tx, query: int, user: int, is_admin: bool) -> None:
    """See to it that a learner may offer the environment of a query.

    Raises:
        NotFound: there is no such query.
        Forbidden: it is another learner's run.
        NotPlayable: it is not an open demonstration.
    """
    found = queries.view(tx, query)
    if runs.find(tx, found.run).user_id != user and not is_admin:
        raise errors.Forbidden(f"Query {query} is of another learner's run.")
    _demonstration(tx, found)
    if found.state in queries.CLOSED:
        raise errors.NotPlayable(f"Query {query} is {found.state}.")


def check_moves(demonstration: Demonstration, moves: wire.PlayMoves) -> None:
    """Let only such moves pass as could be an answer; and none at all, before the first.

    Raises:
        Unprocessable: a name that the run does not have, or more than the horizons allow.
    """
    if moves.segments:
        answer = wire.HierDemoAnswer(kind="hier_demo", segments=moves.segments)
        checks.check_answer(demonstration.ask, answer, demonstration.names, [])


def _demonstration(tx: Tx, query: wire.Query) -> Demonstration:
    if not isinstance(query.ask, wire.AskHierDemo):
        raise errors.NotPlayable(f"Query {query.id} is {query.ask.kind}; only demonstrations are played.")
    return Demonstration(query.ask, checks.Names.of(runs.view(tx, query.run).vocabulary))


class Pace:
    """Counts messages: a burst now and then, but no more than so many a second in the long run."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._left, self._at = float(BURST), clock()

    def count(self) -> None:
        """Count one.

        Raises:
            TooManyMessages: it is one too many.
        """
        now = self._clock()
        self._left = min(BURST, self._left + (now - self._at) * MESSAGES_PER_SECOND) - 1
        self._at = now
        if self._left < 0:
            raise errors.TooManyMessages(f"At most {MESSAGES_PER_SECOND} messages a second.")
