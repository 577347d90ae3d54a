"""Routes to review the answers of a run: page through them, comment on them, send them back."""

from typing import Annotated

from fastapi import APIRouter, Query

from waypost import wire
from waypost_server import errors
from waypost_server.answers.review import agreement, predictions
from waypost_server.answers.review import service as review
from waypost_server.answers.review.rows import review_page
from waypost_server.auth.permissions import Allowed
from waypost_server.db.transaction import Tx
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.parameters import RowPath
from waypost_server.http.problems import refusals
from waypost_server.runs import service as runs
from waypost_server.watch.query_rows import QueryFilter
from waypost_server.watch.routes import After, Before, Word
from waypost_server.watch.row_pages import RowPage

router = APIRouter(tags=["review"], route_class=JsonRoute)


@router.get("/runs/{run}/review", operation_id="listReview", responses=refusals(errors.NotFound))
async def list_review(
    run: str,
    context: Ctx,
    caller: Allowed,
    kind: wire.Kind | None = None,
    annotator: Word = None,
    disagrees: Annotated[
        wire.Disagreement | None,
        Query(
            description="Only answers that differ from the learner's suggestion, from what its policies would answer "
            "now, or from a second answer, or those to gold queries whose first labels were not all correct. Only the "
            "last filter finds answers to gold queries."
        ),
    ] = None,
    before: Before = None,
    after: After = None,
    limit: Annotated[int, Query(ge=1, le=100)] = 20,
) -> wire.ReviewPage:
    """List one page of a run's answers to review, newest query first."""
    chosen = QueryFilter(kind=kind, annotator=annotator, disagrees=disagrees)
    page = RowPage(before, after, limit)

    def read(tx: Tx) -> wire.ReviewPage:
        runs.find_own(tx, run, caller.user, caller.role)
        return review_page(tx, run, chosen, page)

    return await context.db.read(read)


@router.put(
    "/runs/{run}/predictions", status_code=204, operation_id="putPredictions", responses=refusals(errors.NotFound)
)
async def put_predictions(run: str, body: wire.Predictions, context: Ctx, caller: Allowed) -> None:
    """Send what the policies would answer now to queries whose answers were used. The review compares both."""
    await context.db.write(lambda tx: predictions.put(tx, run, body, caller.user))


@router.get("/runs/{run}/agreement", operation_id="getAgreement", responses=refusals(errors.NotFound))
async def get_agreement(run: str, context: Ctx, _: Allowed) -> wire.Agreement:
    """Return how far annotators agree on the queries that two of them answered, by kind of query."""

    def read(tx: Tx) -> wire.Agreement:
        return agreement.agreement(tx, runs.find(tx, run).id)

    return await context.db.read(read)


@router.post("/queries/{query}/comments", status_code=201, operation_id="comment", responses=refusals(errors.NotFound))
async def comment(query: RowPath, body: wire.CommentPost, context: Ctx, caller: Allowed) -> wire.Comment:
    """Comment on a query. Annotators do not see it."""
    return await context.db.write(lambda tx: review.comment(tx, query, body, caller.user))


@router.post(
    "/queries/{query}/send-back",
    status_code=201,
    operation_id="sendBack",
    responses=refusals(
        errors.NotFound,
        errors.CannotSendBack,
        errors.AnswerRetracted,
        errors.AnswerUsed,
        errors.RunFinished,
        errors.BudgetExhausted,
    ),
)
async def send_back(query: RowPath, body: wire.SendBack, context: Ctx, caller: Allowed) -> wire.Comment:
    """Send an answer back that the learner has not used: refund it, and open its query again for every annotator.

    Whoever gets the query next sees the comment, and the annotator who gave the answer finds it at `GET /me/returned`.
    """
    return await context.db.write(lambda tx: review.send_back(tx, query, body, caller.user))


@router.get("/me/returned", operation_id="myReturned")
async def my_returned(context: Ctx, caller: Allowed) -> wire.ReturnedList:
    """List the caller's answers that a reviewer sent back, newest first, each with the comment."""
    return await context.db.read(lambda tx: review.returned(tx, caller.user))
