"""Routes of practice queries: an annotator answers and gets feedback. No answer is stored."""

from typing import Annotated

from fastapi import APIRouter, Path, Query

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.gold import sent_practice
from waypost_server.gold.practice import Practice
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals

router = APIRouter(tags=["practice"], route_class=JsonRoute)


@router.get("/practice", operation_id="getPractice", responses=refusals(errors.NotFound))
async def get_practice(
    practice: Practice,
    context: Ctx,
    _: Allowed,
    domain: Annotated[
        str | None, Query(max_length=100, description="The domain to practice; the first of all if absent.")
    ] = None,
) -> wire.Practice:
    """Return the practice queries of a domain in the order to answer them."""
    return await context.db.read(lambda tx: practice.questions(tx, domain))


@router.post("/practice/{query}", operation_id="practice", responses=refusals(errors.NotFound))
async def mark_practice(
    query: Annotated[int, Path(ge=0, le=2**53)], body: wire.PracticeAnswer, practice: Practice, context: Ctx, _: Allowed
) -> wire.Feedback:
    """Return which labels of an answer are right, and why."""
    return await context.db.read(lambda tx: practice.mark(tx, query, body.answer))


@router.put("/runs/{run}/practice", status_code=204, operation_id="putPractice", responses=refusals(errors.NotFound))
async def put_practice(run: str, body: wire.PracticePut, context: Ctx, caller: Allowed) -> None:
    """Send practice queries of the run's domain. People get them unless the server has a file for this domain."""
    await context.db.write(lambda tx: sent_practice.put(tx, run, body, caller.user))
