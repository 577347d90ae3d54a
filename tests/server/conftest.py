"""The service under test, on each database."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from sqlalchemy import make_url
from tests.server.kit import Service, in_process


@pytest.fixture
def service(database_url: str) -> Iterator[Service]:
    """The app with a user per role, in process; once on SQLite and once on PostgreSQL."""
    with in_process(database_url) as service:
        yield service


@pytest.fixture
def lite(sqlite_url: str, sqlite_store: Path) -> Iterator[Service]:
    """The app on SQLite alone, for what does not depend on the database."""
    shutil.copy(sqlite_store, str(make_url(sqlite_url).database))
    with in_process(sqlite_url) as service:
        yield service
