"""The route of a run's records, from which `waypost export` makes files."""

from typing import Annotated

from fastapi import APIRouter, Query

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import AnyoneCalls
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.records import reading

router = APIRouter(prefix="/runs", tags=["records"], route_class=JsonRoute)


@router.get("/{run}/records", operation_id="listRecords", responses=refusals(errors.NotFound))
async def list_records(
    run: str,
    context: Ctx,
    _: AnyoneCalls,
    part: wire.RecordPart,
    after: Annotated[int | None, Query(ge=0, le=2**62, description="The cursor of the page before.")] = None,
) -> wire.RecordPage:
    """List one page of a run's records: its queries with their histories, its ledger, or its episodes."""
    return await context.db.read(lambda tx: reading.page(tx, run, part, after))
