"""Routes to lease a query, renew the lease, and release the query."""

from fastapi import APIRouter, Request, Response

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import Ctx
from waypost_server.http.hot import HotRoute
from waypost_server.http.parameters import RowPath
from waypost_server.http.problems import refusals
from waypost_server.leases import assignments, waiting
from waypost_server.leases import service as leases
from waypost_server.leases.request import LeaseRequest

router = APIRouter(prefix="/assignments", tags=["assignments"], route_class=HotRoute)

NO_LIVE_LEASE = (errors.NotFound, errors.NotYours, errors.WrongToken, errors.LeaseExpired, errors.LeaseEnded)


@router.post(
    "",
    status_code=201,
    operation_id="lease",
    responses=refusals(errors.NotFound) | {204: {"description": "There was no query within `wait` seconds."}},
    response_model=wire.Assignment,
)
async def lease(body: wire.Lease, request: Request, context: Ctx, caller: Allowed) -> wire.Assignment | Response:
    """Lease the next query; if there is none, wait for one."""
    wanted = LeaseRequest.of(body, caller.user, context.settings)
    found = await waiting.lease(context, request, wanted, body.wait)
    return found if found is not None else Response(status_code=204)


@router.post("/batch", status_code=201, operation_id="leaseBatch", responses=refusals(errors.NotFound))
async def lease_batch(body: wire.LeaseBatch, request: Request, context: Ctx, caller: Allowed) -> wire.AssignmentList:
    """Lease the next queries, for a bot that answers several at once; wait for the first. The list may be empty."""
    wanted = LeaseRequest.batch(body, caller.user, context.settings)
    return wire.AssignmentList(assignments=await waiting.lease_batch(context, request, wanted, body.count, body.wait))


@router.post("/leave", status_code=204, operation_id="leave")
async def leave(body: wire.Leave, context: Ctx, caller: Allowed) -> None:
    """Close a browser tab: release its assignments, except those in `keep`, and refuse its lease requests."""
    await context.db.write(lambda tx: leases.close_tab(tx, caller.user, body))


@router.get("", operation_id="myAssignments")
async def my_assignments(context: Ctx, caller: Allowed) -> wire.AssignmentList:
    """List the caller's live assignments, so that a reloaded tab can continue with them."""
    return await context.db.read(lambda tx: assignments.live_of(tx, caller.user))


@router.post("/{assignment}/renew", operation_id="renew", responses=refusals(*NO_LIVE_LEASE))
async def renew(assignment: RowPath, body: wire.Renew, context: Ctx, caller: Allowed) -> wire.Renewal:
    """Renew the lease: it lasts its full length from now, but not longer than the server's cap."""
    settings = context.settings
    return await context.db.write(lambda tx: leases.renew(tx, assignment, caller.user, body, settings))


@router.post("/{assignment}/release", status_code=204, operation_id="release", responses=refusals(*NO_LIVE_LEASE))
async def release(assignment: RowPath, body: wire.Release, context: Ctx, caller: Allowed) -> None:
    """Return the query to the queue without an answer. With `skip`, the caller does not get it again."""
    settings = context.settings
    await context.db.write(lambda tx: leases.release(tx, assignment, caller.user, body, settings))
