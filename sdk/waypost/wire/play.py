"""Defines the messages of `WS /queries/{id}/play`, the WebSocket on which a person plays a demonstration."""

from typing import Annotated, Literal

from pydantic import Field

from waypost.wire.answers import DemoSegment
from waypost.wire.frames import Pictured
from waypost.wire.words import Json, Message

__all__ = [
    "PlayHello",
    "PlayMoves",
    "PlayOffer",
    "PlayStage",
    "PlayStates",
    "PlayTake",
]


class PlayTake(Message):
    """The annotator's first message. It proves that the annotator holds the query's live assignment."""

    type: Literal["take"]
    assignment: int = Field(ge=1, le=2**63 - 1, description="The id of the assignment.")
    token: str = Field(max_length=200, description="The token of the assignment.")


class PlayOffer(Message):
    """The learner's first message. It offers the environment of the query."""

    type: Literal["offer"]


PlayHello = Annotated[PlayTake | PlayOffer, Field(discriminator="type")]


class PlayMoves(Message):
    """The whole demonstration so far, sent by the annotator to the learner.

    It is sent as a whole, so neither side has to remember earlier messages. The learner compares it with the last one.
    """

    type: Literal["moves"]
    number: int = Field(ge=0, le=2**53 - 1, description="The number of this message; the reply repeats it.")
    segments: list[DemoSegment] = Field(
        max_length=10_000, description="The segments as in the answer; empty before the first action."
    )
    known: int = Field(
        ge=0, le=10_001, description="The number of states that the annotator already has; the reply omits them."
    )


class PlayStates(Pictured):
    """The states after the annotator's actions, sent by the learner."""

    type: Literal["states"]
    number: int = Field(ge=0, le=2**53 - 1, description="The number of the message that this one replies to.")
    known: int = Field(ge=0, le=10_001, description="The number of states before `states`.")
    states: list[Json] = Field(
        max_length=10_001,
        description="The following states up to the end of the episode, as JSON views of the domain.",
    )
    ended: bool = Field(description="Whether the episode ended in the last state; later actions have no state.")
    succeeded: bool = Field(description="Whether the whole task is accomplished in the last state.")


class PlayStage(Message):
    """Sent by the server to the annotator: whether a learner offers the environment now."""

    type: Literal["stage"]
    present: bool = Field(description="Whether a learner is connected.")
