"""Long polls: read or try again after every change, until there is a result or the time is up."""

import asyncio
from collections.abc import Awaitable, Callable
from typing import TypeVar

from fastapi import Request

from waypost_server.db import wakeups
from waypost_server.http.context import Context

T = TypeVar("T")


async def poll(
    context: Context,
    request: Request,
    topic: str,
    wait: float,
    attempt: Callable[[], Awaitable[T]],
    is_done: Callable[[T], bool],
) -> T:
    """Return the first result of `attempt` that is done, or its last result after `wait` seconds.

    Polling also ends when the client disconnects or the server stops.
    """
    deadline = asyncio.get_running_loop().time() + wait
    while True:
        changed = context.hub.watch(topic)
        result = await attempt()
        if is_done(result) or not await _may_wait(context, request, changed, deadline):
            return result


async def _may_wait(context: Context, request: Request, changed: asyncio.Event, deadline: float) -> bool:
    """Wait for the next attempt; return False if there should be none."""
    left = deadline - asyncio.get_running_loop().time()
    if left <= 0 or context.hub.closed:
        return False
    await wakeups.pause(changed, min(left, context.settings.poll_seconds))
    return not context.hub.closed and not await request.is_disconnected()
