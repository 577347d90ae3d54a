"""Practice: queries whose answers are known, with feedback. Nothing is stored."""

from typing import Annotated

from fastapi import APIRouter, Path

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import AnyoneCalls
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals

router = APIRouter(prefix="/practice", tags=["practice"], route_class=JsonRoute)


@router.get("", operation_id="getPractice")
async def get_practice(context: Ctx, _: AnyoneCalls) -> wire.Practice:
    """Return the queries to practice on, in the order to meet them."""
    return context.practice.questions()


@router.post("/{query}", operation_id="practice", responses=refusals(errors.NotFound))
async def mark_practice(
    query: Annotated[int, Path(ge=0, le=10_000)], body: wire.PracticeAnswer, context: Ctx, _: AnyoneCalls
) -> wire.Feedback:
    """Say how good an answer is, label by label, and why."""
    return context.practice.mark(query, body.answer)
