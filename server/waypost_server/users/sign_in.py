"""Finds or creates the user of a person who signed in at the OpenID provider, and starts a session."""

import re
from dataclasses import dataclass

from sqlalchemy import insert, select
from sqlalchemy.exc import IntegrityError

from waypost import wire
from waypost_server import errors
from waypost_server.auth.credentials import Secret, issue
from waypost_server.auth.oidc import Person
from waypost_server.db import canonical
from waypost_server.db.audit import COMMAND_LINE, Actor, Entry
from waypost_server.db.tables import identities, users
from waypost_server.db.transaction import Tx
from waypost_server.users import service

MOST_NAME = 90  # characters, which leaves room for a number
NEW_ROLE: wire.Role = "annotator"  # of a new user, if roles are given in Waypost


@dataclass(frozen=True)
class Rules:
    """How a person becomes a session.

    Args:
        create: whether somebody unknown becomes a user.
        seconds: how long the session is valid.
    """

    create: bool
    seconds: float


def identity_of(issuer: str, subject: str) -> str:
    """Return the hash by which the store knows a person at a provider."""
    return canonical.digest(canonical.text([issuer, subject]))


def provider(address: str | None) -> Actor:
    """Return the actor of what the provider decides: new users, and changes of roles."""
    return Actor("identity provider", address=address)


def sign_in(tx: Tx, person: Person, rules: Rules, address: str | None = None) -> Secret:
    """Start a session of a person's user, after the user has the role that the provider gives.

    The last administrator keeps that role.

    Raises:
        NoAccount: the person is no user here, and none is created.
        Deactivated: the user is deactivated, or the user's data were deleted.
    """
    by = provider(address)
    user = _find(tx, person) or _create(tx, person, rules, by)
    row = tx.conn.execute(select(users).where(users.c.id == user)).one()
    if row.deactivated_at is not None:
        raise errors.Deactivated("This account is deactivated; ask an administrator of this server.")
    details: dict[str, str | int] = {"issuer": person.issuer}
    if person.role is not None:
        try:
            service.change(tx, user, wire.UserPatch(role=person.role), by)
        except errors.LastAdministrator:
            details["kept"] = "admin"
    session = issue(tx, user, "session", seconds=rules.seconds)
    details["session"] = session.id
    tx.record(Entry(Actor(session.name, user, address), "login", f"user/{user}", details))
    return session


def identify(tx: Tx, user: int, issuer: str, subject: str, by: Actor = COMMAND_LINE) -> None:
    """Record who an existing user is at a provider.

    Raises:
        IdentityTaken: somebody else is that person.
    """
    name = service.view(tx, user).name
    new = insert(identities).values(hash=identity_of(issuer, subject), user_id=user, created_at=tx.now)
    try:
        with tx.conn.begin_nested():
            tx.conn.execute(new)
    except IntegrityError:
        raise errors.IdentityTaken(f"{subject!r} of {issuer} is a user already.") from None
    tx.record(Entry(by, "user.identified", f"user/{user}", {"name": name, "issuer": issuer, "subject": subject}))


def _find(tx: Tx, person: Person) -> int | None:
    known = select(identities.c.user_id).where(identities.c.hash == identity_of(person.issuer, person.subject))
    return tx.conn.execute(known).scalar_one_or_none()


def _create(tx: Tx, person: Person, rules: Rules, by: Actor) -> int:
    """Create a user for a person; if another browser of theirs was quicker, return that one."""
    if not rules.create:
        raise errors.NoAccount("You signed in, but you have no account on this server. Ask an administrator for one.")
    try:
        with tx.part():
            user = _named(tx, person, by)
            identify(tx, user, person.issuer, person.subject, by)
            return user
    except errors.IdentityTaken:
        found = _find(tx, person)
        assert found is not None
        return found


def _named(tx: Tx, person: Person, by: Actor) -> int:
    """Create a user with a person's name, and a number behind it if somebody else has that name."""
    name = re.sub(r"[\x00-\x1f\x7f]", "", person.name).strip()[:MOST_NAME] or "somebody"
    number = 1
    while True:
        try:
            with tx.part():
                own = name if number == 1 else f"{name} {number}"
                return service.create_user(tx, own, person.role or NEW_ROLE, by).id
        except errors.NameTaken:
            number += 1
