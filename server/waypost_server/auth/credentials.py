"""Credentials: API tokens, browser sessions and login codes. The store keeps only a hash of each secret."""

import hashlib
import secrets
from dataclasses import dataclass
from typing import Any, Literal, cast

from sqlalchemy import Select, bindparam, insert, select, update

from waypost.wire import Role, Scope
from waypost_server import errors
from waypost_server.db.audit import moment
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
    scopes: frozenset[Scope] | None  # of a token; None: everything that the user may do
    last_use_is_stale: bool  # whether `last_used_at` should be updated


@dataclass(frozen=True)
class Secret:
    """A new credential with its secret in clear text. The store never has the clear text."""

    id: int
    user: int
    name: str  # of the user
    secret: str
    expires_at: float | None

    @property
    def expires(self) -> str | None:
        """When it expires, as the audit log writes it."""
        return None if self.expires_at is None else moment(self.expires_at)


def hash_of(secret: str) -> str:
    """Return the hash that is stored. A secret has 256 random bits, so a fast hash is enough."""
    return hashlib.sha256(secret.encode("utf-8", "surrogateescape")).hexdigest()


def issue(
    tx: Tx,
    user: int,
    kind: CredentialKind,
    label: str = "",
    seconds: float | None = None,
    scopes: frozenset[Scope] | None = None,
) -> Secret:
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
    new = {
        "user_id": user,
        "kind": kind,
        "hash": hash_of(secret),
        "label": label,
        "created_at": tx.now,
        "expires_at": expires_at,
        "scopes": None if scopes is None else " ".join(sorted(scopes)),
    }
    row = tx.conn.execute(insert(credentials).values(new).returning(credentials.c.id)).one()
    return Secret(row.id, user, owner.name, secret, expires_at)


_FIND = Prepared(
    select(users.c.id, users.c.name, users.c.role, credentials.c.id.label("credential"))
    .add_columns(credentials.c.expires_at, credentials.c.last_used_at, credentials.c.scopes)
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
    return Owner(row.id, row.name, row.role, row.credential, scopes_of(row.scopes), is_stale)


def scopes_of(stored: str | None) -> frozenset[Scope] | None:
    """Return the scopes of a token as they are stored; None if it has none, and may do what its user may."""
    return None if stored is None else frozenset(cast(list[Scope], stored.split()))


@dataclass(frozen=True)
class Rejected:
    """A secret that is known but not valid: its credential, its user, and the reason."""

    credential: int
    user: int
    name: str  # of the user
    reason: Literal["deactivated", "revoked", "expired"]


def why_rejected(tx: Tx, secret_hash: str, kind: CredentialKind) -> Rejected | None:
    """Return why a secret that is not valid is not, or None if it is unknown."""
    row = tx.conn.execute(
        select(credentials.c.id, credentials.c.user_id, credentials.c.revoked_at, users.c.name, users.c.deactivated_at)
        .join(users, users.c.id == credentials.c.user_id)
        .where(credentials.c.hash == secret_hash, credentials.c.kind == kind)
    ).one_or_none()
    if row is None:
        return None
    if row.deactivated_at is not None:
        return Rejected(row.id, row.user_id, row.name, "deactivated")
    return Rejected(row.id, row.user_id, row.name, "expired" if row.revoked_at is None else "revoked")


@dataclass(frozen=True)
class Limits:
    """How long a credential is still valid, in seconds, and its scopes; None: without a limit."""

    seconds: float | None = None
    scopes: frozenset[Scope] | None = None


def limits_of(tx: Tx, credential: int) -> Limits:
    """Return the limits of a credential."""
    limits = select(credentials.c.expires_at, credentials.c.scopes).where(credentials.c.id == credential)
    row = tx.conn.execute(limits).one()
    return Limits(None if row.expires_at is None else row.expires_at - tx.now, scopes_of(row.scopes))


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


def revoke(tx: Tx, credential: int) -> bool:
    """Revoke a credential; return whether it was not revoked before."""
    return bool(_revoke_where(tx, credentials.c.id == credential))


def revoke_all(tx: Tx, user: int, kind: CredentialKind | None = None) -> int:
    """Revoke all credentials of a user, or all of one kind; return how many were not revoked before."""
    of_kind = () if kind is None else (credentials.c.kind == kind,)
    return _revoke_where(tx, credentials.c.user_id == user, *of_kind)


def _revoke_where(tx: Tx, *conditions: Any) -> int:
    not_yet = (*conditions, credentials.c.revoked_at.is_(None))
    return tx.conn.execute(update(credentials).where(*not_yet).values(revoked_at=tx.now)).rowcount
