"""Records refusals in the audit log, so few that nobody can fill the disk by being refused again and again.

An actor is a user, or all who have no valid credential. In one minute, an actor gets one row for each action, operation
and address, and `MOST_ROWS` in all. Refusals beyond that are counted, and one more row holds their numbers. Each server
process counts for itself, in memory: a process that is killed loses the counts of the last minute, but no row.
"""

import asyncio
import logging
import time
from collections import Counter
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any, cast

from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse
from sqlalchemy import select
from sqlalchemy.exc import DBAPIError
from starlette.requests import HTTPConnection

from waypost.wire import AuditAction
from waypost_server import errors
from waypost_server.auth import credentials
from waypost_server.auth.permissions import address_of
from waypost_server.db.audit import Actor, Details, Entry, nobody
from waypost_server.db.engine import Database
from waypost_server.db.tables import runs
from waypost_server.db.transaction import Tx
from waypost_server.http import problems
from waypost_server.http.background import going_on

WINDOW_SECONDS = 60.0
MOST_ROWS = 20  # of one actor in one window
SWEEP_SECONDS = 5.0  # the interval at which counts of windows that are over are written

log = logging.getLogger("waypost")

Rejected = tuple[credentials.CredentialKind, str]
"""A secret that was not valid: its kind, and its hash."""


@dataclass(frozen=True)
class Refused:
    """A refusal, as its row of the audit log needs it.

    Args:
        actor: who was refused.
        action: what was refused: to be admitted at all, or an operation.
        operation: the operation of the API, as OpenAPI names it.
        entry: returns the row, in the transaction that appends it.
    """

    actor: Actor
    action: AuditAction
    operation: str
    entry: Callable[[Tx], Entry]


@dataclass
class Window:
    """The refusals of one actor in one minute: which ones have a row, and how many others there were."""

    actor: Actor
    until: float
    recorded: set[tuple[str, str, str | None]] = field(default_factory=set)
    left_out: dict[AuditAction, Counter[str]] = field(default_factory=dict)

    def admits(self, one: Refused) -> bool:
        """Return whether a refusal gets a row."""
        key = (one.action, one.operation, one.actor.address)
        if key in self.recorded or len(self.recorded) >= MOST_ROWS:
            return False
        self.recorded.add(key)
        return True

    def leave_out(self, one: Refused) -> None:
        """Count a refusal without a row."""
        self.left_out.setdefault(one.action, Counter())[one.operation] += 1

    def add(self, other: "Window") -> None:
        """Add what another window counted."""
        for action, numbers in other.left_out.items():
            self.left_out.setdefault(action, Counter()).update(numbers)

    def entries(self) -> list[Entry]:
        """Return the rows that hold the counts, by operation: at most one for each action."""
        everywhere = Actor(self.actor.name, self.actor.user)  # they came from several addresses
        return [Entry(everywhere, action, None, {"left_out": dict(n)}) for action, n in self.left_out.items()]


class Refusals:
    """Records refusals, at most `MOST_ROWS` of each actor in a minute. It is used on one event loop."""

    def __init__(self, db: Database, clock: Callable[[], float] = time.monotonic) -> None:
        self._db = db
        self._clock = clock
        self._windows: dict[int | None, Window] = {}

    async def record(self, one: Refused) -> None:
        """Record a refusal, or count it. If the store fails, the refusal is counted and stays a refusal."""
        window = self._windows.get(one.actor.user)
        if window is None or window.until <= self._clock():
            counts = {} if window is None else window.left_out
            window = Window(one.actor, self._clock() + WINDOW_SECONDS, left_out=counts)
            self._windows[one.actor.user] = window
        if not window.admits(one) or not await self._write(lambda tx: tx.record(one.entry(tx))):
            window.leave_out(one)

    async def sweep(self, *, everything: bool = False) -> None:
        """Write the counts of windows that are over, and forget them; with `everything`, those of all windows."""
        for user, window in list(self._windows.items()):
            if not everything and window.until > self._clock():
                continue
            del self._windows[user]
            entries = window.entries()
            if entries and not await self._write(_all(entries)):
                newest = self._windows.setdefault(user, window)  # it is tried again
                if newest is not window:
                    newest.add(window)

    @asynccontextmanager
    async def sweeping(self) -> AsyncIterator[None]:
        """Sweep for as long as the context lasts, and write all counts at its end."""
        try:
            async with going_on(self._sweep_forever()):
                yield
        finally:
            await self.sweep(everything=True)

    async def _sweep_forever(self) -> None:
        while True:
            await asyncio.sleep(SWEEP_SECONDS)
            await self.sweep()

    async def _write(self, work: Callable[[Tx], None]) -> bool:
        """Run a transaction; return whether it succeeded."""
        try:
            await self._db.write(work)
        except (errors.StorageFailed, DBAPIError) as error:
            log.warning("A refusal could not be recorded in the audit log: %s", error)
            return False
        return True


