"""The health of the server, and what is said of a refusal."""

from typing import Literal

from pydantic import BaseModel, Field, JsonValue

from waypost.wire.words import Message

__all__ = [
    "Health",
    "Problem",
]


class Health(Message):
    """Alive, or ready to work."""

    status: Literal["ok"]
    version: str


class Problem(BaseModel):
    """RFC 9457: what was wrong and what to do about it."""

    type: str = Field(description="A stable name of the problem: `/problems/<name>`.")
    title: str
    status: int
    detail: str
    instance: str | None = None
    errors: list[dict[str, JsonValue]] | None = Field(default=None, description="For 422: each field at fault.")
