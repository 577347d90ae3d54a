"""Defines the messages about frames, the pictures of states, and about landmarks, the places of choices in them."""

from typing import Annotated

from pydantic import Field, model_validator

from waypost.wire.words import FrameHash, Message, Name, Share

__all__ = [
    "Box",
    "Frame",
    "FrameHashes",
    "FrameUpload",
    "Landmarks",
    "Pictured",
]


class Frame(Message):
    """A picture as a PNG file, identified by its hash."""

    hash: FrameHash
    png: str = Field(
        min_length=1, max_length=2**23, pattern=r"^[A-Za-z0-9+/]+=*$", description="The PNG file in base64."
    )


class FrameUpload(Message):
    """Frames that a learner uploads. Uploading a frame again changes nothing."""

    frames: list[Frame] = Field(min_length=1, max_length=1_000)


class FrameHashes(Message):
    """Hashes of frames, sent by a learner to ask which frames are missing, and by the server as the reply."""

    hashes: list[FrameHash] = Field(max_length=10_000)


class Box(Message):
    """A box in a picture. Its sides are shares of the picture's width and height, from the upper left corner."""

    left: Share
    top: Share
    right: Share
    bottom: Share

    @model_validator(mode="after")
    def _is_not_empty(self) -> "Box":
        if self.left >= self.right or self.top >= self.bottom:
            raise ValueError("a box needs left < right and top < bottom")
        return self


Landmarks = Annotated[list[dict[Name, Box]], Field(max_length=10_001)]
"""Boxes in the pictures of states by subgoal, or by action: one entry per state, or one for all states."""


class Pictured(Message):
    """The base of messages with states: what people see of these states. It is never part of a query's content."""

    frames: list[FrameHash] = Field(
        default_factory=list,
        max_length=10_001,
        description="One uploaded picture per state; empty if the web app draws the states itself. Pictures are not "
        "part of the query's content: the same query with other pictures is the same query.",
    )
    landmarks: Landmarks = Field(
        default_factory=list,
        description="Where subgoals are in the pictures: boxes by subgoal, one entry per state, or one for all states; "
        "empty if that is not known. Landmarks are not part of the query's content.",
    )
    action_landmarks: Landmarks = Field(
        default_factory=list,
        description="Where actions lead in the pictures: boxes by action, one entry per state, or one for all states; "
        "empty if that is not known. They are not part of the query's content either.",
    )
