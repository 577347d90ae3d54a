"""Defines the messages about users: accounts, tokens, sessions, login links and statistics of annotators."""

from pydantic import Field

from waypost.wire.words import Kind, Message, Name, Note, Role, Scope

__all__ = [
    "Login",
    "LoginLink",
    "LoginLinkCreate",
    "Me",
    "NewToken",
    "Numbers",
    "NumbersList",
    "NumbersOfKind",
    "Session",
    "SessionList",
    "SignInBegun",
    "SignInOffer",
    "SignInReply",
    "Tally",
    "Token",
    "TokenCreate",
    "TokenList",
    "User",
    "UserCreate",
    "UserErasure",
    "UserList",
    "UserPatch",
]


class Login(Message):
    """The one-time code of a login link, sent by a browser."""

    code: str = Field(min_length=1, max_length=200)


class SignInOffer(Message):
    """The OpenID provider at which people may sign in, sent by the server."""

    provider: str | None = Field(description="What the provider is called; null if there is none.")


class SignInBegun(Message):
    """A sign-in that has begun, sent by the server."""

    url: str = Field(description="The address at the OpenID provider that the browser opens next.")


class SignInReply(Message):
    """The reply with which the OpenID provider sent a browser back, sent by that browser."""

    state: str = Field(min_length=1, max_length=200, description="The `state` of the address.")
    code: str | None = Field(
        default=None,
        min_length=1,
        max_length=4_000,
        description="The `code` of the address; null if the provider sent an error instead.",
    )
    issuer: str | None = Field(default=None, max_length=2_000, description="The `iss` of the address, if it has one.")


class Me(Message):
    """The calling user, sent by the server."""

    id: int
    name: str
    role: Role
    answers: int = Field(description="The number of the user's answers that count.")
    answers_today: int = Field(description="The number of these answers since midnight UTC.")
    active_seconds_today: float = Field(
        description="The user's working time for the answers since midnight UTC, without idle time, in seconds."
    )
    median_seconds: float | None = Field(
        description="The median working time of the last 1,000 of these answers, without idle time, in seconds."
    )
    units: float = Field(description="The cost of these answers in all runs, in units.")
    held: int = Field(description="The number of queries that the user holds, in every browser and program.")
    held_seconds: float | None = Field(
        description="In how many seconds the first of these leases ends, unless it is renewed; null if there is none."
    )
    held_by_others: int = Field(description="The number of queries that other users hold.")


class UserCreate(Message):
    """A new user (a person or a program), sent by an administrator."""

    name: Name
    role: Role


class UserPatch(Message):
    """Changes of a user, sent by an administrator. Absent fields do not change."""

    role: Role | None = None
    active: bool | None = Field(
        default=None,
        description="False deactivates the user: sessions, tokens, login links and leases end; answers remain.",
    )


class User(Message):
    """A user without secrets, sent by the server."""

    id: int
    name: str
    role: Role
    created_at: float = Field(description="When the user was created, in seconds since the epoch.")
    deactivated_at: float | None = Field(
        description="When the user was deactivated, in seconds since the epoch; null for an active user."
    )
    erased_at: float | None = Field(
        description="When the user's personal data were deleted, in seconds since the epoch; null if they were not."
    )
    last_used_at: float | None = Field(
        description="When the user last called, in seconds since the epoch, to the minute; null if never."
    )
    frame_bytes: int = Field(description="The size of the pictures that the user has uploaded.")


class UserList(Message):
    """All users, sent by the server."""

    users: list[User]


class UserErasure(Message):
    """What the deletion of a user's personal data deleted, or would delete beside the name, sent by the server."""

    user: int = Field(description="The id of the user.")
    dry_run: bool = Field(description="Whether nothing was deleted, because the request only asked.")
    credentials: int = Field(description="Tokens, sessions and login links, with their labels and last uses.")
    comments: int = Field(description="Comments that the user wrote.")
    reasons: int = Field(description="Assignments with a reason that the user gave, or the name of a browser tab.")
    traces: int = Field(description="Notes of when the user was last at work, and in which tabs.")
    kept_answers: int = Field(description="Answers that count; they stay, without a name.")
    kept_units: float = Field(description="The cost of these answers, in units.")


