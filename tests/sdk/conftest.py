"""A real server for the tests of the public package."""

from collections.abc import Iterator

import pytest
from tests.sdk.kit import Service

from waypost_server import serving
from waypost_server.settings import Settings


@pytest.fixture(scope="module")
def served(tmp_path_factory) -> Iterator[serving.Served]:
    """One server for all tests; each test has runs of its own."""
    store = tmp_path_factory.mktemp("store") / "waypost.db"
    with serving.background(Settings(database=f"sqlite:///{store}")) as served:
        yield served


@pytest.fixture
def service(served, tmp_path) -> Iterator[Service]:
    service = Service(served, f"run of {tmp_path.name}")
    yield service
    service.close()
