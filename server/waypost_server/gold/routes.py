"""Gold queries of a run: made, listed, retired."""

from typing import Annotated

from fastapi import APIRouter, Path

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import LearnerCalls
from waypost_server.gold import items
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals

router = APIRouter(prefix="/runs/{run}/gold", tags=["gold"], route_class=JsonRoute)


@router.post("", operation_id="addGold", responses=refusals(errors.NotFound, errors.NotAnswered))
async def add_gold(run: str, body: wire.GoldPost, context: Ctx, _: LearnerCalls) -> wire.GoldList:
    """Make queries gold: answered ones of this run, or others whose answers are known. All of them or none.

    The run's `gold_rate` says how often they are put to annotators, who cannot tell them from the learner's. They
    are never in its ledger, and the learner never sees them.
    """
    return await context.db.write(lambda tx: items.add(tx, run, body))


@router.get("", operation_id="listGold", responses=refusals(errors.NotFound))
async def list_gold(run: str, context: Ctx, _: LearnerCalls) -> wire.GoldList:
    """List the run's gold queries, newest first, with what annotators made of them."""
    return await context.db.read(lambda tx: items.of_run(tx, run))


@router.delete("/{item}", status_code=204, operation_id="retireGold", responses=refusals(errors.NotFound))
async def retire_gold(run: str, item: Annotated[int, Path(ge=1, le=2**63 - 1)], context: Ctx, _: LearnerCalls) -> None:
    """Put a gold query to nobody any more; what was answered to it stays."""
    await context.db.write(lambda tx: items.retire(tx, run, item))
