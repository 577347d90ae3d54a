"""Defines the messages about reviewers' comments, and about answers that were sent back with one."""

from typing import Annotated

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.words import Kind, Message

__all__ = ["Comment", "CommentPost", "Returned", "ReturnedList", "SendBack"]

CommentText = Annotated[
    str, Field(max_length=2_000, pattern=r"^[^\x00]*[^\x00\s][^\x00]*$", description="The comment; not only spaces.")
]


class CommentPost(Message):
    """A comment on a query, sent by a reviewer. Comments never change."""

    text: CommentText


class SendBack(CommentPost):
    """A request to send an answer back, with the comment that says why; sent by a reviewer."""

    answer: int = Field(ge=1, le=2**63 - 1, description="The id of the answer that the reviewer has seen.")


class Comment(Message):
    """A reviewer's comment on a query, sent by the server."""

    id: int
    by: str = Field(description="The name of the reviewer.")
    at: float = Field(description="When it was written, in seconds since the epoch.")
    text: str
    answer: int | None = Field(description="The id of the answer that was sent back with it; null for a mere comment.")


class Returned(Message):
    """An answer of the caller that a reviewer has sent back, sent by the server."""

    query: int = Field(description="The id of the query.")
    run: str = Field(description="The id of the run.")
    run_name: str = Field(description="The name of the run.")
    kind: Kind
    episode: int = Field(description="The number of the episode in the run, from 0.")
    question: str = Field(description="The query in words.")
    answer: Answer = Field(description="The answer that was sent back.")
    answered_at: float = Field(description="When the answer was given, in seconds since the epoch.")
    comment: Comment


class ReturnedList(Message):
    """The answers of the caller that were sent back, newest first; at most 100."""

    returned: list[Returned]
