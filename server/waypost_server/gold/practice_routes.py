"""Routes of practice queries: an annotator answers and gets feedback. Nothing is stored."""

from typing import Annotated

from fastapi import APIRouter, Path, Query

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.gold.practice import Exercises
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals

router = APIRouter(prefix="/practice", tags=["practice"], route_class=JsonRoute)


@router.get("", operation_id="getPractice", responses=refusals(errors.NotFound))
async def get_practice(
    exercises: Exercises,
    _: Allowed,
    domain: Annotated[
        str | None, Query(max_length=100, description="The domain to practice; the first of all if absent.")
    ] = None,
) -> wire.Practice:
    """Return the practice queries of a domain in the order to answer them."""
    return exercises.questions(domain)


@router.post("/{query}", operation_id="practice", responses=refusals(errors.NotFound))
async def mark_practice(
    query: Annotated[int, Path(ge=0, le=10_000)], body: wire.PracticeAnswer, exercises: Exercises, _: Allowed
) -> wire.Feedback:
    """Return which labels of an answer are right, and why."""
    return exercises.mark(query, body.answer)
