"""Deletes the personal data of a deactivated user: name, credentials, comments, reasons, traces of presence.

The user's row stays without a name, and so do the answers: runs have learned from them and paid for them. So all sums
stay true. The audit log is a chain and keeps the names that its rows have.
"""

import secrets
from typing import Any

from sqlalchemy import Select, func, select, update

from waypost import wire
from waypost.prices import to_units
from waypost_server import errors
from waypost_server.db.audit import COMMAND_LINE, Actor, Entry
from waypost_server.db.steps import Step, count, take, take_time
from waypost_server.db.tables import (
    active_time,
    answers,
    assignments,
    closed_tabs,
    comments,
    credentials,
    presence,
    queries,
    users,
)
from waypost_server.db.transaction import Tx

_USER = select(users.c.name, users.c.deactivated_at, users.c.erased_at)


def preview(tx: Tx, user: int) -> wire.UserErasure:
    """Return what the erasure of a user would delete.

    Raises:
        NotFound, StillActive, UserErased: there is no such user, or no such user to erase.
    """
    _check(tx, _USER.where(users.c.id == user), user)
    return _told(tx, user, count(tx, _steps(user)), dry_run=True)


def erase(tx: Tx, user: int, by: Actor = COMMAND_LINE) -> wire.UserErasure:
    """Delete a user's personal data, for good; return what was deleted.

    Raises:
        NotFound, StillActive, UserErased: there is no such user, or no such user to erase.
    """
    _check(tx, _USER.where(users.c.id == user).with_for_update(key_share=True), user)
    take_time(tx)
    # First, because the trigger of comments lets go only those of an erased user.
    nameless = {"name": f"erased-{secrets.token_hex(6)}", "erased_at": tx.now}
    tx.conn.execute(update(users).where(users.c.id == user).values(**nameless))
    erased = _told(tx, user, take(tx, _steps(user)), dry_run=False)
    tx.record(Entry(by, "user.erased", f"user/{user}", {"answers": erased.kept_answers}))
    return erased


def _check(tx: Tx, found: Select[Any], user: int) -> None:
    row = tx.conn.execute(found).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no user {user}.")
    if row.erased_at is not None:
        raise errors.UserErased(f"The personal data of user {user} were deleted before.")
    if row.deactivated_at is None:
        raise errors.StillActive(f"{row.name} is active; deactivate the user before you delete their data.")


def _steps(user: int) -> list[Step]:
    told = assignments.c.reason.is_not(None) | assignments.c.tab.is_not(None)
    return [
        Step("credentials", credentials, credentials.c.user_id == user),
        Step("comments", comments, comments.c.user_id == user),
        Step("reasons", assignments, (assignments.c.user_id == user) & told, {"reason": None, "tab": None}),
        *(Step("traces", table, table.c.user_id == user) for table in (presence, active_time, closed_tabs)),
    ]


def _told(tx: Tx, user: int, gone: dict[str, int], *, dry_run: bool) -> wire.UserErasure:
    counted = select(func.count(), func.coalesce(func.sum(answers.c.units), 0)).join(
        queries, queries.c.answer_id == answers.c.id
    )
    n, units = tx.conn.execute(counted.where(answers.c.user_id == user)).one()
    return wire.UserErasure(user=user, dry_run=dry_run, kept_answers=n, kept_units=to_units(int(units)), **gone)
