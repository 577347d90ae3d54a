"""Upgrades the schema of a store when the database is opened."""

from pathlib import Path

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Engine, text

MIGRATIONS = Path(__file__).parent / "migrations"
LOCK = 7_296_011  # an arbitrary number; with it, servers that start at the same time migrate one after the other


class NewerStore(Exception):
    """The store was written by a newer version."""


def config() -> Config:
    """Return Alembic's configuration for the migrations in this package."""
    found = Config()
    found.set_main_option("script_location", str(MIGRATIONS))
    found.set_main_option("path_separator", "os")
    return found


def upgrade(engine: Engine) -> None:
    """Apply the migrations that a store lacks, in one transaction.

    Raises:
        NewerStore: the store has a revision that this version does not know.
    """
    settings = config()
    known = {script.revision for script in ScriptDirectory.from_config(settings).walk_revisions()}
    with engine.begin() as conn:
        if engine.dialect.name == "postgresql":
            conn.execute(text("SELECT pg_advisory_xact_lock(:lock)"), {"lock": LOCK})
        current = set(MigrationContext.configure(conn).get_current_heads())
        if current - known:
            raise NewerStore(
                f"The store has schema {', '.join(sorted(current))}, which this version of Waypost does not know: "
                "use the newer version that wrote it, or another store."
            )
        settings.attributes["connection"] = conn
        command.upgrade(settings, "head")
