"""Routes to answer a query, and to retract an answer."""

from typing import Annotated

from fastapi import APIRouter, Header, Request

from waypost import wire
from waypost_server import errors
from waypost_server.answers import batch, following, retraction
from waypost_server.answers import service as answers
from waypost_server.auth import refusals as recorded
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import Ctx
from waypost_server.http.hot import HotRoute
from waypost_server.http.parameters import RowPath
from waypost_server.http.problems import refusals
from waypost_server.leases.request import LeaseRequest
from waypost_server.leases.routes import NO_LIVE_LEASE

router = APIRouter(prefix="/assignments", tags=["assignments"], route_class=HotRoute)

Key = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        pattern=r"^[\x21-\x7e]{1,200}$",
        description="Names this attempt. Sending the same attempt again returns the same receipt.",
    ),
]


@router.post(
    "/{assignment}/answer",
    operation_id="answer",
    responses=refusals(
        *NO_LIVE_LEASE,
        errors.QueryCancelled,
        errors.AnswerRetracted,
        errors.DifferentContent,
        errors.KeyReused,
    ),
)
async def answer(
    assignment: RowPath,
    body: wire.AnswerPost,
    request: Request,
    context: Ctx,
    caller: Allowed,
    key: Key = None,
) -> wire.Receipt:
    """Answer a query. One transaction stores and charges the answer; the reply comes when the answer is on disk.

    If the query wanted as `next` cannot be leased, the answer stays accepted, and `next_problem` says why.
    """
    wanted = LeaseRequest.of(body.next, caller.user, context.settings, after=assignment) if body.next else None
    post = answers.Post(assignment, caller.user, body.token, body.answer, key, context.settings.idle_seconds)
    outcome = await context.db.write(lambda tx: answers.answer(tx, post, wanted))
    receipt = outcome.receipt()
    leased = following.Following(receipt.next, receipt.next_problem)
    if wanted is None or body.next is None or leased.is_settled or body.next.wait == 0:
        return receipt
    leased = await following.wait(context, request, wanted, body.next.wait)
    return receipt.model_copy(update={"next": leased.assignment, "next_problem": leased.problem})


@router.post("/answers", operation_id="answerBatch")
async def answer_batch(body: wire.AnswerBatch, request: Request, context: Ctx, caller: Allowed) -> wire.BatchReceipt:
    """Answer several queries, stored by one commit. Each answer has a receipt, or the problem why it does not count."""
    idle = context.settings.idle_seconds
    posts = [answers.Post(one.assignment, caller.user, one.token, one.answer, None, idle) for one in body.answers]
    receipt = await context.db.write(lambda tx: batch.answer_all(tx, posts))
    for problem in (one.problem for one in receipt.results if one.problem is not None):
        await recorded.record(request, "answerBatch", problem.status, problem.type.rpartition("/")[2])
    return receipt


@router.post(
    "/{assignment}/retract",
    operation_id="retract",
    responses=refusals(
        errors.NotFound,
        errors.NotYours,
        errors.WrongToken,
        errors.LeaseEnded,
        errors.AnswerUsed,
        errors.AnswerRetracted,
        errors.RunFinished,
        errors.BudgetExhausted,
    ),
)
async def retract(assignment: RowPath, body: wire.Retract, context: Ctx, caller: Allowed) -> wire.Assignment:
    """Retract an answer that the learner has not used: refund it, and lease its query to the caller again."""
    settings = context.settings
    return await context.db.write(lambda tx: retraction.retract(tx, assignment, caller.user, body, settings))
