"""Databases and servers for every test: SQLite files, and a PostgreSQL cluster of the test session's own."""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack
from functools import cached_property
from itertools import count
from pathlib import Path
from typing import Any

import psycopg
import pytest
from sqlalchemy import make_url

from waypost_server import serving
from waypost_server.db.engine import Database
from waypost_server.settings import Settings

_numbers = count()


def postgresql_binaries() -> Path | None:
    """Return the folder of initdb and pg_ctl."""
    found = shutil.which("pg_ctl")
    folders = [Path(found).resolve().parent] if found else []
    folders += sorted(Path("/usr/lib/postgresql").glob("*/bin"), reverse=True)
    return next((folder for folder in folders if (folder / "initdb").is_file()), None)


class Cluster:
    """A PostgreSQL cluster on a socket in a folder of its own; as root it runs as the user `postgres`.

    Args:
        binaries: the folder with `initdb` and `pg_ctl`.
        folder: where everything goes.
        fsync: whether commits wait for the disk.
        variables: environment variables for its processes, beside those of this one.
    """

    def __init__(
        self, binaries: Path, folder: Path, *, fsync: bool = False, variables: Mapping[str, str] | None = None
    ) -> None:
        self.binaries = binaries
        self._folder = folder
        self._variables = os.environ | (variables or {})
        self._account: dict[str, Any] = {}
        if os.geteuid() == 0:
            self._account = {"user": "postgres", "group": "postgres", "extra_groups": []}
            shutil.chown(folder, "postgres", "postgres")
        data = str(folder / "data")
        sync = "on" if fsync else "off"
        options = f"-c listen_addresses='' -c unix_socket_directories={folder} -c fsync={sync} -c max_connections=200"
        self._run("initdb", "--no-sync", "-A", "trust", "-U", "postgres", "-E", "UTF8", "--locale=C", "-D", data)
        self._run("pg_ctl", "-w", "-D", data, "-l", str(folder / "log"), "-o", options, "start")
        self._conn = psycopg.connect(host=str(folder), user="postgres", autocommit=True)

    @cached_property
    def _store(self) -> str:
        """The name of a database with a store that nobody has used."""
        url = self.create_empty()
        Database(url).close()
        return name_of(url)

    def create(self) -> str:
        """Create a database with a new store, and return its URL. To copy one takes half as long as to create one."""
        return self._create(self._store)

    def create_empty(self) -> str:
        """Create an empty database and return its URL."""
        return self._create("template0")

    def _create(self, template: str) -> str:
        name = f"waypost_{next(_numbers)}"
        self._conn.execute(f"CREATE DATABASE {name} TEMPLATE {template}")  # type: ignore[call-overload]  # no literal
        return f"postgresql://postgres@/{name}?host={self._folder}"

    def drop(self, url: str) -> None:
        """Drop a database, even if it is in use."""
        self._conn.execute(f"DROP DATABASE {name_of(url)} WITH (FORCE)")  # type: ignore[call-overload]  # no literal

    def stop(self) -> None:
        """Stop the cluster."""
        self._conn.close()
        self._run("pg_ctl", "-D", str(self._folder / "data"), "-m", "immediate", "stop")

    def _run(self, program: str, *arguments: str) -> None:
        done = subprocess.run(
            [self.binaries / program, *arguments],
            cwd=self._folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE if program != "pg_ctl" else subprocess.DEVNULL,
            check=False,
            env=self._variables,
            **self._account,
        )
        if done.returncode != 0:
            raise RuntimeError(f"{program} failed: {(done.stderr or b'').decode()}")


@pytest.fixture(scope="session")
def cluster() -> Iterator[Cluster]:
    """A PostgreSQL cluster; skips where PostgreSQL is not installed."""
    binaries = postgresql_binaries()
    if binaries is None:
        pytest.skip("no PostgreSQL binaries (initdb, pg_ctl) on this machine")
    with tempfile.TemporaryDirectory(prefix="wp") as folder:
        cluster = Cluster(binaries, Path(folder))
        try:
            yield cluster
        finally:
            cluster.stop()


def name_of(url: str) -> str:
    """Return the name of the database that a URL of PostgreSQL leads to."""
    return str(make_url(url).database)


@pytest.fixture
def sqlite_url(tmp_path: Path) -> str:
    """The URL of an SQLite store that does not exist yet."""
    return f"sqlite:///{tmp_path / f'waypost{next(_numbers)}.db'}"


@pytest.fixture(scope="session")
def sqlite_store(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An SQLite store that nobody has used, to copy: this takes a third of the time that creating one takes."""
    if known := os.environ.get("WAYPOST_TEST_STORE"):  # made once for thousands of test sessions (`make mutants`)
        return Path(known)
    path = tmp_path_factory.mktemp("store") / "waypost.db"
    Database(f"sqlite:///{path}").close()
    return path


@pytest.fixture(params=["sqlite", "postgresql"])
def database_url(request: pytest.FixtureRequest) -> Iterator[str]:
    """The URL of a new store; the test runs once for each kind of database."""
    if request.param == "sqlite":
        url: str = request.getfixturevalue("sqlite_url")
        shutil.copy(request.getfixturevalue("sqlite_store"), str(make_url(url).database))
        yield url
    else:
        cluster: Cluster = request.getfixturevalue("cluster")
        url = cluster.create()
        yield url
        cluster.drop(url)


@pytest.fixture(params=["sqlite", "postgresql"])
def empty_url(request: pytest.FixtureRequest) -> Iterator[str]:
    """The URL of a database without a store; the test runs once for each kind of database."""
    if request.param == "sqlite":
        yield str(request.getfixturevalue("sqlite_url"))
    else:
        cluster: Cluster = request.getfixturevalue("cluster")
        url = cluster.create_empty()
        yield url
        cluster.drop(url)


@pytest.fixture
def start_server() -> Iterator[Callable[[Settings], serving.Served]]:
    """Start real servers on threads; all stop when the test ends."""
    with ExitStack() as stack:
        yield lambda settings: stack.enter_context(serving.background(settings))
