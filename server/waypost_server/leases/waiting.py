"""Waits until there is a query to lease."""

from fastapi import Request

from waypost import wire
from waypost_server.db import wakeups
from waypost_server.http.context import Context
from waypost_server.http.polling import poll
from waypost_server.leases import service as leases
from waypost_server.leases.request import LeaseRequest


async def lease_batch(
    context: Context, request: Request, wanted: LeaseRequest, count: int, wait: float
) -> list[wire.Assignment]:
    """Lease the next queries as soon as there are some; return none if there are none within `wait` seconds."""
    return await poll(
        context,
        request,
        wakeups.QUEUE,
        wait,
        lambda: context.db.write(lambda tx: leases.lease_batch(tx, wanted, count)),
        bool,
    )


async def lease(context: Context, request: Request, wanted: LeaseRequest, wait: float) -> wire.Assignment | None:
    """Lease the next query as soon as there is one; return None if there is none within `wait` seconds."""
    return await poll(
        context,
        request,
        wakeups.QUEUE,
        wait,
        lambda: context.db.write(lambda tx: leases.lease(tx, wanted)),
        lambda found: found is not None,
    )
