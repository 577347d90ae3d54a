"""Defines the audit log: who did what with access to the server, as rows that are chained by hashes."""

from typing import Literal

from pydantic import Field, JsonValue

from waypost.wire.words import Message

__all__ = ["AuditAction", "AuditPage", "AuditRow"]

AuditAction = Literal[
    "login",
    "login.refused",
    "logout",
    "link.created",
    "permission.refused",
    "run.deleted",
    "token.created",
    "token.revoked",
    "user.created",
    "user.identified",
    "user.role_changed",
    "user.deactivated",
    "user.reactivated",
    "user.erased",
]


class AuditRow(Message):
    """One row of the audit log, sent by the server. The SHA-256 is of its other fields as canonical JSON."""

    number: int = Field(description="1 for the first row, then one more for each row.")
    at: str = Field(description="When it happened, in UTC: 2026-01-31T12:00:00.000000Z.")
    user: int | None = Field(description="The id of the user who acted; null for all other actors.")
    actor: str = Field(
        description="The name of the user who acted; `nobody` without a valid credential; `command line` "
        "for a command; `identity provider` for what a sign-in there changes."
    )
    address: str | None = Field(description="The address of the client as the server saw it; null for a command.")
    action: AuditAction
    object: str | None = Field(description="The user, token or run that it is about: `user/7`; null if there is none.")
    details: dict[str, JsonValue] = Field(description="More about the action; never a secret.")
    previous: str = Field(description="The hash of the row before; 64 zeros in the first row.")
    hash: str = Field(description="The SHA-256 of the other fields as JSON: keys sorted, no spaces, ASCII only.")


class AuditPage(Message):
    """One page of the audit log, newest first, sent by the server."""

    rows: list[AuditRow]
    total: int = Field(description="The number of rows on all pages.")
    newest: int | None = Field(description="The number of the newest row on all pages.")
    oldest: int | None = Field(description="The number of the oldest row on all pages.")
    head: str | None = Field(
        description="NUMBER:HASH of the newest row of all, whatever the filter. Noted elsewhere, "
        "`waypost check --audit-head` finds with it whether the end of the log was cut off."
    )
