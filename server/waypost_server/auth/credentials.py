"""Credentials: API tokens, browser sessions and login codes. The store keeps only a hash of each secret."""

import hashlib
import secrets
from dataclasses import dataclass
from typing import Any, Literal

from sqlalchemy import Select, bindparam, insert, select, update

from waypost.wire import Role
from waypost_server import errors
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import credentials, users
from waypost_server.db.transaction import Tx

CredentialKind = Literal["api", "session", "login"]

LAST_USE_SECONDS = 60.0  # the precision of a credential's `last_used_at`


@dataclass(frozen=True)
class Owner:
    """The user behind a valid credential."""

    user: int
    name: str
    role: Role
    credential: int
    last_use_is_stale: bool  # whether `last_used_at` should be updated


@dataclass(frozen=True)
class Secret:
    """A new credential with its secret in clear text. The store never has the clear text."""

    id: int
    user: int
    secret: str
    expires_at: float | None


def hash_of(secret: str) -> str:
    """Return the hash that is stored. A secret has 256 random bits, so a fast hash is enough."""
    return hashlib.sha256(secret.encode("utf-8", "surrogateescape")).hexdigest()


def issue(tx: Tx, user: int, kind: CredentialKind, label: str = "", seconds: float | None = None) -> Secret:
    """Create a credential that is valid for `seconds`, or until it is revoked.

    Raises:
        NotFound: there is no such user.
        NotActive: the user is deactivated.
    """
    owner = tx.conn.execute(select(users.c.name, users.c.deactivated_at).where(users.c.id == user)).one_or_none()
    if owner is None:
        raise errors.NotFound(f"There is no user {user}.")
    if owner.deactivated_at is not None:
        raise errors.NotActive(f"{owner.name} is deactivated; reactivate the user first.")
    secret = f"wp_{secrets.token_urlsafe(32)}"
    expires_at = None if seconds is None else tx.now + seconds
    row = tx.conn.execute(
        insert(credentials)
        .values(user_id=user, kind=kind, hash=hash_of(secret), label=label, created_at=tx.now, expires_at=expires_at)
        .returning(credentials.c.id)
    ).one()
    return Secret(row.id, user, secret, expires_at)


_FIND = Prepared(
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


def find(tx: Tx, secret_hash: str, kind: CredentialKind) -> Owner | None:
    """Return the owner of a secret by its hash, or None if the secret is unknown, expired or revoked."""
    row = _FIND.first(tx.conn, {"hash": secret_hash, "kind": kind})
    if row is None or (row.expires_at is not None and row.expires_at <= tx.now):
        return None
    is_stale = row.last_used_at is None or row.last_used_at <= tx.now - LAST_USE_SECONDS
    return Owner(row.id, row.name, row.role, row.credential, is_stale)


def seconds_left(tx: Tx, credential: int) -> float | None:
    """Return how long a credential is still valid; None if it does not expire."""
    until = tx.conn.execute(select(credentials.c.expires_at).where(credentials.c.id == credential)).scalar_one()
    return None if until is None else until - tx.now


def record_use(tx: Tx, credential: int) -> None:
    """Record that a credential is used now."""
    tx.conn.execute(update(credentials).where(credentials.c.id == credential).values(last_used_at=tx.now))


def valid(tx: Tx, user: int, kind: CredentialKind) -> Select[Any]:
    """Return the statement that selects a user's valid credentials of a kind, oldest first."""
    return (
        select(credentials)
        .where(credentials.c.user_id == user, credentials.c.kind == kind, credentials.c.revoked_at.is_(None))
        .where(credentials.c.expires_at.is_(None) | (credentials.c.expires_at > tx.now))
        .order_by(credentials.c.id)
    )


def revoke(tx: Tx, credential: int) -> None:
    """Revoke a credential."""
    _revoke_where(tx, credentials.c.id == credential)


def revoke_all(tx: Tx, user: int, kind: CredentialKind | None = None) -> None:
    """Revoke all credentials of a user, or all of one kind."""
    of_kind = () if kind is None else (credentials.c.kind == kind,)
    _revoke_where(tx, credentials.c.user_id == user, *of_kind)


def _revoke_where(tx: Tx, *conditions: Any) -> None:
    tx.conn.execute(
        update(credentials).where(*conditions, credentials.c.revoked_at.is_(None)).values(revoked_at=tx.now)
    )
