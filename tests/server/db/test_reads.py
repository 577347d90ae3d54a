"""Reads: the statements of one read see the store at one moment, and change nothing."""

from collections.abc import Iterator

import pytest

from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.transaction import Tx
from waypost_server.users import service as users


@pytest.fixture
def db(database_url: str) -> Iterator[Database]:
    """A store, on each database."""
    db = Database(database_url)
    yield db
    db.close()


def names(tx: Tx) -> list[str]:
    return [user.name for user in users.list_users(tx).users]


def test_a_read_does_not_see_what_is_committed_after_its_first_statement(db: Database) -> None:
    def twice(tx: Tx) -> tuple[list[str], list[str]]:
        before = names(tx)
        db.write_now(lambda other: users.create_user(other, "ann", "admin"))
        return before, names(tx)

    assert db.read_now(twice) == ([], [])
    assert db.read_now(names) == ["ann"]


def test_a_read_cannot_write(db: Database) -> None:
    with pytest.raises(errors.StorageFailed, match=r"read-?only|readonly"):
        db.read_now(lambda tx: users.create_user(tx, "ann", "admin"))
    assert db.read_now(names) == []
    assert db.write_now(lambda tx: users.create_user(tx, "bea", "admin")).name == "bea", "a write still works"


def test_a_read_leaves_its_connection_ready_for_a_write(db: Database) -> None:
    for name in ("ann", "bea"):
        db.read_now(names)
        db.write_now(lambda tx, name=name: users.create_user(tx, name, "viewer"))
        assert db.write_now(names)[-1] == name
