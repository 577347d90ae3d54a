"""The audit log: appends rows to a chain of hashes, and finds the first row that does not fit.

Each row holds the hash of the row before it, and a SHA-256 of all that it says itself. So nobody can change, remove or
insert a row without changing every later hash. Who did what is recorded by the transaction of the change.
"""

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Connection, Row, insert, select, text

from waypost.wire import AuditAction
from waypost_server.db import canonical
from waypost_server.db.functions import clock
from waypost_server.db.tables import audit

LOCK = 7_296_012  # an arbitrary number, like the one of `schema`: who holds this lock may append
FIRST = "0" * 64  # what the first row has as the hash of the row before it
PAGE = 1_000  # rows that are read at once

Details = Mapping[str, Any]
"""Texts, whole numbers, truth values and objects of them. No fraction: languages write one in different ways."""


@dataclass(frozen=True)
class Actor:
    """Who did something: a user, somebody at the command line, or nobody who is known.

    Args:
        name: the user's name, `nobody` or `command line`. Only users have an id.
        user: the user's id.
        address: where the request came from; None if it did not come over the network.
    """

    name: str
    user: int | None = None
    address: str | None = None


COMMAND_LINE = Actor("command line")


def nobody(address: str | None) -> Actor:
    """Return the actor of a request that has no valid credential."""
    return Actor("nobody", address=address)


@dataclass(frozen=True)
class Entry:
    """What a row of the audit log says, apart from its place in the chain. It must not hold a secret."""

    actor: Actor
    action: AuditAction
    object: str | None
    details: Details


@dataclass(frozen=True)
class Head:
    """A row by its number and hash: written down elsewhere, it shows that no row up to it was changed or cut off."""

    number: int
    hash: str

    def __str__(self) -> str:
        """Return it as `waypost check --audit-head` takes it."""
        return f"{self.number}:{self.hash}"


def moment(seconds: float) -> str:
    """Return a time as the log writes it: in UTC, to the microsecond, always equally long."""
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="microseconds").replace("+00:00", "Z")


def append(conn: Connection, entries: Sequence[Entry]) -> None:
    """Append rows, as the last statements of a transaction.

    SQLite has one writing transaction at a time. On PostgreSQL, a lock makes writers wait for each other's commit: each
    must see the row that it follows. It is taken last, and later transactions of a group do not wait for locks
    (`db.writers.shared`), so it causes no deadlock.
    """
    if conn.dialect.name == "postgresql":
        conn.execute(text("SELECT pg_advisory_xact_lock(:lock)"), {"lock": LOCK})
    newest = head(conn) or Head(0, FIRST)
    at = moment(conn.execute(select(clock())).scalar_one())  # read with the lock held, so times are in order
    for entry in entries:
        row = {
            "number": newest.number + 1,
            "at": at,
            "user_id": entry.actor.user,
            "actor": entry.actor.name,
            "address": entry.actor.address,
            "action": entry.action,
            "object": entry.object,
            "details": canonical.text(entry.details),
            "previous": newest.hash,
        }
        newest = Head(newest.number + 1, canonical.digest(canonical.text(content(row))))
        conn.execute(insert(audit).values(**row, hash=newest.hash))


def content(row: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the hash of a row is made of: all its fields except the hash, with the names that clients see.

    Raises:
        ValueError: the details are not JSON.
    """
    fields = {name: row[name] for name in ("number", "at", "actor", "address", "action", "object", "previous")}
    return fields | {"user": row["user_id"], "details": json.loads(row["details"])}


def head(conn: Connection) -> Head | None:
    """Return the newest row; None if the log is empty."""
    row = conn.execute(select(audit.c.number, audit.c.hash).order_by(audit.c.number.desc()).limit(1)).one_or_none()
    return None if row is None else Head(row.number, row.hash)


def rows_after(conn: Connection, number: int, limit: int = PAGE) -> Sequence[Row[Any]]:
    """Return the next rows after a number, oldest first."""
    return conn.execute(select(audit).where(audit.c.number > number).order_by(audit.c.number).limit(limit)).all()


def first_fault(conn: Connection, noted: Head | None = None) -> str | None:
    """Return what is wrong with the first row that does not fit; None if every row does.

    Args:
        conn: reads the store.
        noted: a head that was written down earlier.
    """
    before = Head(0, FIRST)
    for row in _rows(conn):
        fault = _fault(row, before)
        if fault is None and noted is not None and row.number == noted.number and row.hash != noted.hash:
            fault = f"row {row.number} has another hash than the one that was noted, so the log was rewritten"
        if fault is not None:
            return fault
        before = Head(row.number, row.hash)
    if noted is not None and before.number < noted.number:
        return f"row {noted.number}, which was noted, is missing: the log ends with row {before.number}"
    return None


def _rows(conn: Connection) -> Iterator[Row[Any]]:
    number = -(2**63)
    while page := rows_after(conn, number):
        yield from page
        number = page[-1].number


def _fault(row: Row[Any], before: Head) -> str | None:
    if row.number != before.number + 1:
        return f"row {before.number + 1} is missing: row {row.number} is in its place"
    if row.previous != before.hash:
        return f"row {row.number} does not have the hash of the row before it"
    try:
        said = content(row._asdict())
    except ValueError:
        return f"row {row.number} has details that are not JSON"
    if row.details != canonical.text(said["details"]) or row.hash != canonical.digest(canonical.text(said)):
        return f"row {row.number} does not have the hash of what it says"
    return None
