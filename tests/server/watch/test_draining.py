"""A server that is told to stop first says that it is not ready, and serves on until nobody sends it requests."""

import signal
import time
from pathlib import Path

import httpx2
import pytest
from tests.server.kit import in_process, query
from tests.server.processes import serving


def test_a_server_that_stops_is_not_ready_but_serves_on_for_a_while(sqlite_url: str, tmp_path: Path) -> None:
    with in_process(sqlite_url) as service:
        run, headers = service.learner.create_run(), service.learner.headers
    with serving(sqlite_url, tmp_path, {"drain_seconds": "4"}) as server:
        address, process = server.address, server.process
        process.send_signal(signal.SIGTERM)
        told = time.monotonic()
        time.sleep(0.5)
        for ordinal in range(3):  # each over a new connection, as from a proxy that has not noticed yet
            ready = httpx2.get(f"{address}/readyz")
            assert (ready.status_code, ready.json()["type"]) == (503, "/problems/stopping")
            assert httpx2.get(f"{address}/healthz").status_code == 200
            body = {"queries": [query(ordinal=ordinal)]}
            asked = httpx2.post(f"{address}/api/v1/runs/{run}/queries", json=body, headers=headers)
            assert asked.status_code == 200
        process.wait(15)
        assert 3.9 < time.monotonic() - told < 10
    with in_process(sqlite_url) as service:
        assert service.learner.get(f"/runs/{run}")["open_queries"] == 3


@pytest.mark.parametrize(
    ("signals", "drain_seconds"), [([signal.SIGTERM], 0), ([signal.SIGINT], 60), ([signal.SIGTERM, signal.SIGTERM], 60)]
)
def test_nobody_waits_without_a_reason(
    sqlite_url: str, tmp_path: Path, signals: list[signal.Signals], drain_seconds: float
) -> None:
    """The setting is 0, somebody pressed Ctrl-C, or the server was told a second time."""
    with serving(sqlite_url, tmp_path, {"drain_seconds": str(drain_seconds)}) as server:
        for one in signals:
            server.process.send_signal(one)
            time.sleep(0.5)
        server.process.wait(10)
