"""What becomes of users and their secrets: roles, who may still call, tokens, sessions."""

from typing import Any

from sqlalchemy import Select, select, update

from waypost import wire
from waypost_server import errors
from waypost_server.db.engine import Tx
from waypost_server.db.tables import IS_LIVE, assignments, credentials
from waypost_server.db.tables import queries as query_table
from waypost_server.db.tables import users as user_table
from waypost_server.leases import service as leases
from waypost_server.users import service as users

RENEWED_AFTER = 0.1  # of its length, a session's length begins anew


def change(tx: Tx, user: int, wanted: wire.UserPatch) -> wire.User:
    """Change a user's role, or whether they may call at all; absent fields stay as they are.

    Who may no longer answer gives their leases back. Answers stay.

    Raises:
        NotFound: if there is no such user.
        LastAdministrator: if nobody would be left to let others in.
    """
    # All of them, in one order: two administrators who demote each other must not both succeed.
    administrators = tx.conn.execute(
        select(user_table.c.id)
        .where(user_table.c.role == "admin", user_table.c.deactivated_at.is_(None))
        .order_by(user_table.c.id)
        .with_for_update()
    ).scalars()
    now = users.view(tx, user)
    role = wanted.role or now.role
    active = now.deactivated_at is None if wanted.active is None else wanted.active
    if administrators.all() == [user] and (role != "admin" or not active):
        raise errors.LastAdministrator(f"{now.name} is the only administrator; make somebody else one first.")
    if not active and now.deactivated_at is None:
        _revoke_all(tx, user)
    if not active or role not in users.ANSWERING:
        _give_back(tx, user)
    deactivated_at = None if active else now.deactivated_at or tx.now
    tx.conn.execute(update(user_table).where(user_table.c.id == user).values(role=role, deactivated_at=deactivated_at))
    return users.view(tx, user)


def _revoke_all(tx: Tx, user: int) -> None:
    mine = (credentials.c.user_id == user, credentials.c.revoked_at.is_(None))
    tx.conn.execute(update(credentials).where(*mine).values(revoked_at=tx.now))


def _give_back(tx: Tx, user: int) -> None:
    held = (
        select(query_table.c.id)
        .join(assignments, assignments.c.query_id == query_table.c.id)
        .where(assignments.c.user_id == user, IS_LIVE)
        .with_for_update(of=query_table)
    )
    ids = tx.conn.execute(held).scalars().all()
    if ids:
        leases.reopen(tx, ids, "released", [assignments.c.user_id == user])


def _good(tx: Tx, user: int, kind: users.CredentialKind) -> Select[Any]:
    return (
        select(credentials)
        .where(credentials.c.user_id == user, credentials.c.kind == kind, credentials.c.revoked_at.is_(None))
        .where(credentials.c.expires_at.is_(None) | (credentials.c.expires_at > tx.now))
        .order_by(credentials.c.id)
    )


def tokens(tx: Tx, user: int) -> wire.TokenList:
    """List a user's API tokens.

    Raises:
        NotFound: if there is no such user.
    """
    users.view(tx, user)
    rows = tx.conn.execute(_good(tx, user, "api"))
    return wire.TokenList(
        tokens=[
            wire.Token(id=row.id, label=row.label, created_at=row.created_at, last_used_at=row.last_used_at)
            for row in rows
        ]
    )


def revoke_token(tx: Tx, token: int, owner: int | None = None) -> None:
    """Revoke an API token; with `owner`, only one of theirs.

    Raises:
        NotFound: if there is no such token.
    """
    known = select(credentials.c.id).where(credentials.c.id == token, credentials.c.kind == "api")
    if owner is not None:
        known = known.where(credentials.c.user_id == owner)
    if tx.conn.execute(known).one_or_none() is None:
        raise errors.NotFound(f"There is no token {token}.")
    users.revoke(tx, token)


def sessions(tx: Tx, user: int, current: int) -> wire.SessionList:
    """List the browsers a user is signed in with."""
    rows = tx.conn.execute(_good(tx, user, "session"))
    return wire.SessionList(
        sessions=[
            wire.Session(
                id=row.id,
                created_at=row.created_at,
                last_used_at=row.last_used_at,
                expires_at=row.expires_at,
                current=row.id == current,
            )
            for row in rows
        ]
    )


def end_sessions(tx: Tx, user: int) -> None:
    """Sign a user out of every browser."""
    tx.conn.execute(
        update(credentials)
        .where(credentials.c.user_id == user, credentials.c.kind == "session", credentials.c.revoked_at.is_(None))
        .values(revoked_at=tx.now)
    )


def renew_session(tx: Tx, session: int, seconds: float) -> bool:
    """Let a session's length begin anew, if a part of it is over; says whether it did."""
    renewed = tx.conn.execute(
        update(credentials)
        .where(credentials.c.id == session, credentials.c.revoked_at.is_(None))
        .where(credentials.c.expires_at < tx.now + (1 - RENEWED_AFTER) * seconds)
        .values(expires_at=tx.now + seconds)
    )
    return bool(renewed.rowcount)
