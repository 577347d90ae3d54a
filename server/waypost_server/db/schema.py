"""The schema of a store: creates it in an empty database, and migrates a store of an older version on request."""

from dataclasses import dataclass
from pathlib import Path

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection, Engine, text

MIGRATIONS = Path(__file__).parent / "migrations"
LOCK = 7_296_011  # an arbitrary number; with it, servers that start at the same time migrate one after the other


class WrongSchema(Exception):
    """The store has the schema of another version. The message says what to do."""


class NewerStore(WrongSchema):
    """The store was written by a newer version."""


class OlderStore(WrongSchema):
    """The store was written by an older version and was not migrated."""


@dataclass(frozen=True)
class Migrated:
    """The schema of a store before and after a migration; before is None for an empty database."""

    before: str | None
    after: str


def config() -> Config:
    """Return Alembic's configuration for the migrations in this package."""
    found = Config()
    found.set_main_option("script_location", str(MIGRATIONS))
    found.set_main_option("path_separator", "os")
    return found


def create(engine: Engine) -> None:
    """Create this version's schema in an empty database; leave a store of this version as it is.

    Raises:
        NewerStore, OlderStore: the store has another schema.
    """
    with engine.begin() as conn:
        before, ours = _lock(conn), newest()
        if before is None:
            _upgrade(conn)
        elif before != ours:
            raise OlderStore(
                f"The store has schema {before}, and this version of Waypost uses {ours}: stop its "
                f"servers, and run `waypost migrate --database {engine.url.render_as_string()}`."
            )


def migrate(engine: Engine) -> Migrated:
    """Apply the migrations that a store lacks, in one transaction.

    Raises:
        NewerStore: the store has a schema that this version does not know.
    """
    with engine.begin() as conn:
        before = _lock(conn)
        _upgrade(conn)
    return Migrated(before, newest())


def newest() -> str:
    """Return the schema of this version."""
    return str(ScriptDirectory.from_config(config()).get_current_head())


def _lock(conn: Connection) -> str | None:
    """Keep others from migrating until the end of the transaction; return the store's schema, None if it is empty."""
    if conn.dialect.name == "postgresql":
        conn.execute(text("SELECT pg_advisory_xact_lock(:lock)"), {"lock": LOCK})
    before = MigrationContext.configure(conn).get_current_revision()
    known = {script.revision for script in ScriptDirectory.from_config(config()).walk_revisions()}
    if before is not None and before not in known:
        raise NewerStore(
            f"The store has schema {before}, which this version of Waypost does not know: "
            "use the newer version that wrote it, or another store."
        )
    return before


def _upgrade(conn: Connection) -> None:
    settings = config()
    settings.attributes["connection"] = conn
    command.upgrade(settings, "head")
