"""Routes to watch runs: tables of queries and ledger entries, query history, annotators at work, downloads."""

from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import StreamingResponse

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.parameters import RowPath, RowQuery
from waypost_server.http.problems import refusals
from waypost_server.leases import stuck
from waypost_server.runs import service as runs
from waypost_server.watch import at_work, export, ledger_rows, outlook, query_history, query_rows
from waypost_server.watch.records import reading
from waypost_server.watch.row_pages import RowPage

router = APIRouter(tags=["watching"], route_class=JsonRoute)

Before = Annotated[int | None, Query(ge=0, le=2**63 - 1, description="Only rows older than this one.")]
After = Annotated[int | None, Query(ge=0, le=2**63 - 1, description="The oldest rows that are newer than this one.")]
Limit = Annotated[int, Query(ge=1, le=500)]
Text = Annotated[
    str,
    Query(
        max_length=100,
        pattern=r"^[^\x00]*$",
        description="Words, each of which is in the question, a comment, a reason to skip, or the annotator's name.",
    ),
]
Word = Annotated[str | None, Query(max_length=100, pattern=r"^[^\x00]*$")]


@router.get("/runs/{run}/query-rows", operation_id="listQueryRows", responses=refusals(errors.NotFound))
async def list_query_rows(
    run: str,
    context: Ctx,
    _: Allowed,
    state: wire.QueryState | None = None,
    kind: wire.Kind | None = None,
    episode: RowQuery | None = None,
    annotator: Word = None,
    text: Text = "",
    before: Before = None,
    after: After = None,
    limit: Limit = 50,
) -> wire.QueryPage:
    """List one page of a run's queries without their trajectories, newest first."""
    chosen = query_rows.QueryFilter(state, kind, episode, annotator, text)
    page = RowPage(before, after, limit)
    return await context.db.read(lambda tx: query_rows.query_page(tx, run, chosen, page))


@router.get("/runs/{run}/ledger", operation_id="listLedger", responses=refusals(errors.NotFound))
async def list_ledger(
    run: str,
    context: Ctx,
    _: Allowed,
    kind: wire.Kind | None = None,
    entry: wire.LedgerEntryKind | None = None,
    before: Before = None,
    after: After = None,
    limit: Limit = 50,
) -> wire.LedgerPage:
    """List one page of a run's charges and refunds, newest first, with the sums over all pages."""
    chosen = ledger_rows.LedgerFilter(kind, entry)
    page = RowPage(before, after, limit)
    return await context.db.read(lambda tx: ledger_rows.ledger_page(tx, run, chosen, page))


@router.get("/runs/{run}/records", operation_id="listRecords", responses=refusals(errors.NotFound))
async def list_records(
    run: str,
    context: Ctx,
    _: Allowed,
    part: wire.RecordPart,
    after: Annotated[int | None, Query(ge=0, le=2**62, description="The cursor of the page before.")] = None,
) -> wire.RecordPage:
    """List one page of a run's records: its queries with their histories, its ledger, or its episodes."""
    return await context.db.read(lambda tx: reading.page(tx, run, part, after))


@router.get("/queries/{query}/history", operation_id="getHistory", responses=refusals(errors.NotFound))
async def get_history(query: RowPath, context: Ctx, _: Allowed) -> wire.QueryHistory:
    """Return all assignments of a query, their answers, and what they cost."""
    return await context.db.read(lambda tx: query_history.history(tx, query))


@router.get("/runs/{run}/stuck", operation_id="listStuck", responses=refusals(errors.NotFound))
async def list_stuck(run: str, context: Ctx, _: Allowed) -> wire.Stuck:
    """List the queries of a run that are stuck, and why: nobody takes them, leases expire, or everybody skips them."""
    return await context.db.read(lambda tx: stuck.stuck(tx, run))


@router.get("/annotators", operation_id="listAtWork", responses=refusals(errors.NotFound))
async def list_at_work(context: Ctx, _: Allowed, run: str | None = None) -> wire.AtWorkList:
    """List the annotators at work, in one run or in all: those who asked for a query recently or hold one."""
    settings = context.settings
    if run is not None:
        await context.db.read(lambda tx: runs.find(tx, run))
    return await context.db.read(lambda tx: at_work.at_work(tx, settings.presence_seconds, settings.lease_seconds, run))


@router.get("/outlook", operation_id="getOutlook")
async def get_outlook(context: Ctx, _: Allowed, run: Word = None) -> wire.Outlook:
    """Return what the learners do now and when they will ask, for annotators who wait; `run` is the first run."""
    return await context.db.read(lambda tx: outlook.outlook(tx, run))


@router.get(
    "/runs/{run}/export",
    operation_id="exportRun",
    response_class=StreamingResponse,
    responses=refusals(errors.NotFound)
    | {200: {"description": "The table, one row per line.", "content": {"text/csv": {}, "application/jsonl": {}}}},
)
async def export_run(
    run: str,
    context: Ctx,
    _: Allowed,
    table: wire.ExportTable = "curves",
    form: Annotated[wire.ExportFormat, Query(alias="format")] = "csv",
) -> StreamingResponse:
    """Download a run's curves, ledger or queries as CSV or JSON Lines."""
    find = runs.find_account if table == "ledger" else runs.find
    found = await context.db.read(lambda tx: find(tx, run))
    headers = {"Content-Disposition": f'attachment; filename="{found.id}-{table}.{form}"'}
    rows = export.stream(context, found.id, table, form)
    return StreamingResponse(rows, headers=headers, media_type=export.MEDIA_TYPES[form])
