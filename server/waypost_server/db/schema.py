"""The schema of a store: creates it in an empty database, and migrates a store of an older version on request."""

from collections.abc import Callable
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


class NoStore(WrongSchema):
    """There is no store."""


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
        _lock(conn)
        before = _known(conn)
        if before is None:
            _upgrade(conn)
        else:
            _refuse_older(engine, before)


def require(engine: Engine) -> None:
    """Leave a store of this version as it is.

    Raises:
        NewerStore, OlderStore, NoStore: the store has another schema, or there is none.
    """
    with engine.begin() as conn:
        before = _known(conn)
    if before is None:
        raise NoStore(f"There is no store in {engine.url.render_as_string()}.")
    _refuse_older(engine, before)


def migrate(engine: Engine, keep: Callable[[], None]) -> Migrated:
    """Apply the migrations that a store lacks, in one transaction.

    Args:
        engine: writes to the store.
        keep: is called before a store is changed, while nobody else can migrate it; it may read the store.

    Raises:
        NewerStore: the store has a schema that this version does not know.
    """
    with engine.begin() as conn:
        _lock(conn)
        before = _known(conn)
        if before not in {None, newest()}:
            keep()
        _upgrade(conn)
    return Migrated(before, newest())


def newest() -> str:
    """Return the schema of this version."""
    return str(ScriptDirectory.from_config(config()).get_current_head())


def _lock(conn: Connection) -> None:
    """Keep others from migrating until the end of the transaction, however long it takes."""
    if conn.dialect.name == "postgresql":
        conn.execute(text("SET LOCAL statement_timeout = 0"))
        conn.execute(text("SET LOCAL idle_in_transaction_session_timeout = 0"))
        conn.execute(text("SELECT pg_advisory_xact_lock(:lock)"), {"lock": LOCK})


def _known(conn: Connection) -> str | None:
    """Return the schema of a store; None if the database is empty."""
    found = MigrationContext.configure(conn).get_current_revision()
    known = {script.revision for script in ScriptDirectory.from_config(config()).walk_revisions()}
    if found is not None and found not in known:
        raise NewerStore(
            f"The store has schema {found}, which this version of Waypost does not know: "
            "use the newer version that wrote it, or another store."
        )
    return found


def _refuse_older(engine: Engine, found: str) -> None:
    if found != newest():
        raise OlderStore(
            f"The store has schema {found}, and this version of Waypost uses {newest()}: stop its "
            f"servers, and run `waypost migrate --database {engine.url.render_as_string()}`."
        )


def _upgrade(conn: Connection) -> None:
    settings = config()
    settings.attributes["connection"] = conn
    command.upgrade(settings, "head")
