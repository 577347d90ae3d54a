"""A real server process for each example."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.acceptance.processes import ServerProcess, free_port


@pytest.fixture
def server(tmp_path: Path) -> Iterator[ServerProcess]:
    process = ServerProcess(tmp_path, free_port())
    process.start()
    yield process
    process.stop()
