"""Routes of server-sent events: the events of one run, and a message whenever any run has changed."""

from typing import Annotated

from fastapi import APIRouter, Header, Query, Request
from fastapi.responses import StreamingResponse

from waypost import wire
from waypost_server import errors
from waypost_server.auth.lookup import Cached, CredentialCache
from waypost_server.auth.permissions import Allowed, Caller, readmit
from waypost_server.auth.roles import WATCHERS
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.http.recheck import Recheck
from waypost_server.runs import events
from waypost_server.runs import service as runs
from waypost_server.watch import sse

router = APIRouter(route_class=JsonRoute)


@router.get(
    "/runs/{run}/events",
    tags=["runs"],
    operation_id="streamEvents",
    response_class=StreamingResponse,
    responses=refusals(errors.NotFound)
    | {
        200: {
            "model": wire.Event,
            "description": "Server-sent events; each `data` is an Event.",
            "content": {"text/event-stream": {}},
        }
    },
)
async def stream_events(
    run: str,
    request: Request,
    context: Ctx,
    cache: Cached,
    caller: Allowed,
    after: Annotated[
        int | None, Query(ge=0, le=2**63 - 1, description="Only events after this id; without it, only new events.")
    ] = None,
    last_event_id: Annotated[str | None, Header(max_length=20)] = None,
) -> StreamingResponse:
    """Stream the events of a run, starting after a cursor. For annotators, `data` is empty."""
    start = int(last_event_id) if last_event_id and last_event_id.isascii() and last_event_id.isdigit() else after
    newest = await context.db.read(lambda tx: events.newest(tx, runs.find(tx, run).id))
    cursor = newest if start is None else start
    admission = _admission(request, cache, caller)
    stream = sse.stream_run(context, request, admission, run, cursor, with_data=caller.role in WATCHERS)
    return StreamingResponse(stream, media_type="text/event-stream")


@router.get(
    "/events",
    tags=["watching"],
    operation_id="streamChanges",
    response_class=StreamingResponse,
    responses={
        200: {
            "model": wire.Change,
            "description": "Server-sent events; each `data` is a Change.",
            "content": {"text/event-stream": {}},
        }
    },
)
async def stream_changes(request: Request, context: Ctx, cache: Cached, caller: Allowed) -> StreamingResponse:
    """Stream a message whenever any run has changed, at most one a second."""
    admission = _admission(request, cache, caller)
    return StreamingResponse(sse.stream_changes(context, request, admission), media_type="text/event-stream")


def _admission(request: Request, cache: CredentialCache, caller: Caller) -> Recheck:
    """Return the check that the caller may still read the stream, in the role in which it was opened."""

    async def check() -> None:
        if (await readmit(request, cache)).role != caller.role:
            raise errors.Forbidden("Your role has changed; open the stream again.")

    return Recheck(check)
