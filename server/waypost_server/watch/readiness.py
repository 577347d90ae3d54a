"""Readiness: whether this server can store an answer now, found out by a real write, and is not about to stop."""

import asyncio
import time
from collections.abc import Callable
from typing import Annotated, cast

from fastapi import Depends
from sqlalchemy import select, text
from starlette.requests import HTTPConnection

from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.tables import runs
from waypost_server.db.transaction import Tx

SECONDS = 3.0  # a write that takes longer has failed; the container's check waits 4 seconds
KEPT_SECONDS = 1.0  # anybody may ask without a login, so one write serves all requests of this time

_READ = select(runs.c.id).limit(1)
_WRITE = text("UPDATE alembic_version SET version_num = version_num")


class Readiness:
    """Checks that the store can be read and written, at most once in `KEPT_SECONDS`."""

    def __init__(self, db: Database, clock: Callable[[], float] = time.monotonic) -> None:
        self._db = db
        self._clock = clock
        self._lock = asyncio.Lock()
        self._until = float("-inf")
        self._failure: errors.StorageFailed | None = None
        self._is_stopping = False

    def stop(self) -> None:
        """Say from now on that this server is not ready, because it is about to stop."""
        self._is_stopping = True

    async def check(self) -> None:
        """Return if this server can store an answer.

        Raises:
            Stopping: the server is about to stop.
            StorageFailed: with the cause.
        """
        if self._is_stopping:
            raise errors.Stopping("This server is about to stop; send requests to another one.", retry_after=1)
        async with self._lock:
            if self._clock() >= self._until:
                self._failure = await self._try()
                self._until = self._clock() + KEPT_SECONDS
            if self._failure is not None:
                raise self._failure

    async def _try(self) -> errors.StorageFailed | None:
        try:
            async with asyncio.timeout(SECONDS):
                await self._db.read(_read)
                await self._db.write(_write)
        except errors.StorageFailed as failure:
            return failure
        except TimeoutError:
            return errors.StorageFailed(f"The store did not accept a write within {SECONDS:g} seconds.", retry_after=1)
        return None


def _read(tx: Tx) -> None:
    tx.conn.execute(_READ).all()


def _write(tx: Tx) -> None:
    tx.conn.execute(_WRITE)


async def readiness_of(connection: HTTPConnection) -> Readiness:
    """Return the readiness check of the app that serves a request."""
    return cast(Readiness, connection.app.state.readiness)


Ready = Annotated[Readiness, Depends(readiness_of)]
