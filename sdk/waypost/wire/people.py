"""People, their tokens, sessions and numbers."""

from pydantic import Field

from waypost.wire.words import Kind, Message, Name, Note, Role

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
    "Tally",
    "Token",
    "TokenCreate",
    "TokenList",
    "User",
    "UserCreate",
    "UserList",
    "UserPatch",
]


class Login(Message):
    """A one-time code out of a login link."""

    code: str = Field(min_length=1, max_length=200)


class Me(Message):
    """Who is calling."""

    id: int
    name: str
    role: Role
    answers: int = Field(description="Answers that counted.")
    answers_today: int
    median_seconds: float | None
    units: float = Field(description="What these answers cost, in all runs.")


class UserCreate(Message):
    """A person or a program that may call."""

    name: Name
    role: Role


class UserPatch(Message):
    """What may change in a user; absent fields stay as they are."""

    role: Role | None = None
    active: bool | None = Field(
        default=None,
        description="False ends their sessions, tokens, links and leases; their answers stay.",
    )


class User(Message):
    """A user, without secrets."""

    id: int
    name: str
    role: Role
    created_at: float
    deactivated_at: float | None = Field(description="Since when they may not call; null while they may.")
    last_used_at: float | None = Field(description="When they last called, to the minute.")


class UserList(Message):
    """All users."""

    users: list[User]


class TokenCreate(Message):
    """An API token for the caller, or, made by an administrator, for any user."""

    user: int | None = Field(default=None, ge=1, le=2**63 - 1, description="Whose; null for the caller's own.")
    label: Note = ""


class NewToken(Message):
    """A token, shown once; the server keeps only its hash."""

    id: int
    token: str


class Token(Message):
    """A token that is good, without its secret."""

    id: int
    label: str
    created_at: float
    last_used_at: float | None = Field(description="To the minute; null if never.")


class TokenList(Message):
    """A user's tokens that are good, oldest first."""

    tokens: list[Token]


class Session(Message):
    """A browser that is signed in."""

    id: int
    created_at: float
    last_used_at: float | None
    expires_at: float
    current: bool = Field(description="Whether this is the session that asks.")


class SessionList(Message):
    """The caller's sessions, oldest first."""

    sessions: list[Session]


class LoginLinkCreate(Message):
    """How long a new login link is to be good."""

    seconds: float | None = Field(
        default=None, ge=60, le=7 * 86_400, allow_inf_nan=False, description="Null for the server's usual time."
    )


class LoginLink(Message):
    """A one-time login link's code, shown once."""

    code: str
    expires_at: float


class Tally(Message):
    """What answers come to. Gold queries are among them: they are work too, though no run pays for them."""

    answers: int
    units: float


class NumbersOfKind(Message):
    """An annotator's answers to one kind of query."""

    kind: Kind
    total: Tally
    median_seconds: float
    gold: int = Field(description="How many of them were to gold queries.")
    gold_right: int = Field(description="How many of those were right in every label.")
    agreement: float | None = Field(description="The share of right labels among those of gold queries.")


class Numbers(Message):
    """An annotator's own numbers, over all runs. Days are those of UTC."""

    user: int
    name: str
    total: Tally
    today: Tally
    week: Tally = Field(description="Today and the six days before.")
    gold: int
    agreement: float | None
    by_kind: list[NumbersOfKind] = Field(description="The kinds they have answered.")


class NumbersList(Message):
    """Everybody's numbers who ever answered, by name."""

    annotators: list[Numbers]
