"""Assignments: an annotator leases a query, answers it, gives it back, or takes an answer back."""

from typing import Annotated

from fastapi import APIRouter, Header, Path, Request, Response

from waypost import wire
from waypost_server import errors
from waypost_server.answers import service as answering
from waypost_server.auth.permissions import AnnotatorCalls
from waypost_server.http import polling
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.leases import service as leases

router = APIRouter(prefix="/assignments", tags=["assignments"], route_class=JsonRoute)

AssignmentId = Annotated[int, Path(ge=1, le=2**63 - 1)]
Key = Annotated[
    str | None,
    Header(
        alias="Idempotency-Key",
        pattern=r"^[\x21-\x7e]{1,200}$",
        description="Names this attempt; sending the same again returns the same receipt.",
    ),
]

HELD = (errors.NotFound, errors.NotYours, errors.WrongToken, errors.LeaseExpired, errors.LeaseEnded)


@router.post(
    "",
    status_code=201,
    operation_id="lease",
    responses=refusals(errors.NotFound) | {204: {"description": "Nothing to do within `wait` seconds."}},
    response_model=wire.Assignment,
)
async def lease(body: wire.Lease, request: Request, context: Ctx, caller: AnnotatorCalls) -> wire.Assignment | Response:
    """Lease the next query, waiting for one if need be."""
    found = await polling.lease(context, request, leases.Wish.of(body, caller.user, context.settings), body.wait)
    return found if found is not None else Response(status_code=204)


@router.post("/leave", status_code=204, operation_id="leave")
async def leave(body: wire.Leave, context: Ctx, caller: AnnotatorCalls) -> None:
    """Say that a page is going: what it holds goes back, and what was under way to it is leased to nobody."""
    await context.db.write(lambda tx: leases.leave(tx, caller.user, body))


@router.get("", operation_id="myAssignments")
async def my_assignments(context: Ctx, caller: AnnotatorCalls) -> wire.AssignmentList:
    """List the caller's live assignments, so that a reloaded page can go on with them."""
    return await context.db.read(lambda tx: leases.held(tx, caller.user))


@router.post(
    "/{assignment}/answer",
    operation_id="answer",
    responses=refusals(*HELD, errors.QueryCancelled, errors.AnswerRetracted, errors.DifferentContent, errors.KeyReused),
)
async def answer(
    assignment: AssignmentId,
    body: wire.AnswerPost,
    request: Request,
    context: Ctx,
    caller: AnnotatorCalls,
    key: Key = None,
) -> wire.Receipt:
    """Answer: stored, charged and closed in one transaction, acknowledged when it is on disk."""
    wish = leases.Wish.of(body.next, caller.user, context.settings, after=assignment) if body.next else None
    post = answering.Post(assignment, caller.user, body.token, body.answer, key, context.settings.idle_seconds)
    outcome = await context.db.write(lambda tx: answering.answer(tx, post, wish))
    receipt = outcome.receipt()
    if wish is None or body.next is None or receipt.next is not None or body.next.wait == 0:
        return receipt
    following = await polling.lease(context, request, wish, body.next.wait)
    return receipt.model_copy(update={"next": following})


@router.post("/{assignment}/renew", operation_id="renew", responses=refusals(*HELD))
async def renew(assignment: AssignmentId, body: wire.Renew, context: Ctx, caller: AnnotatorCalls) -> wire.Renewal:
    """Keep the lease: it lives from now on for its full length, up to the server's cap."""
    settings = context.settings
    return await context.db.write(lambda tx: leases.renew(tx, assignment, caller.user, body, settings))


@router.post("/{assignment}/release", status_code=204, operation_id="release", responses=refusals(*HELD))
async def release(assignment: AssignmentId, body: wire.Release, context: Ctx, caller: AnnotatorCalls) -> None:
    """Give the query back, unanswered; with `skip`, not to be offered it again."""
    settings = context.settings
    await context.db.write(lambda tx: leases.release(tx, assignment, caller.user, body, settings))


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
async def retract(
    assignment: AssignmentId, body: wire.Retract, context: Ctx, caller: AnnotatorCalls
) -> wire.Assignment:
    """Take an answer back that the learner has not used: it is refunded, and its query is leased again."""
    settings = context.settings
    return await context.db.write(lambda tx: answering.retract(tx, assignment, caller.user, body, settings))
