"""Routes to add, list and retire the gold queries of a run."""

from fastapi import APIRouter

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.gold import items
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.parameters import RowPath
from waypost_server.http.problems import refusals

router = APIRouter(prefix="/runs/{run}/gold", tags=["gold"], route_class=JsonRoute)


@router.post("", operation_id="addGold", responses=refusals(errors.NotFound, errors.NotAnswered))
async def add_gold(run: str, body: wire.GoldPost, context: Ctx, caller: Allowed) -> wire.GoldList:
    """Make queries gold: answered queries of this run, or other queries with known answers. All of them or none.

    The run's `gold_rate` is the share of each annotator's queries that are gold. They look like the learner's queries.
    They are never in the run's ledger, and the learner never sees them.
    """
    return await context.db.write(lambda tx: items.add(tx, run, body, caller.user))


@router.get("", operation_id="listGold", responses=refusals(errors.NotFound))
async def list_gold(run: str, context: Ctx, _: Allowed) -> wire.GoldList:
    """List the run's gold queries, newest first, each with its number of answers and their agreement."""
    return await context.db.read(lambda tx: items.of_run(tx, run))


@router.delete("/{item}", status_code=204, operation_id="retireGold", responses=refusals(errors.NotFound))
async def retire_gold(run: str, item: RowPath, context: Ctx, caller: Allowed) -> None:
    """Retire a gold query: no annotator gets it any more. Answers to it stay."""
    await context.db.write(lambda tx: items.retire(tx, run, item, caller.user))
