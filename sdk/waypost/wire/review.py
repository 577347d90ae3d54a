"""Defines the messages with which answers are reviewed."""

from pydantic import Field

from waypost.wire.gold import Mark
from waypost.wire.watching import QueryRow
from waypost.wire.words import Message

__all__ = ["ReviewPage", "ReviewRow"]


class ReviewRow(Message):
    """An answered query under review, sent by the server, with what its answer is compared with."""

    query: QueryRow
    differs: bool | None = Field(
        description="Whether the answer differs from the learner's suggestion; null if the query had none."
    )
    gold: list[Mark] | None = Field(
        description="For an answer to a gold query: its labels beside the correct ones; otherwise null."
    )


class ReviewPage(Message):
    """One page of answers under review, newest query first, sent by the server."""

    rows: list[ReviewRow]
    total: int = Field(description="The number of answers on all pages.")
    newest: int | None = Field(description="The id of the newest query on all pages.")
    oldest: int | None = Field(description="The id of the oldest query on all pages.")
