"""Long polls: look, and look again on every change, until there is something or the time is up."""

import asyncio
from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from fastapi import Request

from server import errors, live, queue, wire
from server.context import Context
from server.database import Tx

T = TypeVar("T")

GONE_SECONDS = 0.05  # how much later than the cause of a grant it may be heard that the caller hung up


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


async def lease(context: Context, request: Request, wish: queue.Wish, wait: float) -> wire.Assignment | None:
    """Lease the next query for an annotator as soon as there is one; nothing if the time is up.

    A page that closes gives back what it holds, and that may wake its own wait for the next before anybody knows that
    the page is gone; so after a wait it is asked once more whether somebody is there.
    """
    deadline, waited = asyncio.get_running_loop().time() + wait, False
    while True:
        changed = context.hub.watch(live.QUEUE)
        found = await context.db.write(lambda tx: queue.lease(tx, wish))
        if found is not None and waited:
            await asyncio.sleep(GONE_SECONDS)
            if await request.is_disconnected():
                await _give_back(context, wish, found)
                return None
        if found is not None or not await _may_wait(context, request, changed, deadline):
            return found
        waited = True


async def _give_back(context: Context, wish: queue.Wish, found: wire.Assignment) -> None:
    given_back = wire.Release(token=found.token)
    with suppress(errors.Refusal):  # its lease ends by itself
        await context.db.write(lambda tx: queue.release(tx, found.id, wish.taker.user, given_back, context.settings))


async def _may_wait(context: Context, request: Request, changed: asyncio.Event, deadline: float) -> bool:
    """Wait for the next look; false if there should be none: time is up, nobody listens, the server stops."""
    left = deadline - asyncio.get_running_loop().time()
    if left <= 0 or context.hub.closed:
        return False
    await live.pause(changed, min(left, context.settings.poll_seconds))
    return not context.hub.closed and not await request.is_disconnected()
