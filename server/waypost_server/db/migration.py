"""Migrates a store to this version's schema, after a backup: there is no way back."""

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from sqlalchemy.engine import URL

from waypost_server.db import engine, schema
from waypost_server.db.backup import CannotBackUp, back_up


@dataclass(frozen=True)
class Done:
    """A migration, and the backup that was made before; None if none was needed or wanted."""

    migrated: schema.Migrated
    backup: Path | None


def migrate(url: str, *, with_backup: bool = True) -> Done:
    """Bring a store up to this version's schema, or create it. An older store is backed up first.

    The backup of an SQLite store is beside it; that of a PostgreSQL store is in the working folder. Nobody else can
    migrate the store meanwhile.

    Raises:
        BadDatabase, NewerStore: with one sentence for the operator.
        CannotBackUp: the backup failed, and nothing was migrated.
    """
    copy = _copy_of(engine.parse(url))
    made: list[Path] = []

    def keep() -> None:
        try:
            back_up(url, copy)
        except CannotBackUp as error:
            raise CannotBackUp(f"{error} Nothing was migrated. --no-backup migrates without a backup.") from None
        made.append(copy)

    migrated = engine.migrate(url, keep) if with_backup else engine.migrate(url)
    return Done(migrated, made[0] if made else None)


def _copy_of(store: URL) -> Path:
    """Return the path for the backup of a store."""
    place = Path(str(store.database)) if store.get_backend_name() == "sqlite" else Path(f"{store.database}.dump")
    return place.with_name(f"{place.name}.before-{schema.newest()}-{datetime.now(UTC):%Y%m%d-%H%M%S}")
