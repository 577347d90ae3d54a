"""Server-sent events: streams of the changes of one run, and of any run."""

import asyncio
from collections.abc import AsyncIterator
from functools import partial

from fastapi import Request

from waypost import wire
from waypost_server.db import wakeups
from waypost_server.http.context import Context
from waypost_server.http.recheck import Recheck
from waypost_server.runs import events

PING_SECONDS = 15.0
CHANGES_SECONDS = 1.0  # the shortest time between two messages of `stream_changes`


async def stream_run(
    context: Context, request: Request, admission: Recheck, run: str, cursor: int, *, with_data: bool
) -> AsyncIterator[str]:
    """Yield the events of a run after a cursor, until the client disconnects or is no longer admitted."""
    clock = asyncio.get_running_loop().time
    quiet_since = clock()
    yield "retry: 1000\n\n"
    while await _goes_on(context, request, admission):
        changed = context.hub.watch(events.topic(run))
        found = await context.db.read(partial(events.after, run=run, cursor=cursor))
        for event in found:
            shown = event if with_data else event.model_copy(update={"data": {}})
            yield f"id: {event.id}\nevent: {event.event}\ndata: {shown.model_dump_json()}\n\n"
            cursor = event.id
        if found:
            quiet_since = clock()
            continue
        if clock() - quiet_since >= PING_SECONDS:
            yield ": still here\n\n"
            quiet_since = clock()
        await wakeups.pause(changed, min(context.settings.poll_seconds, admission.seconds_left))


async def stream_changes(context: Context, request: Request, admission: Recheck) -> AsyncIterator[str]:
    """Yield a message whenever any run has changed, until the client disconnects or is no longer admitted."""
    clock = asyncio.get_running_loop().time
    cursor: events.Newest | None = None
    said_at = clock()
    yield "retry: 1000\n\n"
    while await _goes_on(context, request, admission):
        changed = context.hub.watch(events.ANY)
        newest = await context.db.read(events.newest_of_all)
        seen = newest.since(cursor or newest)
        if cursor is not None and seen != cursor:
            yield f"event: changed\ndata: {wire.Change(newest=newest.id).model_dump_json()}\n\n"
            said_at = clock()
            await asyncio.sleep(CHANGES_SECONDS)
        elif clock() - said_at >= PING_SECONDS:
            yield ": still here\n\n"
            said_at = clock()
        cursor = seen
        await wakeups.pause(changed, min(context.settings.poll_seconds, admission.seconds_left))


async def _goes_on(context: Context, request: Request, admission: Recheck) -> bool:
    return not context.hub.closed and not await request.is_disconnected() and await admission.holds()
