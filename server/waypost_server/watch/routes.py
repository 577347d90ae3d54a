"""Watching: who is at work, a run's queries and ledger page by page, the history of a query, downloads, changes."""

from typing import Annotated

from fastapi import APIRouter, Query, Request
from fastapi.responses import StreamingResponse

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import AnyoneCalls
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.leases import presence
from waypost_server.queries import service as queries
from waypost_server.runs import events
from waypost_server.runs import service as runs
from waypost_server.watch import browsing, export

router = APIRouter(tags=["watching"], route_class=JsonRoute)

RowId = Annotated[int, Query(ge=0, le=2**63 - 1)]
Before = Annotated[int | None, Query(ge=0, le=2**63 - 1, description="Only rows older than this one.")]
After = Annotated[int | None, Query(ge=0, le=2**63 - 1, description="The rows just newer than this one.")]
Limit = Annotated[int, Query(ge=1, le=500)]
Word = Annotated[str | None, Query(max_length=100, pattern=r"^[^\x00]*$")]


@router.get("/runs/{run}/query-rows", operation_id="listQueryRows", responses=refusals(errors.NotFound))
async def list_query_rows(
    run: str,
    context: Ctx,
    _: AnyoneCalls,
    state: wire.QueryState | None = None,
    kind: wire.Kind | None = None,
    episode: RowId | None = None,
    annotator: Word = None,
    before: Before = None,
    after: After = None,
    limit: Limit = 50,
) -> wire.QueryPage:
    """List a run's queries without their trajectories, newest first, a page at a time."""
    chosen = browsing.QueryFilter(state, kind, episode, annotator)
    page = browsing.Page(before, after, limit)
    return await context.db.read(lambda tx: browsing.query_page(tx, run, chosen, page))


@router.get("/runs/{run}/ledger", operation_id="listLedger", responses=refusals(errors.NotFound))
async def list_ledger(
    run: str,
    context: Ctx,
    _: AnyoneCalls,
    kind: wire.Kind | None = None,
    entry: wire.LedgerEntryKind | None = None,
    before: Before = None,
    after: After = None,
    limit: Limit = 50,
) -> wire.LedgerPage:
    """List a run's charges and refunds, newest first, a page at a time, with the sums of all pages."""
    chosen = browsing.LedgerFilter(kind, entry)
    page = browsing.Page(before, after, limit)
    return await context.db.read(lambda tx: browsing.ledger_page(tx, run, chosen, page))


@router.get("/queries/{query}/history", operation_id="getHistory", responses=refusals(errors.NotFound))
async def get_history(query: queries.QueryId, context: Ctx, _: AnyoneCalls) -> wire.QueryHistory:
    """Return every time a query was handed out, what came of it, and what it cost."""
    return await context.db.read(lambda tx: browsing.history(tx, query))


@router.get("/annotators", operation_id="listAtWork", responses=refusals(errors.NotFound))
async def list_at_work(context: Ctx, _: AnyoneCalls, run: str | None = None) -> wire.AtWorkList:
    """Say who is at work, in one run or in all: who asked for a query of late or holds one."""
    settings = context.settings
    if run is not None:
        await context.db.read(lambda tx: runs.find(tx, run))
    return await context.db.read(
        lambda tx: presence.at_work(tx, settings.presence_seconds, settings.lease_seconds, run)
    )


@router.get(
    "/runs/{run}/export",
    operation_id="exportRun",
    response_class=StreamingResponse,
    responses=refusals(errors.NotFound)
    | {200: {"description": "The table, a row a line.", "content": {"text/csv": {}, "application/jsonl": {}}}},
)
async def export_run(
    run: str,
    context: Ctx,
    _: AnyoneCalls,
    table: wire.ExportTable = "curves",
    form: Annotated[wire.ExportFormat, Query(alias="format")] = "csv",
) -> StreamingResponse:
    """Download a run's curves, ledger or queries as CSV or JSON Lines."""
    found = await context.db.read(lambda tx: runs.find(tx, run))
    headers = {"Content-Disposition": f'attachment; filename="{found.id}-{table}.{form}"'}
    rows = export.stream(context, found.id, table, form)
    return StreamingResponse(rows, headers=headers, media_type=export.MEDIA_TYPES[form])


@router.get(
    "/events",
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
async def stream_changes(request: Request, context: Ctx, _: AnyoneCalls) -> StreamingResponse:
    """Stream that something changed in some run, at most once a second."""
    return StreamingResponse(events.changes(context, request), media_type="text/event-stream")
