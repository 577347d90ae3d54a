"""Defines the messages about assignments: lease a query, renew the lease, answer, release, and retract."""

from typing import Annotated

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.comments import Comment
from waypost.wire.queries import Query
from waypost.wire.runs import Vocabulary
from waypost.wire.system import Problem
from waypost.wire.words import Kind, Message, Name, Note

__all__ = [
    "AnswerBatch",
    "AnswerPost",
    "AssignedRun",
    "Assignment",
    "AssignmentList",
    "BatchReceipt",
    "BatchResult",
    "BatchedAnswer",
    "Lease",
    "LeaseBatch",
    "Leave",
    "Price",
    "Receipt",
    "Release",
    "Renew",
    "Renewal",
    "Retract",
    "TokenPost",
]


Tab = Annotated[str, Field(pattern=r"^[\x21-\x7e]{1,64}$", description="The name of a browser tab, chosen by the tab.")]


class Lease(Message):
    """A request for the next query, sent by an annotator."""

    wait: float = Field(
        default=0, ge=0, le=60, allow_inf_nan=False, description="The longest time to wait for a query, in seconds."
    )
    kinds: list[Kind] | None = Field(default=None, description="Only queries of these kinds; null for all kinds.")
    run: str | None = Field(default=None, description="Only queries of the run with this id; null for all runs.")
    defer: float = Field(
        default=0,
        ge=0,
        le=3_600,
        allow_inf_nan=False,
        description="How long to leave new queries to other working annotators who take their kind, in seconds. "
        "Only bots that help people need this.",
    )
    ahead: bool = Field(
        default=False,
        description="Whether the query is for later, because the annotator holds another one. It is leased only if "
        "enough queries remain for all other working annotators.",
    )
    tab: Tab | None = Field(
        default=None, description="The browser tab that asks; when it closes, `leave` releases its assignments."
    )


class LeaseBatch(Message):
    """A request for several queries at once, sent by a bot."""

    count: int = Field(ge=1, le=100, description="The most queries to lease.")
    wait: float = Field(
        default=0, ge=0, le=60, allow_inf_nan=False, description="The longest time to wait for a query, in seconds."
    )
    kinds: list[Kind] | None = Field(default=None, description="Only queries of these kinds; null for all kinds.")
    run: str | None = Field(default=None, description="Only queries of the run with this id; null for all runs.")
    defer: float = Field(
        default=0,
        ge=0,
        le=3_600,
        allow_inf_nan=False,
        description="How long to leave new queries to other working annotators who take their kind, in seconds.",
    )


class Price(Message):
    """The price of an answer, sent by the server: `fixed` + `per_action` x actions + `per_segment` x segments.

    Only the price of a demonstration depends on the answer. All other kinds have a fixed price.
    """

    fixed: float = Field(description="The fixed part, in units.")
    per_action: float = Field(description="The price of each action of a demonstration, in units.")
    per_segment: float = Field(description="The price of each segment of a demonstration, in units.")


class AssignedRun(Message):
    """The run of an assignment, as far as answering needs it; `GET /runs/{id}` has the rest."""

    id: str
    name: Name
    vocabulary: Vocabulary


class Assignment(Message):
    """One query leased to one annotator, sent by the server. To answer, send `token` before the lease expires."""

    id: int
    token: str = Field(description="The secret that proves the lease in every call about this assignment.")
    query: Query
    run: AssignedRun
    price: Price = Field(description="The price of the answer.")
    comments: list[Comment] = Field(
        default_factory=list,
        description="The comments with which reviewers sent earlier answers to this query back, oldest first.",
    )
    leased_at: float = Field(description="When the lease began, in seconds since the epoch.")
    expires_at: float = Field(description="When the lease expires without a renewal, in seconds since the epoch.")
    lease_seconds: float = Field(description="The length of a lease and of each renewal, in seconds.")


class AssignmentList(Message):
    """Live assignments of the caller, oldest first, sent by the server. A reloaded web app continues with them."""

    assignments: list[Assignment]


class AnswerPost(Message):
    """An answer, sent by an annotator. Sending it again returns the same receipt and costs nothing."""

    token: str = Field(max_length=200, description="The token of the assignment.")
    answer: Answer
    next: Lease | None = Field(default=None, description="Which query to lease in the same call; null for none.")


class BatchedAnswer(Message):
    """One answer of a batch."""

    assignment: int = Field(ge=1, le=2**63 - 1, description="The id of the assignment.")
    token: str = Field(max_length=200, description="The token of the assignment.")
    answer: Answer


class AnswerBatch(Message):
    """Answers that are stored together, sent by a bot. Sending them again returns the same receipts."""

    answers: list[BatchedAnswer] = Field(min_length=1, max_length=100)


class Receipt(Message):
    """The server's reply to an answer: it is stored on disk and charged."""

    query: int = Field(description="The id of the query.")
    answer: int = Field(description="The id of the answer.")
    units: float = Field(description="The cost of the answer, in units.")
    seconds: float = Field(description="The time from lease to answer, in seconds.")
    active_seconds: float = Field(description="The annotator's working time without idle time, in seconds.")
    next: Assignment | None = Field(description="The next assignment, if one was requested and is available.")
    next_problem: Problem | None = Field(
        default=None,
        description="The reason why no next query could be leased; null if none was requested or available. The answer "
        "is stored all the same.",
    )


class BatchResult(Message):
    """What became of one answer of a batch: it has a receipt, or a problem because of which it does not count."""

    receipt: Receipt | None
    problem: Problem | None


class BatchReceipt(Message):
    """The server's reply to a batch of answers: what became of each, in the same order."""

    results: list[BatchResult]


class TokenPost(Message):
    """The proof that the caller holds a lease, sent by an annotator."""

    token: str = Field(max_length=200, description="The token of the assignment.")


class Retract(TokenPost):
    """A request to retract an answer, sent by its annotator."""

    tab: Tab | None = Field(default=None, description="The browser tab that will hold the query again.")


class Renew(TokenPost):
    """A request to renew a lease, sent regularly by an annotator."""

    active: bool = Field(
        default=False,
        description="Whether the annotator pressed a key, moved the pointer or scrolled since the last renewal.",
    )


class Release(Message):
    """A request to release an unanswered query, sent by its annotator."""

    token: str = Field(max_length=200, description="The token of the assignment.")
    reason: Note = Field(default="", description="The reason, shown in the history of the query; may be empty.")
    skip: bool = Field(default=False, description="Whether the query must not be leased to this annotator again.")


class Leave(Message):
    """Sent by a browser tab when it closes: its assignments are released, and it gets no new leases."""

    tab: Tab
    keep: list[Annotated[int, Field(ge=1, le=2**63 - 1)]] = Field(
        max_length=1_000, description="The ids of assignments to keep, because their answers are still being sent."
    )


class Renewal(Message):
    """The server's reply to a renewal."""

    expires_at: float = Field(description="When the lease now expires, in seconds since the epoch.")
