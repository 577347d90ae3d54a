"""Browser sessions, and the login links that start them."""

from sqlalchemy import case, exists, select, update

from waypost import wire
from waypost_server import errors
from waypost_server.auth.credentials import Secret, hash_of, issue, revoke, revoke_all, valid, why_rejected
from waypost_server.db.audit import COMMAND_LINE, Actor, Entry
from waypost_server.db.tables import credentials, users
from waypost_server.db.transaction import Tx

RENEWED_AFTER = 0.1  # sliding renewal: a session is extended once this share of its lifetime is over


def create_login_link(tx: Tx, user: int, seconds: float, by: Actor = COMMAND_LINE) -> wire.LoginLink:
    """Create a one-time login code that is valid for `seconds`.

    Raises:
        NotFound: there is no such user.
        NotActive: the user is deactivated.
    """
    issued = issue(tx, user, "login", seconds=seconds)
    details = {"link": issued.id, "name": issued.name, "expires": issued.expires}
    tx.record(Entry(by, "link.created", f"user/{user}", details))
    return wire.LoginLink(code=issued.secret, expires_at=issued.expires_at or 0.0)


def redeem(tx: Tx, code: str, seconds: float, address: str | None = None) -> Secret | None:
    """Use up a login code and return a new session, or None if the code is not valid (`why_refused` says why)."""
    used = tx.conn.execute(
        update(credentials)
        .where(
            credentials.c.hash == hash_of(code),
            credentials.c.kind == "login",
            credentials.c.revoked_at.is_(None),
            credentials.c.expires_at > tx.now,
        )
        .values(revoked_at=tx.now)
        .returning(credentials.c.id, credentials.c.user_id)
    ).one_or_none()
    if used is None:
        return None
    session = issue(tx, used.user_id, "session", seconds=seconds)
    actor = Actor(session.name, session.user, address)
    tx.record(Entry(actor, "login", f"user/{session.user}", {"link": used.id, "session": session.id}))
    return session


def end_session(tx: Tx, session: int, by: Actor) -> None:
    """End a user's own session."""
    if revoke(tx, session):
        tx.record(Entry(by, "logout", f"user/{by.user}", {"session": session}))


def end_all_sessions(tx: Tx, user: int, by: Actor) -> None:
    """End all sessions of a user."""
    if ended := revoke_all(tx, user, "session"):
        tx.record(Entry(by, "logout", f"user/{user}", {"sessions": ended}))


def administrator_has_logged_in(tx: Tx) -> bool:
    """Return whether a browser ever had a session of a user who is an administrator."""
    session = (credentials.c.kind == "session", credentials.c.user_id == users.c.id, users.c.role == "admin")
    return bool(tx.conn.execute(select(exists().where(*session))).scalar_one())


def why_refused(tx: Tx, code: str) -> errors.Unauthenticated:
    """Return the reason why a login code is not valid, and what to do about it."""
    rejected = why_rejected(tx, hash_of(code), "login")
    if rejected is None:
        return errors.Unauthenticated("This login link does not exist; check that you copied the whole link.")
    if rejected.reason == "deactivated":
        return errors.Deactivated("This account is deactivated; ask an administrator of this server.")
    if rejected.reason == "revoked":
        return errors.LoginUsed("This login link was used before, and each link works once; ask for a new one.")
    return errors.LoginExpired("This login link has expired; ask for a new one.")


def list_sessions(tx: Tx, user: int, current: int) -> wire.SessionList:
    """List a user's sessions, oldest first; `current` is the session of the request."""
    rows = tx.conn.execute(valid(tx, user, "session"))
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


def renew_session(tx: Tx, session: int, seconds: float, most: float) -> bool:
    """Extend a session to its full lifetime, if enough of it is over; return whether it was extended.

    It never ends later than `most` seconds after its login.
    """
    until = tx.now + seconds
    last = credentials.c.created_at + most
    renewed = tx.conn.execute(
        update(credentials)
        .where(credentials.c.id == session, credentials.c.revoked_at.is_(None))
        .where(credentials.c.expires_at < tx.now + (1 - RENEWED_AFTER) * seconds, credentials.c.expires_at < last)
        .values(expires_at=case((last < until, last), else_=until))
    )
    return bool(renewed.rowcount)
