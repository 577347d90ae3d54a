"""Backs up a store while servers use it, and restores it.

A backup of SQLite is a store, made by SQLite's online backup; of PostgreSQL it is an archive of `pg_dump`. Both show
one moment. A backup has its name only once it is complete and on disk.
"""

import os
import secrets
import shutil
import sqlite3
import subprocess
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy.engine import URL

from waypost_server import errors
from waypost_server.db import checking
from waypost_server.db.engine import BadDatabase, Database, parse
from waypost_server.db.schema import OlderStore, WrongSchema


class CannotBackUp(Exception):
    """A backup or a restoration failed. The message says why, and what to do."""


def back_up(url: str, to: Path) -> None:
    """Write a backup of a store.

    Raises:
        BadDatabase: the URL is not one of a store.
        CannotBackUp: there is such a file, or no such store, or the backup could not be written.
    """
    store = parse(url)
    if to.exists():
        raise CannotBackUp(f"{to} exists, and a backup never replaces a file: choose another name.")
    with _named_when_whole(to) as part:
        if store.get_backend_name() == "sqlite":
            _copy(_file_of(store), part)
        else:
            _run("pg_dump", "--format=custom", f"--file={part}", store)


@dataclass(frozen=True)
class Restored:
    """A restored store.

    Args:
        wrong: the checks that it does not pass.
        older: whether an earlier version wrote it. Then only the file was checked.
    """

    wrong: list[checking.Result]
    older: bool = False


def restore(file: Path, url: str, *, anyway: bool = False) -> Restored:
    """Restore a backup as a store that does not exist yet (SQLite), or in an empty database (PostgreSQL).

    The store is checked. With a fault, an SQLite store gets its name only if `anyway`; a PostgreSQL store stays.

    Raises:
        BadDatabase: the URL is not one of a store.
        CannotBackUp: the file is no sound backup, or there is a store already.
    """
    store = parse(url)
    if not file.is_file():
        raise CannotBackUp(f"There is no file {file}.")
    if store.get_backend_name() != "sqlite":
        _run("pg_restore", "--exit-on-error", "--single-transaction", "--no-owner", store, str(file))
        return _checked(url)
    target = Path(str(store.database))
    if target.exists():
        raise CannotBackUp(f"{target} exists: move it away first, or restore to another file.")
    with _named_when_whole(target) as part:
        try:
            _copy(file, part)
            found = _checked(f"sqlite:///{part}")
        except (sqlite3.DatabaseError, BadDatabase, WrongSchema, errors.StorageFailed) as error:
            raise CannotBackUp(f"{file} is not a sound backup of a store: {error}") from None
        if found.wrong and not anyway:
            raise CannotBackUp(
                f"{file} is not a sound backup of a store. Not so: {' '.join(one.fact for one in found.wrong)} "
                "With --anyway, it is restored as it is."
            )
    return found


def _checked(url: str) -> Restored:
    """Check a store that was just restored."""
    try:
        with closing(Database(url, create=False)) as db:
            results = db.read_now(checking.check)
    except OlderStore:
        return Restored(checking.check_file(url), older=True)
    return Restored([one for one in results if one.n_faults])


@contextmanager
def _named_when_whole(target: Path) -> Iterator[Path]:
    """Give the path of a file to write. Afterwards it gets its name, unless something failed or took the name."""
    part = target.with_name(f".{target.name}.{secrets.token_hex(4)}")
    try:
        yield part
        _to_disk(part)
        os.link(part, target)  # unlike a renaming, it fails if the name was taken meanwhile
        _to_disk(target.parent)
    except (OSError, sqlite3.Error) as error:
        raise CannotBackUp(f"{target} could not be written: {error}.") from None
    finally:
        for left in (part, *(part.with_name(part.name + end) for end in ("-wal", "-shm"))):
            left.unlink(missing_ok=True)


def _file_of(store: URL) -> Path:
    file = Path(str(store.database))
    if not file.is_file():
        raise CannotBackUp(f"There is no store {file}.")
    return file


def _copy(store: Path, part: Path) -> None:
    with (
        closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as source,
        closing(sqlite3.connect(part)) as target,
    ):
        source.backup(target)
        target.execute("PRAGMA journal_mode = DELETE")  # so that the copy is one file, also while somebody reads it


def _run(program: str, *arguments: str | URL) -> None:
    """Run a program of PostgreSQL. Its URL becomes a connection string, its password stays out of the process list."""
    found = shutil.which(program)
    if found is None:
        raise CannotBackUp(
            f"{program} was not found: install PostgreSQL's client programs (on Debian: postgresql-client)."
        )
    environment = dict(os.environ)
    command = [found]
    for one in arguments:
        if isinstance(one, URL):
            if one.password is not None:
                environment["PGPASSWORD"] = str(one.password)
            plain = one.set(drivername="postgresql", password=None)
            command.append(f"--dbname={plain.render_as_string(hide_password=False)}")
        else:
            command.append(one)
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)  # noqa: S603 - no shell
    if done.returncode:
        raise CannotBackUp(f"{program} failed: {done.stderr.strip()}")


def _to_disk(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
