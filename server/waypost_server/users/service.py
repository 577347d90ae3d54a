"""Users and their secrets: tokens, sessions and one-time login codes, of which only hashes are kept."""

import hashlib
import secrets
import statistics
from dataclasses import dataclass
from typing import Any, Literal

from sqlalchemy import Row, Select, bindparam, func, insert, select, update
from sqlalchemy.exc import IntegrityError

from waypost import wire
from waypost.prices import to_units
from waypost_server import errors
from waypost_server.db.engine import Tx
from waypost_server.db.tables import answers, credentials, queries, users

CredentialKind = Literal["api", "session", "login"]

ANSWERING: frozenset[wire.Role] = frozenset({"admin", "annotator"})
DAY = 86_400.0
NOTED_SECONDS = 60.0  # how precisely it is known when a credential was last used
RECENT = 1_000  # answers the median is taken over


@dataclass(frozen=True)
class Found:
    """Whose secret it was."""

    user: int
    name: str
    role: wire.Role
    credential: int
    is_noteworthy: bool  # when it was last used is to be noted anew


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


USERS: Select[Any] = select(
    users,
    select(func.max(credentials.c.last_used_at))
    .where(credentials.c.user_id == users.c.id)
    .correlate(users)
    .scalar_subquery()
    .label("last_used_at"),
)


def _of_row(row: Row[Any]) -> wire.User:
    seen = row._mapping.get("last_used_at")
    return wire.User(
        id=row.id,
        name=row.name,
        role=row.role,
        created_at=row.created_at,
        deactivated_at=row.deactivated_at,
        last_used_at=seen,
    )


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


def an_administrator(tx: Tx) -> wire.User:
    """Return the user `admin` if they are one, else the first administrator there is; created if there is none."""
    rows = tx.conn.execute(
        select(users).where(users.c.role == "admin", users.c.deactivated_at.is_(None)).order_by(users.c.id)
    ).all()
    if not rows:
        return ensure_user(tx, "admin", "admin")
    return _of_row(next((row for row in rows if row.name == "admin"), rows[0]))


def named(tx: Tx, name: str) -> wire.User:
    """Return the user of a name.

    Raises:
        NotFound: if there is none.
    """
    row = tx.conn.execute(select(users).where(users.c.name == name)).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no user named {name!r}; `waypost user add` creates one.")
    return _of_row(row)


def view(tx: Tx, user: int) -> wire.User:
    """Return a user.

    Raises:
        NotFound: if there is none.
    """
    row = tx.conn.execute(USERS.where(users.c.id == user)).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no user {user}.")
    return _of_row(row)


def everyone(tx: Tx) -> wire.UserList:
    """List all users."""
    rows = tx.conn.execute(USERS.order_by(users.c.id)).all()
    return wire.UserList(users=[_of_row(row) for row in rows])


def _issue(tx: Tx, user: int, kind: CredentialKind, label: str, seconds: float | None) -> Secret:
    owner = view(tx, user)
    if owner.deactivated_at is not None:
        raise errors.NotActive(f"{owner.name} is deactivated; reactivate them first.")
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
    """Use a login code up and return a session; nothing if the code is not good (`why_not` says why)."""
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


def why_not(tx: Tx, code: str) -> errors.Unauthenticated:
    """Return why a login code is not good, and what to do."""
    known = (
        select(credentials.c.revoked_at, users.c.deactivated_at)
        .join(users, users.c.id == credentials.c.user_id)
        .where(credentials.c.hash == hashed(code), credentials.c.kind == "login")
    )
    row = tx.conn.execute(known).one_or_none()
    if row is None:
        return errors.Unauthenticated(
            "There is no such login link; open it as it was given to you, to the last letter."
        )
    if row.deactivated_at is not None:
        return errors.Deactivated("This account is deactivated; ask an administrator of this server.")
    if row.revoked_at is not None:
        return errors.LoginUsed("This login link was used before, and each works once; ask for a new one.")
    return errors.LoginExpired("This login link is too old; ask for a new one.")


_STANDING = (
    select(users.c.role, users.c.deactivated_at).where(users.c.id == bindparam("user")).with_for_update(read=True)
)
_FIND = (
    select(users.c.id, users.c.name, users.c.role, credentials.c.id.label("credential"))
    .add_columns(credentials.c.expires_at, credentials.c.last_used_at)
    .join(credentials, credentials.c.user_id == users.c.id)
    .where(
        credentials.c.hash == bindparam("hash"),
        credentials.c.kind == bindparam("kind"),
        credentials.c.revoked_at.is_(None),
        users.c.deactivated_at.is_(None),
    )
)


def find(tx: Tx, secret_hash: str, kind: CredentialKind) -> Found | None:
    """Return whose secret has this hash, if it is neither expired nor revoked."""
    row = tx.conn.execute(_FIND, {"hash": secret_hash, "kind": kind}).one_or_none()
    if row is None or (row.expires_at is not None and row.expires_at <= tx.now):
        return None
    unused = row.last_used_at is None or row.last_used_at <= tx.now - NOTED_SECONDS
    return Found(row.id, row.name, row.role, row.credential, unused)


def refuse_gone(tx: Tx, user: int) -> None:
    """Refuse work to somebody who was deactivated, or lost the role for it, while they waited.

    Until the work is given, none of their pages can say that it goes (`departures`).

    Raises:
        Unauthenticated, Forbidden: accordingly.
    """
    row = tx.conn.execute(_STANDING, {"user": user}).one()
    if row.deactivated_at is not None:
        raise errors.Unauthenticated("This account was deactivated.")
    if row.role not in ANSWERING:
        raise errors.Forbidden(f"The role {row.role} does not answer queries.")


def note_use(tx: Tx, credential: int) -> None:
    """Note that a credential is used now."""
    tx.conn.execute(update(credentials).where(credentials.c.id == credential).values(last_used_at=tx.now))


def revoke(tx: Tx, credential: int) -> None:
    """Make a credential useless from now on."""
    tx.conn.execute(
        update(credentials)
        .where(credentials.c.id == credential, credentials.c.revoked_at.is_(None))
        .values(revoked_at=tx.now)
    )


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
