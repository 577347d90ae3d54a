"""The limit on wrong login codes, per client."""

import time
from collections import deque
from collections.abc import Callable
from typing import Annotated, cast

from fastapi import Depends
from starlette.requests import HTTPConnection

from waypost_server import errors

WINDOW_SECONDS = 60.0
MOST_CLIENTS = 10_000


class LoginAttempts:
    """Counts wrong login codes per client. After too many within a minute, the client must wait."""

    def __init__(self, limit: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._limit = limit
        self._clock = clock
        self._failures: dict[str, deque[float]] = {}

    def check(self, client: str) -> None:
        """Refuse a client with too many recent failures.

        Raises:
            TooManyAttempts: with the seconds to wait.
        """
        failures = self._recent(client)
        if len(failures) >= self._limit:
            wait = failures[0] + WINDOW_SECONDS - self._clock()
            raise errors.TooManyAttempts("Too many wrong login codes; wait a minute.", retry_after=max(wait, 1))

    def failed(self, client: str) -> None:
        """Count one wrong code."""
        if len(self._failures) >= MOST_CLIENTS:
            self._failures.clear()
        self._recent(client).append(self._clock())

    def _recent(self, client: str) -> deque[float]:
        failures = self._failures.setdefault(client, deque())
        while failures and failures[0] <= self._clock() - WINDOW_SECONDS:
            failures.popleft()
        return failures


async def attempts_of(connection: HTTPConnection) -> LoginAttempts:
    """Return the count of login attempts of the app that serves a request."""
    return cast(LoginAttempts, connection.app.state.attempts)


Counted = Annotated[LoginAttempts, Depends(attempts_of)]
