"""Routes for administrators: the audit log, as pages and as a download."""

from typing import Annotated

from fastapi import APIRouter, Query
from fastapi.responses import StreamingResponse

from waypost import wire
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.watch import audit_rows
from waypost_server.watch.export import MEDIA_TYPES
from waypost_server.watch.routes import After, Before, Limit, Word
from waypost_server.watch.row_pages import RowPage

router = APIRouter(prefix="/audit", tags=["people"], route_class=JsonRoute)

LAST = 253_402_300_799  # the end of the year 9999
Since = Annotated[
    float | None,
    Query(ge=0, le=LAST, allow_inf_nan=False, description="From this time on, in seconds since the epoch."),
]
Until = Annotated[
    float | None, Query(ge=0, le=LAST, allow_inf_nan=False, description="Before this time, in seconds since the epoch.")
]


@router.get("", operation_id="listAudit")
async def list_audit(
    context: Ctx,
    _: Allowed,
    actor: Word = None,
    action: wire.AuditAction | None = None,
    since: Since = None,
    until: Until = None,
    before: Before = None,
    after: After = None,
    limit: Limit = 50,
) -> wire.AuditPage:
    """List one page of the audit log, newest first: who did what with access, and what was refused."""
    chosen = audit_rows.AuditFilter(actor, action, since, until)
    page = RowPage(before, after, limit)
    return await context.db.read(lambda tx: audit_rows.audit_page(tx, chosen, page))


@router.get(
    "/export",
    operation_id="exportAudit",
    response_class=StreamingResponse,
    responses={200: {"description": "One row per line.", "content": {"text/csv": {}, "application/jsonl": {}}}},
)
async def export_audit(
    context: Ctx, _: Allowed, form: Annotated[wire.ExportFormat, Query(alias="format")] = "jsonl"
) -> StreamingResponse:
    """Download the whole audit log, oldest rows first, with all hashes."""
    headers = {"Content-Disposition": f'attachment; filename="audit.{form}"'}
    return StreamingResponse(audit_rows.stream(context.db, form), headers=headers, media_type=MEDIA_TYPES[form])
