"""Defines the messages about the server's health and about errors."""

from typing import Literal

from pydantic import BaseModel, Field, JsonValue

from waypost.wire.words import Message, Role

__all__ = [
    "Health",
    "Problem",
]


class Health(Message):
    """The server's reply when it is alive or ready."""

    status: Literal["ok"]
    version: str = Field(description="The version of Waypost.")


class Problem(BaseModel):
    """The server's reply to every request that it refuses, in the format of RFC 9457."""

    type: str = Field(description="The stable name of the problem: `/problems/<name>`.")
    title: str = Field(description="The problem in a few words, the same for every occurrence.")
    status: int = Field(description="The HTTP status code.")
    detail: str = Field(description="What was wrong with this request, and what to do.")
    instance: str | None = Field(default=None, description="The path of the request.")
    errors: list[dict[str, JsonValue]] | None = Field(default=None, description="For status 422: each invalid field.")
    roles: list[Role] | None = Field(default=None, description="For `forbidden`: the roles that may do this.")
    owner: str | None = Field(default=None, description="For `forbidden`: the name of the run's owner, who may.")
    spent: float | None = Field(default=None, description="For `budget-too-low`: the units spent on answered queries.")
    reserved: float | None = Field(
        default=None, description="For `budget-too-low`: the units reserved for unanswered queries."
    )
    request_id: str | None = Field(
        default=None, description="For status 5xx: the id of the request in the server's log."
    )
