"""Finds the owner of a secret, with a cache of one second in each server process."""

import time
from collections.abc import Callable
from contextlib import suppress
from typing import Annotated, cast

from fastapi import Depends
from starlette.requests import HTTPConnection

from waypost_server import errors
from waypost_server.auth import credentials
from waypost_server.db.engine import Database

CACHE_SECONDS = 1.0
CACHE_SIZE = 10_000


class CredentialCache:
    """Finds the owner of a secret. A revocation by another process takes effect within a second."""

    def __init__(self, db: Database, clock: Callable[[], float] = time.monotonic) -> None:
        self._db = db
        self._clock = clock
        self._cached: dict[tuple[str, str], tuple[float, credentials.Owner]] = {}

    async def find(self, secret: str, kind: credentials.CredentialKind) -> credentials.Owner | None:
        """Return the owner of a secret, or None if the secret is not valid."""
        key = (kind, credentials.hash_of(secret))
        until, owner = self._cached.get(key, (0.0, None))
        if owner is not None and self._clock() < until:
            return owner
        fresh = await self._db.read(lambda tx: credentials.find(tx, key[1], kind))
        if fresh is None:
            self._cached.pop(key, None)
            return None
        if fresh.last_use_is_stale:
            with suppress(errors.StorageFailed):  # the request itself may still succeed
                await self._db.write(lambda tx: credentials.record_use(tx, fresh.credential))
        if len(self._cached) >= CACHE_SIZE:
            self._cached.clear()
        self._cached[key] = (self._clock() + CACHE_SECONDS, fresh)
        return fresh

    def clear(self) -> None:
        """Forget every cached owner, because a credential was revoked."""
        self._cached.clear()


async def cache_of(connection: HTTPConnection) -> CredentialCache:
    """Return the credential cache of the app that serves a request."""
    return cast(CredentialCache, connection.app.state.credentials)


Cached = Annotated[CredentialCache, Depends(cache_of)]
