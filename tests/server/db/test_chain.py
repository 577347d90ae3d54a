"""The audit log is one chain: however many write it, and no change of a row goes unnoticed."""

from collections.abc import Iterator
from contextlib import closing, contextmanager
from functools import partial

import pytest
from sqlalchemy import Connection, create_engine, func, select, text
from sqlalchemy.exc import DBAPIError
from sqlalchemy.pool import NullPool
from tests.server.auth.test_audit import check, command, log_of
from tests.server.kit import Service, in_process, together

from waypost_server.db.audit import COMMAND_LINE, Entry, Head, append, first_fault
from waypost_server.db.engine import Database, parse
from waypost_server.db.tables import audit
from waypost_server.db.transaction import Tx
from waypost_server.users import service as users


def test_those_who_append_at_once_make_one_chain(database_url: str) -> None:
    with closing(Database(database_url)) as one, closing(Database(database_url)) as other:
        stores = (one, other)

        def add(number: int) -> None:
            for name in (f"{number} {n}" for n in range(4)):
                stores[number % 2].write_now(partial(users.create_user, name=name, role="viewer"))

        together(add, 8)
        assert one.read_now(lambda tx: tx.conn.execute(select(func.count()).select_from(audit)).scalar_one()) == 32
    assert check(database_url)["faults"] == []


def test_what_is_undone_has_no_row(lite: Service) -> None:
    number = len(log_of(lite))

    def change(tx: Tx) -> None:
        users.create_user(tx, "one", "viewer")
        raise RuntimeError

    def change_a_part(tx: Tx) -> None:
        with pytest.raises(RuntimeError), tx.part():
            change(tx)
        users.create_user(tx, "two", "viewer")

    with pytest.raises(RuntimeError):
        lite.db.write_now(change)
    lite.db.write_now(change_a_part)
    assert [row["details"]["name"] for row in log_of(lite)[number:]] == ["two"]


COPY = "INSERT INTO audit SELECT {number}, at, user_id, actor, address, action, object, details, {previous}, {hash} "
DAMAGES = {
    "UPDATE audit SET actor = 'lea' WHERE number = 3": "row 3 does not have the hash of what it says",
    "UPDATE audit SET details = '{}' WHERE number = 3": "row 3 does not have the hash of what it says",
    "UPDATE audit SET details = ' ' || details WHERE number = 3": "row 3 does not have the hash of what it says",
    "UPDATE audit SET details = '{' WHERE number = 3": "row 3 has details that are not JSON",
    "UPDATE audit SET previous = 'x' || substr(previous, 2) WHERE number = 3": (
        "row 3 does not have the hash of the row before it"
    ),
    "DELETE FROM audit WHERE number = 3": "row 3 is missing: row 4 is in its place",
    "DELETE FROM audit WHERE number = 1": "row 1 is missing: row 2 is in its place",
    COPY.format(number=9, previous="hash", hash="previous") + "FROM audit WHERE number = 8": (
        "row 9 does not have the hash of what it says"
    ),
}
UNNOTICED = {
    "DELETE FROM audit WHERE number > 6": "row 8, which was noted, is missing: the log ends with row 6",
    "DELETE FROM audit": "row 8, which was noted, is missing: the log ends with row 0",
}


@contextmanager
def opened(url: str) -> Iterator[Connection]:
    """A transaction of somebody who has the rights of the server."""
    engine = create_engine(parse(url), poolclass=NullPool)
    with engine.begin() as conn:
        yield conn


def unguard(conn: Connection) -> None:
    if conn.dialect.name == "sqlite":
        for verb in ("update", "delete"):
            conn.execute(text(f"DROP TRIGGER IF EXISTS audit_no_{verb}"))
    else:
        conn.execute(text("ALTER TABLE audit DISABLE TRIGGER audit_append_only"))


def test_a_changed_removed_or_inserted_row_is_found_and_a_cut_end_with_a_noted_head(database_url: str) -> None:
    with in_process(database_url) as service:
        assert len(log_of(service)) == 8
    for statement in DAMAGES.keys() | UNNOTICED.keys():
        if not statement.startswith("INSERT"):
            with pytest.raises(DBAPIError, match="audit is append-only"), opened(database_url) as conn:
                conn.execute(text(statement))
    text_of_head = check(database_url, "--audit-head", check(database_url)["head"])["head"]
    number, _, own = text_of_head.partition(":")
    noted = Head(int(number), own)
    with opened(database_url) as conn:
        unguard(conn)
    for statement, fault in (DAMAGES | UNNOTICED).items():
        with opened(database_url) as conn:
            conn.execute(text(statement))
            assert first_fault(conn, noted) == fault
            assert first_fault(conn) == (None if statement in UNNOTICED else fault)
            conn.rollback()
    with opened(database_url) as conn:
        conn.execute(text(next(iter(DAMAGES))))
    assert "Not so: row 3 does not have the hash of what it says." in command(database_url, "check", status=1)


def test_a_log_that_was_rewritten_as_a_whole_is_found_with_a_noted_head(database_url: str) -> None:
    with in_process(database_url):
        head = check(database_url)["head"]
    with opened(database_url) as conn:
        unguard(conn)
        conn.execute(audit.delete())
        append(conn, [Entry(COMMAND_LINE, "user.created", None, {"name": "eve"})] * 8)
    assert check(database_url, status=1)["faults"] == [], "only the missing trigger is noticed"
    (fault,) = check(database_url, "--audit-head", head, status=1)["faults"]
    assert fault == "row 8 has another hash than the one that was noted, so the log was rewritten"
    assert "`waypost check` prints one" in command(database_url, "check", "--audit-head", "8", status=2)