def _all(entries: list[Entry]) -> Callable[[Tx], None]:
    def work(tx: Tx) -> None:
        for entry in entries:
            tx.record(entry)

    return work


def install(app: FastAPI) -> None:
    """Make the app record the refusals of credentials and permissions before it answers them."""

    @app.exception_handler(errors.Unauthenticated)
    @app.exception_handler(errors.Forbidden)
    async def refused(request: Request, error: errors.Refusal) -> JSONResponse:
        await record(request, request.scope["route"].operation_id, error.status, error.name)
        return problems.render(error, request.url.path)


async def record(connection: HTTPConnection, operation: str, status: int, reason: str) -> None:
    """Record why a request or a message of a socket was refused, if the reason is a credential or a permission.

    Args:
        connection: the request or the socket.
        operation: what was refused.
        status: the status of the problem document.
        reason: the last part of its type.
    """
    one = _refused(connection, operation, status, reason)
    if one is not None:
        await cast(Refusals, connection.app.state.refusals).record(one)


def _refused(connection: HTTPConnection, operation: str, status: int, reason: str) -> Refused | None:
    rejected: Rejected | None = getattr(connection.state, "rejected", None)
    caller: Any = getattr(connection.state, "caller", None)
    stranger = nobody(address_of(connection))
    sign_in: Details | None = getattr(connection.state, "sign_in", None)
    if status == errors.Unauthenticated.status and sign_in is not None:
        tried = {"operation": operation, "by": "provider", "reason": reason, **sign_in}
        return Refused(stranger, "login.refused", operation, lambda _: Entry(stranger, "login.refused", None, tried))
    if status == errors.Unauthenticated.status and rejected is not None:
        return Refused(stranger, "login.refused", operation, lambda tx: _login(tx, stranger, operation, *rejected))
    if status != errors.Forbidden.status:
        return None  # without a credential, nobody was refused: a browser asks so who it is
    actor = stranger if caller is None else caller.actor
    path, details = connection.path_params, {"operation": operation, "reason": reason}
    return Refused(
        actor,
        "permission.refused",
        operation,
        lambda tx: Entry(actor, "permission.refused", _object(tx, path), details),
    )


_SECRETS = {"api": "token", "session": "session", "login": "link"}


def _login(tx: Tx, actor: Actor, operation: str, kind: credentials.CredentialKind, secret_hash: str) -> Entry:
    """Return the row for a secret that was not valid. It names the secret by its id, if it is known."""
    found = credentials.why_rejected(tx, secret_hash, kind)
    details: dict[str, Any] = {"operation": operation, "by": _SECRETS[kind]}
    if found is None:
        return Entry(actor, "login.refused", None, details | {"reason": "unknown"})
    details |= {"reason": found.reason, _SECRETS[kind]: found.credential, "name": found.name}
    return Entry(actor, "login.refused", f"user/{found.user}", details)


def _object(tx: Tx, path: Details) -> str | None:
    """Return the object that the path names. A run must exist: anything else that was sent is not repeated."""
    for kind in ("user", "token", "assignment", "query"):
        sent = str(path.get(kind, ""))
        if sent.isascii() and sent.isdigit() and len(sent) < 20:
            return f"{kind}/{int(sent)}"
    run = tx.conn.execute(select(runs.c.id).where(runs.c.id == str(path.get("run", "")))).scalar_one_or_none()
    return None if run is None else f"run/{run}"
