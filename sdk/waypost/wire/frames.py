"""Frames: pictures of states, where the page has no renderer."""

from pydantic import Field

from waypost.wire.words import FrameHash, Message

__all__ = [
    "Frame",
    "FrameHashes",
    "FrameUpload",
]


class Frame(Message):
    """A PNG and the hash that it goes by."""

    hash: FrameHash
    png: str = Field(min_length=1, max_length=2**23, pattern=r"^[A-Za-z0-9+/]+=*$", description="The file in base64.")


class FrameUpload(Message):
    """Frames to keep. Uploading one again changes nothing."""

    frames: list[Frame] = Field(min_length=1, max_length=1_000)


class FrameHashes(Message):
    """Frames by their hashes."""

    hashes: list[FrameHash] = Field(max_length=10_000)
