"""Events: what changed in a run, in the order of the commits, streamed to whoever watches."""

import asyncio
import json
from collections.abc import AsyncIterator, Mapping
from functools import partial
from typing import Any

from fastapi import Request
from sqlalchemy import func, insert, select

from waypost import wire
from waypost_server.db import wakeups
from waypost_server.db.engine import Tx
from waypost_server.db.tables import events
from waypost_server.http.context import Context

PING_SECONDS = 15.0
PAGE = 500
ANY = "events"  # what a new event of any run wakes
CHANGES_SECONDS = 1.0  # changes of all runs are told at most so often

_INSERT = insert(events)


def topic(run: str) -> str:
    """Return what a new event of a run wakes."""
    return f"events:{run}"


def add(tx: Tx, run: str, event: str, data: Mapping[str, Any]) -> None:
    """Record a change. The caller holds the run's row, so ids grow in the order of the commits."""
    row = {"run_id": run, "event": event, "data": json.dumps(data), "created_at": tx.now}
    tx.conn.execute(_INSERT, row)
    tx.wake(topic(run), ANY)


def newest(tx: Tx, run: str) -> int:
    """Return the id of a run's newest event, 0 before the first."""
    newest = select(func.coalesce(func.max(events.c.id), 0)).where(events.c.run_id == run)
    return int(tx.conn.execute(newest).scalar_one())


def newest_of_all(tx: Tx) -> int:
    """Return the id of the newest event of any run, 0 before the first."""
    return int(tx.conn.execute(select(func.coalesce(func.max(events.c.id), 0))).scalar_one())


def after(tx: Tx, run: str, cursor: int) -> list[wire.Event]:
    """Return the next events past a cursor."""
    chosen = select(events).where(events.c.run_id == run, events.c.id > cursor).order_by(events.c.id).limit(PAGE)
    return [
        wire.Event(id=row.id, run=row.run_id, event=row.event, at=row.created_at, data=json.loads(row.data))
        for row in tx.conn.execute(chosen)
    ]


async def stream(context: Context, request: Request, run: str, cursor: int) -> AsyncIterator[str]:
    """Yield server-sent events until the client leaves or the server stops."""
    clock = asyncio.get_running_loop().time
    quiet_since = clock()
    yield "retry: 1000\n\n"
    while not context.hub.closed and not await request.is_disconnected():
        changed = context.hub.watch(topic(run))
        found = await context.db.read(partial(after, run=run, cursor=cursor))
        for event in found:
            yield f"id: {event.id}\nevent: {event.event}\ndata: {event.model_dump_json()}\n\n"
            cursor = event.id
        if found:
            quiet_since = clock()
            continue
        if clock() - quiet_since >= PING_SECONDS:
            yield ": still here\n\n"
            quiet_since = clock()
        await wakeups.pause(changed, context.settings.poll_seconds)


async def changes(context: Context, request: Request) -> AsyncIterator[str]:
    """Yield that something changed in some run, until the client leaves or the server stops."""
    clock = asyncio.get_running_loop().time
    cursor: int | None = None
    said_at = clock()
    yield "retry: 1000\n\n"
    while not context.hub.closed and not await request.is_disconnected():
        changed = context.hub.watch(ANY)
        newest = await context.db.read(newest_of_all)
        if cursor is not None and newest != cursor:
            yield f"event: changed\ndata: {wire.Change(newest=newest).model_dump_json()}\n\n"
            said_at = clock()
            await asyncio.sleep(CHANGES_SECONDS)
        elif clock() - said_at >= PING_SECONDS:
            yield ": still here\n\n"
            said_at = clock()
        cursor = newest
        await wakeups.pause(changed, context.settings.poll_seconds)
