"""Secrets: how they are made, kept and looked up, and how guessing is slowed down."""

import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress

from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.users import service as users

CACHE_SECONDS = 1.0
CACHE_SIZE = 10_000
WINDOW_SECONDS = 60.0


class Credentials:
    """Looks secrets up, remembering each for a second: a revocation elsewhere holds after that."""

    def __init__(self, db: Database, clock: Callable[[], float] = time.monotonic) -> None:
        self._db = db
        self._clock = clock
        self._known: dict[tuple[str, str], tuple[float, users.Found]] = {}

    async def find(self, secret: str, kind: users.CredentialKind) -> users.Found | None:
        """Return whose secret this is, if it is good."""
        key = (kind, users.hashed(secret))
        until, found = self._known.get(key, (0.0, None))
        if found is not None and self._clock() < until:
            return found
        fresh = await self._db.read(lambda tx: users.find(tx, key[1], kind))
        if fresh is None:
            self._known.pop(key, None)
            return None
        if fresh.is_noteworthy:
            with suppress(errors.StorageFailed):  # the request may still be served
                await self._db.write(lambda tx: users.note_use(tx, fresh.credential))
        if len(self._known) >= CACHE_SIZE:
            self._known.clear()
        self._known[key] = (self._clock() + CACHE_SECONDS, fresh)
        return fresh

    def forget(self) -> None:
        """Look every secret up afresh: something was revoked."""
        self._known.clear()


class Attempts:
    """Counts wrong login codes per client; too many within a minute, and the client has to wait."""

    def __init__(self, limit: int, clock: Callable[[], float] = time.monotonic) -> None:
        self._limit = limit
        self._clock = clock
        self._failures: dict[str, deque[float]] = {}

    def refuse_if_blocked(self, client: str) -> None:
        """Refuse a client that has failed too often."""
        failures = self._recent(client)
        if len(failures) >= self._limit:
            wait = failures[0] + WINDOW_SECONDS - self._clock()
            raise errors.TooManyAttempts("Too many wrong login codes; wait a minute.", retry_after=max(wait, 1))

    def failed(self, client: str) -> None:
        """Count one wrong code."""
        if len(self._failures) >= CACHE_SIZE:
            self._failures.clear()
        self._recent(client).append(self._clock())

    def _recent(self, client: str) -> deque[float]:
        failures = self._failures.setdefault(client, deque())
        while failures and failures[0] <= self._clock() - WINDOW_SECONDS:
            failures.popleft()
        return failures
