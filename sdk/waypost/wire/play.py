"""Playing a demonstration: the messages of `WS /queries/{id}/play`."""

from typing import Annotated, Literal

from pydantic import Field, JsonValue

from waypost.wire.answers import DemoSegment
from waypost.wire.words import FrameHash, Message

__all__ = [
    "PlayHello",
    "PlayMoves",
    "PlayOffer",
    "PlayStage",
    "PlayStates",
    "PlayTake",
]


class PlayTake(Message):
    """An annotator's first message: shows that it holds the query's live assignment."""

    type: Literal["take"]
    assignment: int = Field(ge=1, le=2**63 - 1)
    token: str = Field(max_length=200)


class PlayOffer(Message):
    """A learner's first message: it offers the query's environment."""

    type: Literal["offer"]


PlayHello = Annotated[PlayTake | PlayOffer, Field(discriminator="type")]


class PlayMoves(Message):
    """Annotator to learner: the whole demonstration as it stands, so that neither end must remember the other's past.

    What changed since the last message, and in which direction, is for the learner to see.
    """

    type: Literal["moves"]
    number: int = Field(ge=0, le=2**53 - 1, description="Counts these messages; the reply repeats it.")
    segments: list[DemoSegment] = Field(max_length=10_000, description="As in the answer; none before the first move.")
    known: int = Field(ge=0, le=10_001, description="States s_1 .. s_known need not be sent, the annotator has them.")


class PlayStates(Message):
    """Learner to annotator: what the environment made of the moves."""

    type: Literal["states"]
    number: int = Field(ge=0, le=2**53 - 1)
    known: int = Field(ge=0, le=10_001, description="How many states come before these.")
    states: list[JsonValue] = Field(
        max_length=10_001,
        description="The states after those, in the domain's JSON view, up to the episode's end.",
    )
    frames: list[FrameHash] = Field(
        default_factory=list,
        max_length=10_001,
        description="A picture of each of these, uploaded before; none where the page draws the states itself.",
    )
    ended: bool = Field(description="Whether the episode ended in the last state; actions after it have no state.")
    succeeded: bool = Field(description="Whether the whole task is accomplished in the last state.")


class PlayStage(Message):
    """Server to annotator: whether a learner offers the environment just now."""

    type: Literal["stage"]
    present: bool
