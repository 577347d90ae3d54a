"""Queries: a learner asks, waits for answers, and marks those it has trained on."""

from typing import Annotated

from fastapi import APIRouter, Query, Request

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import AnyoneCalls, LearnerCalls
from waypost_server.http import polling
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.queries import service as queries
from waypost_server.runs import service as runs

router = APIRouter(tags=["queries"], route_class=JsonRoute)

RowId = Annotated[int, Query(ge=0, le=2**63 - 1)]
Seconds = Annotated[float, Query(ge=0, le=60, allow_inf_nan=False, description="Wait so long for a change, seconds.")]


@router.post(
    "/runs/{run}/queries",
    operation_id="ask",
    responses=refusals(
        errors.NotFound, errors.DifferentContent, errors.RunFinished, errors.BudgetExhausted, errors.TooManyQueries
    ),
)
async def ask(run: str, body: wire.AskList, context: Ctx, _: LearnerCalls) -> wire.Asked:
    """Ask the expert: all of the queries or none. A query asked before is returned with its answer."""
    limit = context.settings.max_open_queries
    contents = [queries.Content.of(one) for one in body.queries]
    return await context.db.write(lambda tx: queries.ask(tx, run, body, contents, limit))


@router.get("/runs/{run}/queries", operation_id="listQueries", responses=refusals(errors.NotFound))
async def list_queries(
    run: str,
    context: Ctx,
    _: AnyoneCalls,
    state: wire.QueryState | None = None,
    kind: wire.Kind | None = None,
    episode: RowId | None = None,
    before: RowId | None = None,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
) -> wire.QueryList:
    """List a run's queries, newest first."""
    chosen = queries.Filter(state, kind, episode, before, limit)
    return await context.db.read(lambda tx: queries.newest(tx, run, chosen))


@router.get("/queries/{query}", operation_id="getQuery", responses=refusals(errors.NotFound))
async def get_query(
    query: queries.QueryId, request: Request, context: Ctx, _: AnyoneCalls, wait: Seconds = 0
) -> wire.Query:
    """Return a query; with `wait`, as soon as it is answered or cancelled."""
    topic = queries.topic(query)
    return await polling.until(
        context, request, topic, wait, lambda tx: queries.view(tx, query), lambda found: found.state in queries.CLOSED
    )


@router.get("/runs/{run}/answers", operation_id="listAnswers", responses=refusals(errors.NotFound))
async def list_answers(
    run: str,
    request: Request,
    context: Ctx,
    _: AnyoneCalls,
    after: RowId = 0,
    wait: Seconds = 0,
    limit: Annotated[int, Query(ge=1, le=500)] = 100,
) -> wire.AnswerPage:
    """Return the queries answered after a cursor, in the order of the answers; with `wait`, as soon as there is one."""
    return await polling.until(
        context,
        request,
        runs.answers_topic(run),
        wait,
        lambda tx: queries.answered_after(tx, run, after, limit),
        lambda page: bool(page.queries),
    )


@router.post("/queries/{query}/use", operation_id="useAnswer", responses=refusals(errors.NotFound, errors.NotAnswered))
async def use_answer(query: queries.QueryId, context: Ctx, _: LearnerCalls) -> wire.Query:
    """Mark the answer as used: from now on it can be retracted no more."""
    return await context.db.write(lambda tx: queries.use(tx, query))
