"""Routes to ask queries, wait for answers, and mark answers as used."""

from typing import Annotated

from fastapi import APIRouter, Query, Request

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.parameters import RowPath, RowQuery, Seconds
from waypost_server.http.polling import poll
from waypost_server.http.problems import refusals
from waypost_server.queries import service as queries
from waypost_server.queries.quotas import OpenQueries
from waypost_server.runs import service as runs

router = APIRouter(tags=["queries"], route_class=JsonRoute)


@router.post(
    "/runs/{run}/queries",
    operation_id="ask",
    responses=refusals(
        errors.NotFound, errors.DifferentContent, errors.RunFinished, errors.BudgetExhausted, errors.TooManyQueries
    ),
)
async def ask(run: str, body: wire.AskList, context: Ctx, caller: Allowed) -> wire.Asked:
    """Ask the expert: all of the queries or none. A query that was asked before is returned with its answer."""
    most = OpenQueries(context.settings.max_open_queries, context.settings.max_user_open_queries)
    contents = [queries.Content.of(one, place) for place, one in enumerate(body.queries)]
    return await context.db.write(lambda tx: queries.ask(tx, run, contents, body.priority, most, caller.user))


@router.get("/runs/{run}/queries", operation_id="listQueries", responses=refusals(errors.NotFound))
async def list_queries(
    run: str,
    context: Ctx,
    _: Allowed,
    state: wire.QueryState | None = None,
    kind: wire.Kind | None = None,
    episode: RowQuery | None = None,
    before: RowQuery | None = None,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
) -> wire.QueryList:
    """List a run's queries, newest first."""
    chosen = queries.Filter(state, kind, episode, before, limit)
    return await context.db.read(lambda tx: queries.newest(tx, run, chosen))


@router.get("/queries/{query}", operation_id="getQuery", responses=refusals(errors.NotFound))
async def get_query(query: RowPath, request: Request, context: Ctx, _: Allowed, wait: Seconds = 0) -> wire.Query:
    """Return a query; with `wait`, return as soon as it is answered or cancelled."""
    topic = queries.topic(query)
    return await poll(
        context,
        request,
        topic,
        wait,
        lambda: context.db.read(lambda tx: queries.view(tx, query)),
        lambda found: found.state in queries.CLOSED,
    )


@router.get("/runs/{run}/answers", operation_id="listAnswers", responses=refusals(errors.NotFound))
async def list_answers(
    run: str,
    request: Request,
    context: Ctx,
    _: Allowed,
    after: RowQuery = 0,
    wait: Seconds = 0,
    limit: Annotated[int, Query(ge=1, le=500)] = 100,
) -> wire.AnswerPage:
    """Return the queries answered after a cursor, in the order of their answers; with `wait`, wait for the first."""
    return await poll(
        context,
        request,
        runs.answers_topic(run),
        wait,
        lambda: context.db.read(lambda tx: queries.answered_after(tx, run, after, limit)),
        lambda page: bool(page.queries),
    )


@router.post("/queries/{query}/use", operation_id="useAnswer", responses=refusals(errors.NotFound, errors.NotAnswered))
async def use_answer(query: RowPath, context: Ctx, caller: Allowed) -> wire.Query:
    """Mark the answer as used. From then on it can no longer be retracted."""
    return await context.db.write(lambda tx: queries.use(tx, query, caller.user))
