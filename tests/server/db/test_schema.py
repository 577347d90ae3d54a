"""The schema: what the migrations build is what the code expects, and a newer store is left alone."""

import threading

import pytest
from alembic.autogenerate import compare_metadata
from alembic.runtime.migration import MigrationContext
from sqlalchemy import text
from tests.server.kit import make_older_store, schema_of

from waypost import wire
from waypost_server.db.engine import BadDatabase, Database, migrate, parse
from waypost_server.db.schema import NewerStore, OlderStore
from waypost_server.db.tables import metadata
from waypost_server.db.transaction import Tx
from waypost_server.users import service as users
from waypost_server.webhooks import service as webhooks
from waypost_server.webhooks.policy import Policy


def differences(tx: Tx) -> list[object]:
    return list(compare_metadata(MigrationContext.configure(tx.conn, opts={"compare_type": True}), metadata))


def checks(tx: Tx) -> dict[str, int]:
    """How many CHECK constraints each table has: autogenerate does not compare them."""
    if tx.conn.dialect.name == "sqlite":
        rows = tx.conn.execute(text("SELECT name, sql FROM sqlite_master WHERE type = 'table'"))
        counts = {row.name: (row.sql or "").count("CHECK (") for row in rows}
    else:
        rows = tx.conn.execute(
            text(
                "SELECT conrelid::regclass::text AS name, count(*) AS n FROM pg_constraint "
                "WHERE contype = 'c' GROUP BY 1"
            )
        )
        counts = {row.name: row.n for row in rows}
    return {name: n for name, n in counts.items() if n and name in metadata.tables}


def test_the_migrations_build_the_tables_the_code_expects(empty_url: str) -> None:
    db = Database(empty_url)
    try:
        assert db.write_now(differences) == []
        expected = {
            name: sum(1 for one in table.constraints if type(one).__name__ == "CheckConstraint")
            for name, table in metadata.tables.items()
        }
        assert db.read_now(checks) == {name: n for name, n in expected.items() if n}
    finally:
        db.close()


def test_opening_a_store_again_changes_nothing(empty_url: str) -> None:
    Database(empty_url).close()
    db = Database(empty_url)
    assert db.read_now(lambda tx: tx.conn.execute(text("SELECT version_num FROM alembic_version")).scalars().all()) == [
        "0018"
    ]
    db.close()


def test_a_store_from_before_webhooks_opens_with_all_that_it_has(empty_url: str) -> None:
    make_older_store(empty_url)
    migrate(empty_url)
    db = Database(empty_url)
    assert db.read_now(users.list_users).users[0].name == "ann"
    wanted = wire.WebhookCreate(url="https://hooks.example.org/")
    made = db.write_now(lambda tx: webhooks.create(tx, wanted, 1, Policy(("hooks.example.org",))))
    assert db.read_now(webhooks.list_webhooks).webhooks == [made.webhook]
    db.close()


def test_a_store_of_an_older_version_is_only_migrated_on_request(empty_url: str) -> None:
    make_older_store(empty_url)
    for _ in range(2):
        with pytest.raises(OlderStore, match=r"schema 0006.*run `waypost migrate --database"):
            Database(empty_url)
    assert schema_of(empty_url) == "0006"
    assert migrate(empty_url).before == "0006"
    again = migrate(empty_url)
    assert again.before == again.after == schema_of(empty_url)


def test_a_store_of_a_newer_version_is_refused_and_left_as_it_is(empty_url: str) -> None:
    db = Database(empty_url)
    db.write_now(lambda tx: tx.conn.execute(text("UPDATE alembic_version SET version_num = '9999'")))
    db.close()
    for _ in range(2):
        for use in (Database, migrate):
            with pytest.raises(NewerStore, match="schema 9999, which this version of Waypost does not know"):
                use(empty_url)


def test_servers_that_start_together_migrate_once(empty_url: str) -> None:
    opened: list[Database] = []

    def start() -> None:
        opened.append(Database(empty_url))

    threads = [threading.Thread(target=start) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(opened) == 4
    for db in opened:
        db.close()


@pytest.mark.parametrize(
    ("url", "reason"),
    [
        ("waypost.db", "is not a database URL"),
        ("mysql://root@localhost/x", "is not a database URL|not supported"),
        ("oracle+nothing://x", "is not a database URL"),
        ("sqlite://", "needs a file"),
        ("sqlite:///:memory:", "needs a file"),
        ("", "is not a database URL"),
    ],
)
def test_a_empty_url_that_cannot_be_used_is_explained(url: str, reason: str) -> None:
    with pytest.raises(BadDatabase, match=reason):
        parse(url)


def test_a_database_that_does_not_open_is_explained(tmp_path: object) -> None:
    with pytest.raises(BadDatabase, match="Cannot open"):
        Database(f"sqlite:///{tmp_path}/missing/waypost.db")
