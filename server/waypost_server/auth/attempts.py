"""The limit on wrong login codes, per client address.

A valid code always works, however many wrong ones came from its address: many people may share one, and a code has 256
random bits, so nobody guesses one. The limit keeps wrong codes from costing more than a look-up.
"""

import time
from collections import deque
from collections.abc import Callable
from ipaddress import IPv6Network, ip_address
from typing import Annotated, cast

from fastapi import Depends
from starlette.requests import HTTPConnection

from waypost_server import errors

WINDOW_SECONDS = 60.0
MOST_CLIENTS = 10_000
OWN_BITS = 64  # of an IPv6 address: one visitor has all addresses that begin with them


class LoginAttempts:
    """Counts wrong login codes per client. After too many within a minute, the client must wait."""

    def __init__(self, limit: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._limit = limit
        self._clock = clock
        self._failures: dict[str, deque[float]] = {}  # the client that was added first comes first

    def failed(self, address: str | None) -> None:
        """Count one wrong code.

        Raises:
            TooManyAttempts: too many came from this client, with the seconds to wait. This one is not counted.
        """
        failures = self._recent(_client(address))
        if len(failures) >= self._limit:
            wait = failures[0] + WINDOW_SECONDS - self._clock()
            raise errors.TooManyAttempts("Too many wrong login codes; wait a minute.", retry_after=max(wait, 1))
        failures.append(self._clock())

    def _recent(self, client: str) -> deque[float]:
        if client not in self._failures and len(self._failures) >= MOST_CLIENTS:
            del self._failures[next(iter(self._failures))]
        failures = self._failures.setdefault(client, deque())
        while failures and failures[0] <= self._clock() - WINDOW_SECONDS:
            failures.popleft()
        return failures


def _client(address: str | None) -> str:
    """Return who has an address: of IPv6, everybody has a whole network."""
    try:
        found = ip_address(address or "")
    except ValueError:
        return address or ""
    if found.version == 4:
        return str(found)
    if found.ipv4_mapped is not None:
        return str(found.ipv4_mapped)
    return str(IPv6Network((int(found), OWN_BITS), strict=False))


async def attempts_of(connection: HTTPConnection) -> LoginAttempts:
    """Return the count of login attempts of the app that serves a request."""
    return cast(LoginAttempts, connection.app.state.attempts)


Counted = Annotated[LoginAttempts, Depends(attempts_of)]
