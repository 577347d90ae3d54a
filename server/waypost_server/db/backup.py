"""Backs up a store while servers use it, and restores it.

A backup of SQLite is a store, made by SQLite's online backup; of PostgreSQL it is an archive of `pg_dump`. Both show
one moment. A backup has its name only once it is complete and on disk.
"""

import os
import secrets
import shutil
import sqlite3
import subprocess
from contextlib import closing, suppress
from pathlib import Path

from sqlalchemy.engine import URL

from waypost_server.db.engine import parse


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
    part = to.with_name(f".{to.name}.{secrets.token_hex(4)}")
    try:
        if store.get_backend_name() == "sqlite":
            _copy(_file_of(store), part)
        else:
            _run("pg_dump", "--format=custom", f"--file={part}", store)
        _to_disk(part)
        os.link(part, to)  # unlike a renaming, it fails if the name was taken meanwhile
        _to_disk(to.parent)
    except (OSError, sqlite3.Error) as error:
        raise CannotBackUp(f"The backup could not be written: {error}.") from None
    finally:
        with suppress(FileNotFoundError):
            part.unlink()


def restore(file: Path, url: str) -> None:
    """Restore a backup as a store that does not exist yet (SQLite), or in an empty database (PostgreSQL).

    Raises:
        BadDatabase: the URL is not one of a store.
        CannotBackUp: the file is no backup, or there is a store already.
    """
    store = parse(url)
    if not file.is_file():
        raise CannotBackUp(f"There is no file {file}.")
    if store.get_backend_name() != "sqlite":
        _run("pg_restore", "--exit-on-error", "--single-transaction", "--no-owner", store, str(file))
        return
    target = Path(str(store.database))
    if target.exists():
        raise CannotBackUp(f"{target} exists: move it away first, or restore to another file.")
    _check_file(file)
    back_up(f"sqlite:///{file}", target)


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


def _check_file(file: Path) -> None:
    try:
        with closing(sqlite3.connect(f"file:{file}?mode=ro", uri=True)) as source:
            sound = source.execute("PRAGMA quick_check").fetchone()[0] == "ok"
            sound = sound and source.execute("SELECT count(*) FROM alembic_version").fetchone()[0] == 1
    except sqlite3.DatabaseError:
        sound = False
    if not sound:
        raise CannotBackUp(f"{file} is not a sound backup of a store.")


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
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)  # noqa: S603
    if done.returncode:
        raise CannotBackUp(f"{program} failed: {done.stderr.strip()}")


def _to_disk(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
