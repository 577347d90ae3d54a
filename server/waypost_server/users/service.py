"""Creates, lists and changes users. A user is a person or a program that may call the server."""

from typing import Any

from sqlalchemy import Row, Select, and_, func, insert, or_, select, update
from sqlalchemy.exc import IntegrityError

from waypost import wire
from waypost_server import errors
from waypost_server.auth.credentials import revoke_all
from waypost_server.auth.roles import ANNOTATORS
from waypost_server.db.audit import COMMAND_LINE, Actor, Entry
from waypost_server.db.tables import credentials, users
from waypost_server.db.transaction import Tx
from waypost_server.leases import service as leases

USERS: Select[Any] = select(
    users,
    select(func.max(credentials.c.last_used_at))
    .where(credentials.c.user_id == users.c.id)
    .correlate(users)
    .scalar_subquery()
    .label("last_used_at"),
)


def _of_row(row: Row[Any]) -> wire.User:
    return wire.User(
        id=row.id,
        name=row.name,
        role=row.role,
        created_at=row.created_at,
        deactivated_at=row.deactivated_at,
        erased_at=row.erased_at,
        frame_bytes=row.frame_bytes,
        last_used_at=row._mapping.get("last_used_at"),
    )


def create_user(tx: Tx, name: str, role: wire.Role, by: Actor = COMMAND_LINE) -> wire.User:
    """Create a user.

    Raises:
        NameTaken: another user has the name.
    """
    try:
        with tx.conn.begin_nested():
            row = tx.conn.execute(insert(users).values(name=name, role=role, created_at=tx.now).returning(users)).one()
    except IntegrityError:
        raise errors.NameTaken(f"There is a user named {name!r}; choose another name.") from None
    tx.record(Entry(by, "user.created", f"user/{row.id}", {"name": name, "role": role}))
    return _of_row(row)


def ensure_user(tx: Tx, name: str, role: wire.Role) -> wire.User:
    """Return the user with this name; create the user if there is none."""
    row = tx.conn.execute(select(users).where(users.c.name == name)).one_or_none()
    return create_user(tx, name, role) if row is None else _of_row(row)


def ensure_former_user(tx: Tx, name: str) -> int:
    """Return the id of the user with this name; if there is none, create an annotator who is deactivated."""
    known = tx.conn.execute(select(users.c.id).where(users.c.name == name)).scalar_one_or_none()
    if known is not None:
        return int(known)
    former = insert(users).values(name=name, role="annotator", created_at=tx.now, deactivated_at=tx.now)
    user = int(tx.conn.execute(former.returning(users.c.id)).scalar_one())
    details = {"name": name, "role": "annotator", "active": False}
    tx.record(Entry(COMMAND_LINE, "user.created", f"user/{user}", details))
    return user


def ensure_administrator(tx: Tx) -> wire.User:
    """Return the user `admin` if that is an administrator, else the first administrator; create `admin` if needed."""
    rows = tx.conn.execute(
        select(users).where(users.c.role == "admin", users.c.deactivated_at.is_(None)).order_by(users.c.id)
    ).all()
    if not rows:
        return ensure_user(tx, "admin", "admin")
    return _of_row(next((row for row in rows if row.name == "admin"), rows[0]))


def find_by_name(tx: Tx, name: str) -> wire.User:
    """Return the user with this name.

    Raises:
        NotFound: there is none.
    """
    row = tx.conn.execute(select(users).where(users.c.name == name)).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no user named {name!r}; `waypost user add` creates one.")
    return _of_row(row)


def view(tx: Tx, user: int) -> wire.User:
    """Return a user.

    Raises:
        NotFound: there is none with this id.
    """
    row = tx.conn.execute(USERS.where(users.c.id == user)).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no user {user}.")
    return _of_row(row)


def list_users(tx: Tx) -> wire.UserList:
    """List all users, in the order they were created."""
    rows = tx.conn.execute(USERS.order_by(users.c.id)).all()
    return wire.UserList(users=[_of_row(row) for row in rows])


def change(tx: Tx, user: int, patch: wire.UserPatch, by: Actor = COMMAND_LINE) -> wire.User:
    """Change a user's role, deactivate or reactivate the user. Absent fields of the patch change nothing.

    Deactivation revokes all credentials. Deactivation, or a role that may not answer, releases leases. Answers stay.

    Raises:
        NotFound: there is no such user.
        UserErased: the user's data were deleted.
        LastAdministrator: no active administrator would be left.
    """
    # Lock all administrators in one order, so that two of them cannot demote each other at the same time; and the
    # user, so that the audit log says what really changed.
    is_administrator = and_(users.c.role == "admin", users.c.deactivated_at.is_(None))
    locked = tx.conn.execute(
        select(users.c.id, is_administrator.label("is_administrator"))
        .where(or_(is_administrator, users.c.id == user))
        .order_by(users.c.id)
        .with_for_update(key_share=True)
    )
    administrators = [row.id for row in locked if row.is_administrator]
    now = view(tx, user)
    if now.erased_at is not None:
        raise errors.UserErased(f"The personal data of user {user} were deleted; create a new user instead.")
    role = patch.role or now.role
    active = now.deactivated_at is None if patch.active is None else patch.active
    if administrators == [user] and (role != "admin" or not active):
        raise errors.LastAdministrator(f"{now.name} is the only administrator; first make another user one.")
    if role != now.role:
        details = {"name": now.name, "from": now.role, "to": role}
        tx.record(Entry(by, "user.role_changed", f"user/{user}", details))
    if active != (now.deactivated_at is None):
        action: wire.AuditAction = "user.reactivated" if active else "user.deactivated"
        tx.record(Entry(by, action, f"user/{user}", {"name": now.name}))
    if not active and now.deactivated_at is None:
        revoke_all(tx, user)
    if not active or role not in ANNOTATORS:
        leases.release_all(tx, user)
    deactivated_at = None if active else now.deactivated_at or tx.now
    tx.conn.execute(update(users).where(users.c.id == user).values(role=role, deactivated_at=deactivated_at))
    return view(tx, user)
