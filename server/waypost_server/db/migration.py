"""Migrates a store to this version's schema, after a backup: there is no way back."""

import sqlite3
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from waypost_server.db import engine, schema
from waypost_server.db.backup import back_up


@dataclass(frozen=True)
class Done:
    """A migration, and the backup that was made before; None if none was needed, or on PostgreSQL."""

    migrated: schema.Migrated
    backup: Path | None


def migrate(url: str) -> Done:
    """Bring a store up to this version's schema, or create it. An older SQLite store is backed up beside itself first.

    Raises:
        BadDatabase, NewerStore: with one sentence for the operator.
        CannotBackUp: the backup failed, and nothing was migrated.
    """
    store = engine.parse(url)
    copy = None
    if store.get_backend_name() == "sqlite" and _is_older(file := Path(str(store.database))):
        copy = file.with_name(f"{file.name}.before-{schema.newest()}-{datetime.now(UTC):%Y%m%d-%H%M%S}")
        back_up(url, copy)
    return Done(engine.migrate(url), copy)


def _is_older(file: Path) -> bool:
    """Return whether a file is a store of an earlier version. What else it may be, the migration itself finds out."""
    if not file.is_file():
        return False
    try:
        with closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as store:
            row = store.execute("SELECT version_num FROM alembic_version").fetchone()
    except sqlite3.DatabaseError:
        return False
    return row is not None and row[0] != schema.newest()
