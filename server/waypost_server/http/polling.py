"""Long polls: look, and look again on every change, until there is something or the time is up."""

import asyncio
from collections.abc import Callable
from typing import TypeVar

from fastapi import Request

from waypost import wire
from waypost_server.db import wakeups
from waypost_server.db.engine import Tx
from waypost_server.http.context import Context
from waypost_server.leases import service as leases

T = TypeVar("T")


async def until(
    context: Context, request: Request, topic: str, wait: float, look: Callable[[Tx], T], done: Callable[[T], bool]
) -> T:
    """Return what `look` sees as soon as it is done, or as it stands when the time is up."""
    deadline = asyncio.get_running_loop().time() + wait
    while True:
        changed = context.hub.watch(topic)
        found = await context.db.read(look)
        if done(found) or not await _may_wait(context, request, changed, deadline):
            return found


async def lease(context: Context, request: Request, wish: leases.Wish, wait: float) -> wire.Assignment | None:
    """Lease the next query for an annotator as soon as there is one; nothing if the time is up."""
    deadline = asyncio.get_running_loop().time() + wait
    while True:
        changed = context.hub.watch(wakeups.QUEUE)
        found = await context.db.write(lambda tx: leases.lease(tx, wish))
        if found is not None or not await _may_wait(context, request, changed, deadline):
            return found


async def _may_wait(context: Context, request: Request, changed: asyncio.Event, deadline: float) -> bool:
    """Wait for the next look; false if there should be none: time is up, nobody listens, the server stops."""
    left = deadline - asyncio.get_running_loop().time()
    if left <= 0 or context.hub.closed:
        return False
    await wakeups.pause(changed, min(left, context.settings.poll_seconds))
    return not context.hub.closed and not await request.is_disconnected()
