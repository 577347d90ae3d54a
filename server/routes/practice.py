"""Practice: queries whose answers are known, with feedback. Nothing is stored."""

from typing import Annotated

from fastapi import APIRouter, Path

from server import errors, wire
from server.access import AnyoneCalls
from server.context import Ctx
from server.jsonbody import JsonRoute
from server.problems import refusals

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
