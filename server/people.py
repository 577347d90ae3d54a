"""Users and their secrets: tokens, sessions and one-time login codes, of which only hashes are kept."""

import hashlib
import secrets
import statistics
from dataclasses import dataclass
from typing import Any, Literal

from sqlalchemy import Row, bindparam, func, insert, select, update
from sqlalchemy.exc import IntegrityError

from server import errors, wire
from server.database import Tx
from server.money import to_units
from server.tables import answers, credentials, queries, users

CredentialKind = Literal["api", "session", "login"]

DAY = 86_400.0
RECENT = 1_000  # answers the median is taken over


@dataclass(frozen=True)
class Found:
    """Whose secret it was."""

    user: int
    name: str
    role: wire.Role
    credential: int


@dataclass(frozen=True)
class Secret:
    """A new secret, in clear this once."""

    id: int
    user: int
    secret: str
    expires_at: float | None


def hashed(secret: str) -> str:
    """Return what is kept of a secret: 256 random bits need no slow hash."""
    return hashlib.sha256(secret.encode("utf-8", "surrogateescape")).hexdigest()


def _of_row(row: Row[Any]) -> wire.User:
    return wire.User(id=row.id, name=row.name, role=row.role, created_at=row.created_at)


def create_user(tx: Tx, name: str, role: wire.Role) -> wire.User:
    """Create a user."""
    try:
        with tx.conn.begin_nested():
            row = tx.conn.execute(insert(users).values(name=name, role=role, created_at=tx.now).returning(users)).one()
    except IntegrityError:
        raise errors.NameTaken(f"There is a user named {name!r}; choose another name.") from None
    return _of_row(row)


def ensure_user(tx: Tx, name: str, role: wire.Role) -> wire.User:
    """Return the user of a name, created if there is none."""
    row = tx.conn.execute(select(users).where(users.c.name == name)).one_or_none()
    return create_user(tx, name, role) if row is None else _of_row(row)


def named(tx: Tx, name: str) -> wire.User:
    """Return the user of a name.

    Raises:
        NotFound: if there is none.
    """
    row = tx.conn.execute(select(users).where(users.c.name == name)).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no user named {name!r}; `waypost user add` creates one.")
    return _of_row(row)


def everyone(tx: Tx) -> wire.UserList:
    """List all users."""
    rows = tx.conn.execute(select(users).order_by(users.c.id)).all()
    return wire.UserList(users=[_of_row(row) for row in rows])


def _issue(tx: Tx, user: int, kind: CredentialKind, label: str, seconds: float | None) -> Secret:
    if tx.conn.execute(select(users.c.id).where(users.c.id == user)).one_or_none() is None:
        raise errors.NotFound(f"There is no user {user}.")
    secret = f"wp_{secrets.token_urlsafe(32)}"
    expires_at = None if seconds is None else tx.now + seconds
    row = tx.conn.execute(
        insert(credentials)
        .values(user_id=user, kind=kind, hash=hashed(secret), label=label, created_at=tx.now, expires_at=expires_at)
        .returning(credentials.c.id)
    ).one()
    return Secret(row.id, user, secret, expires_at)


def create_token(tx: Tx, user: int, label: str) -> wire.NewToken:
    """Create an API token."""
    issued = _issue(tx, user, "api", label, None)
    return wire.NewToken(id=issued.id, token=issued.secret)


def create_login(tx: Tx, user: int, seconds: float) -> wire.LoginLink:
    """Create a one-time login code that is good for so long."""
    issued = _issue(tx, user, "login", "", seconds)
    return wire.LoginLink(code=issued.secret, expires_at=issued.expires_at or 0.0)


def redeem(tx: Tx, code: str, seconds: float) -> Secret | None:
    """Use a login code up and return a session; nothing if the code is not good."""
    used = tx.conn.execute(
        update(credentials)
        .where(
            credentials.c.hash == hashed(code),
            credentials.c.kind == "login",
            credentials.c.revoked_at.is_(None),
            credentials.c.expires_at > tx.now,
        )
        .values(revoked_at=tx.now)
        .returning(credentials.c.user_id)
    ).one_or_none()
    return None if used is None else _issue(tx, used.user_id, "session", "", seconds)


_FIND = (
    select(users.c.id, users.c.name, users.c.role, credentials.c.id.label("credential"), credentials.c.expires_at)
    .join(credentials, credentials.c.user_id == users.c.id)
    .where(
        credentials.c.hash == bindparam("hash"),
        credentials.c.kind == bindparam("kind"),
        credentials.c.revoked_at.is_(None),
    )
)


def find(tx: Tx, secret_hash: str, kind: CredentialKind) -> Found | None:
    """Return whose secret has this hash, if it is neither expired nor revoked."""
    row = tx.conn.execute(_FIND, {"hash": secret_hash, "kind": kind}).one_or_none()
    if row is None or (row.expires_at is not None and row.expires_at <= tx.now):
        return None
    return Found(row.id, row.name, row.role, row.credential)


def revoke(tx: Tx, credential: int) -> None:
    """Make a credential useless from now on."""
    tx.conn.execute(
        update(credentials)
        .where(credentials.c.id == credential, credentials.c.revoked_at.is_(None))
        .values(revoked_at=tx.now)
    )


def revoke_token(tx: Tx, token: int) -> None:
    """Revoke an API token.

    Raises:
        NotFound: if there is no such token.
    """
    known = select(credentials.c.id).where(credentials.c.id == token, credentials.c.kind == "api")
    if tx.conn.execute(known).one_or_none() is None:
        raise errors.NotFound(f"There is no token {token}.")
    revoke(tx, token)


def me(tx: Tx, user: int) -> wire.Me:
    """Return a user and what their answers come to."""
    who = tx.conn.execute(select(users).where(users.c.id == user)).one()
    counting = select(answers).join(queries, queries.c.answer_id == answers.c.id).where(answers.c.user_id == user)
    counted = counting.subquery()
    total = tx.conn.execute(
        select(
            func.count(),
            func.coalesce(func.sum(counted.c.units), 0),
            func.count().filter(counted.c.created_at >= tx.now - tx.now % DAY),
        ).select_from(counted)
    ).one()
    newest = select(counted.c.active_seconds).order_by(counted.c.id.desc()).limit(RECENT)
    recent = tx.conn.execute(newest).scalars().all()
    return wire.Me(
        id=who.id,
        name=who.name,
        role=who.role,
        answers=total[0],
        answers_today=total[2],
        median_seconds=statistics.median(recent) if recent else None,
        units=to_units(int(total[1])),
    )
