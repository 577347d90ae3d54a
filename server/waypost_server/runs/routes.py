"""Routes to create, list and change runs, report episodes, and read curves and costs."""

from typing import Annotated

from fastapi import APIRouter, Query

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.parameters import DryRun
from waypost_server.http.problems import refusals
from waypost_server.runs import curves, deletion, episodes, forecasts, listing
from waypost_server.runs import service as runs

router = APIRouter(prefix="/runs", tags=["runs"], route_class=JsonRoute)


@router.post("", status_code=201, operation_id="createRun")
async def create_run(body: wire.RunCreate, context: Ctx, caller: Allowed) -> wire.Run:
    """Create a run: one learner's training with one algorithm, domain, seed and cost model."""
    return await context.db.write(lambda tx: runs.create(tx, body, caller.user))


@router.get("", operation_id="listRuns")
async def list_runs(
    context: Ctx,
    caller: Allowed,
    text: Annotated[
        str, Query(max_length=200, pattern=r"^[^\x00]*$", description="Words in the name, algorithm, domain or id.")
    ] = "",
    state: wire.RunState | None = None,
    run: Annotated[list[str] | None, Query(max_length=100, description="Only the runs with these ids.")] = None,
    mine: Annotated[bool, Query(description="Only the runs that the caller created.")] = False,
    sort: wire.RunSort = "newest",
    descending: bool = True,
    offset: Annotated[int, Query(ge=0, le=2**31 - 1)] = 0,
    limit: Annotated[int, Query(ge=1, le=1_000)] = 200,
) -> wire.RunList:
    """List runs, newest first unless sorted otherwise."""
    owner = caller.user if mine else None
    chosen = listing.Filter(text, state, tuple(run or ()), owner, sort, descending, offset, limit)
    return await context.db.read(lambda tx: listing.list_runs(tx, chosen))


@router.get("/{run}", operation_id="getRun", responses=refusals(errors.NotFound))
async def get_run(run: str, context: Ctx, _: Allowed) -> wire.Run:
    """Return a run with its account."""
    return await context.db.read(lambda tx: runs.view(tx, run))


@router.patch(
    "/{run}", operation_id="patchRun", responses=refusals(errors.NotFound, errors.RunFinished, errors.BudgetTooLow)
)
async def patch_run(run: str, body: wire.RunPatch, context: Ctx, caller: Allowed) -> wire.Run:
    """Rename, pause, resume or finish a run; set its budget or priority. Finishing a run cancels its open queries."""
    return await context.db.write(lambda tx: runs.patch(tx, run, body, caller.user))


@router.delete("/{run}", operation_id="deleteRun", responses=refusals(errors.NotFound, errors.NotFinished))
async def delete_run(run: str, context: Ctx, caller: Allowed, dry_run: DryRun = False) -> wire.RunDeletion:
    """Delete what a finished run contains, for good. Its costs and its ledger stay, and so do annotators' numbers."""
    if dry_run:
        return await context.db.read(lambda tx: deletion.preview(tx, runs.find_own(tx, run, caller.user, caller.role)))
    return await context.db.write(lambda tx: deletion.delete(tx, runs.lock_own(tx, run, caller.user), caller.actor))


@router.post(
    "/{run}/episodes",
    operation_id="reportEpisodes",
    responses=refusals(errors.NotFound, errors.DifferentContent, errors.RunFinished),
)
async def report_episodes(run: str, body: wire.EpisodeList, context: Ctx, caller: Allowed) -> wire.Run:
    """Report the results of episodes. Reporting the same result again changes nothing."""
    return await context.db.write(lambda tx: episodes.report(tx, run, body.episodes, caller.user))


@router.get("/{run}/curves", operation_id="getCurves", responses=refusals(errors.NotFound))
async def get_curves(
    run: str,
    context: Ctx,
    _: Allowed,
    after: Annotated[int, Query(ge=-1, le=2**31 - 1, description="Only the episodes after this one.")] = -1,
    most: Annotated[
        int | None,
        Query(ge=2, le=100_000, description="With more rows than this, only the last and every n-th before it."),
    ] = None,
) -> wire.Curves:
    """Return success and cumulative cost by episode."""
    return await context.db.read(lambda tx: curves.curves(tx, run, after, most))


@router.get("/{run}/costs", operation_id="getCosts", responses=refusals(errors.NotFound))
async def get_costs(run: str, context: Ctx, _: Allowed) -> wire.Costs:
    """Return the ledger's sums, by kind of query."""
    return await context.db.read(lambda tx: curves.costs(tx, run))


@router.get("/{run}/forecast", operation_id="getForecast", responses=refusals(errors.NotFound))
async def get_forecast(
    run: str,
    context: Ctx,
    _: Allowed,
    target: Annotated[wire.SuccessLevel, Query(description="The success rate over 100 test episodes.")] = "0.9",
) -> wire.Forecast:
    """Forecast how many more units the run needs to reach a success rate."""
    return await context.db.read(lambda tx: forecasts.forecast(tx, run, target))