class TokenCreate(Message):
    """A request for an API token. Only administrators may request tokens of other users."""

    user: int | None = Field(
        default=None, ge=1, le=2**63 - 1, description="The id of the token's user; null for the caller."
    )
    label: Note = ""
    days: float | None = Field(
        default=None,
        gt=0,
        le=3_650,
        allow_inf_nan=False,
        description="For how many days the token is valid; null until it is revoked.",
    )
    scopes: list[Scope] | None = Field(
        default=None,
        min_length=1,
        max_length=4,
        description="What the token may be used for, as far as its user may do it; every scope includes `read`. Null: "
        "everything.",
    )


class NewToken(Message):
    """A new API token, sent by the server only once. The server stores only its hash."""

    id: int
    token: str


class Token(Message):
    """A valid API token without its secret, sent by the server."""

    id: int
    label: str
    created_at: float = Field(description="When the token was created, in seconds since the epoch.")
    last_used_at: float | None = Field(
        description="When the token was last used, in seconds since the epoch, to the minute; null if never."
    )
    expires_at: float | None = Field(description="When it expires, in seconds since the epoch; null if it does not.")
    scopes: list[Scope] | None = Field(description="What it may be used for; null for everything that the user may do.")


class TokenList(Message):
    """A user's valid tokens, oldest first, sent by the server."""

    tokens: list[Token]


class Session(Message):
    """A browser that is signed in, sent by the server."""

    id: int
    created_at: float = Field(description="When the user signed in, in seconds since the epoch.")
    last_used_at: float | None = Field(
        description="When the session was last used, in seconds since the epoch, to the minute."
    )
    expires_at: float = Field(description="When the session expires, in seconds since the epoch.")
    current: bool = Field(description="Whether this is the session of the calling browser.")


class SessionList(Message):
    """The caller's sessions, oldest first, sent by the server."""

    sessions: list[Session]


class LoginLinkCreate(Message):
    """A request for a login link, sent by an administrator."""

    seconds: float | None = Field(
        default=None,
        ge=60,
        le=7 * 86_400,
        allow_inf_nan=False,
        description="How long the link is valid, in seconds; null for the server's default.",
    )


class LoginLink(Message):
    """The code of a new one-time login link, sent by the server only once."""

    code: str
    expires_at: float = Field(description="When the link expires, in seconds since the epoch.")


class Tally(Message):
    """The number and the cost of an annotator's answers, including gold queries, which no run pays for."""

    answers: int = Field(description="The number of answers.")
    units: float = Field(description="The cost of the answers, in units.")


class NumbersOfKind(Message):
    """Statistics of an annotator's answers to one kind of query."""

    kind: Kind
    total: Tally
    median_seconds: float = Field(description="The median time from lease to answer, in seconds.")
    gold: int = Field(description="The number of answers to gold queries.")
    gold_right: int = Field(description="The number of answers to gold queries with only correct labels.")
    agreement: float | None = Field(
        description="The share of correct labels in answers to gold queries, 0 to 1; null if there are none."
    )


class Numbers(Message):
    """Statistics of an annotator over all runs, sent by the server. Days are UTC days."""

    user: int = Field(description="The id of the user.")
    name: str = Field(description="The name of the user.")
    total: Tally
    today: Tally
    week: Tally = Field(description="Today and the six days before.")
    gold: int = Field(
        description="The number of answered gold queries. In the caller's own numbers, it grows in steps of ten."
    )
    agreement: float | None = Field(
        description="The share of correct labels in first answers to gold queries, 0 to 1; null if there are none."
    )
    by_kind: list[NumbersOfKind] = Field(description="The statistics for each kind of query that they answered.")


class NumbersList(Message):
    """The statistics of all annotators who ever answered, by name, sent by the server."""

    annotators: list[Numbers]
