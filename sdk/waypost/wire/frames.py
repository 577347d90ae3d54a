"""Defines the messages about frames: pictures of states, for domains without a renderer in the web app."""

from pydantic import Field

from waypost.wire.words import FrameHash, Message

__all__ = [
    "Frame",
    "FrameHashes",
    "FrameUpload",
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
