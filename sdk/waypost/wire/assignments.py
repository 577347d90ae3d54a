"""Assignments: what an annotator holds, and how it is answered, kept or given back."""

from typing import Annotated

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.queries import Query
from waypost.wire.runs import Run
from waypost.wire.words import Kind, Message, Note

__all__ = [
    "AnswerPost",
    "Assignment",
    "AssignmentList",
    "Lease",
    "Leave",
    "Price",
    "Receipt",
    "Release",
    "Renew",
    "Renewal",
    "Retract",
    "TokenPost",
]


Tab = Annotated[str, Field(pattern=r"^[\x21-\x7e]{1,64}$", description="A page's own name for itself, of its making.")]


class Lease(Message):
    """What an annotator is willing to take."""

    wait: float = Field(default=0, ge=0, le=60, allow_inf_nan=False, description="Wait so long for a query, seconds.")
    kinds: list[Kind] | None = Field(default=None, description="Only these kinds; null for all.")
    run: str | None = Field(default=None, description="Only this run; null for all.")
    defer: float = Field(
        default=0,
        ge=0,
        le=3_600,
        allow_inf_nan=False,
        description="Leave a query this many seconds to other annotators who are at work and take its kind. A bot that "
        "helps people sets it; nobody else need.",
    )
    ahead: bool = Field(
        default=False,
        description="To be answered after what the annotator holds already: only while enough queries are left for "
        "everybody else at work.",
    )
    tab: Tab | None = Field(default=None, description="The page that asks, so that it can give back all it holds.")


class Price(Message):
    """The price of an answer: `fixed` + `per_action` x its actions + `per_segment` x its segments, in units.

    Only the price of a demonstration depends on the answer; every other kind has a `fixed` price.
    """

    fixed: float
    per_action: float
    per_segment: float


class Assignment(Message):
    """One query handed to one annotator under a lease. Only `token` and an unexpired lease can answer it."""

    id: int
    token: str
    query: Query
    run: Run
    price: Price = Field(description="What the answer will cost.")
    leased_at: float
    expires_at: float
    lease_seconds: float


class AssignmentList(Message):
    """The caller's live assignments, oldest first: what a reloaded page goes on with."""

    assignments: list[Assignment]


class AnswerPost(Message):
    """An answer. Sending it again (same assignment, same content) returns the same receipt and costs nothing."""

    token: str = Field(max_length=200)
    answer: Answer
    next: Lease | None = Field(default=None, description="Lease the next query in the same call; null for none.")


class Receipt(Message):
    """The answer is on disk and charged."""

    query: int
    answer: int
    units: float
    seconds: float
    active_seconds: float
    next: Assignment | None


class TokenPost(Message):
    """Shows that the caller holds the lease."""

    token: str = Field(max_length=200)


class Retract(TokenPost):
    """Take an answer back."""

    tab: Tab | None = Field(default=None, description="The page that will hold its query again.")


class Renew(TokenPost):
    """A heartbeat."""

    active: bool = Field(
        default=False, description="The annotator did something since the last one: pressed, pointed, scrolled."
    )


class Release(Message):
    """Give a query back, unanswered."""

    token: str = Field(max_length=200)
    reason: Note = Field(default="", description='Why; "" when only making room for others.')
    skip: bool = Field(default=False, description="True: do not offer it to this annotator again.")


class Leave(Message):
    """A page is going: give back all it holds, and lease nothing more to it."""

    tab: Tab
    keep: list[Annotated[int, Field(ge=1, le=2**63 - 1)]] = Field(
        max_length=1_000, description="Assignments whose answers are still being sent."
    )


class Renewal(Message):
    """The lease after a heartbeat."""

    expires_at: float
