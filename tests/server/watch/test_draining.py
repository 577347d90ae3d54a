"""A server that is told to stop first says that it is not ready, and serves on until nobody sends it requests."""

import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

import httpx2
import pytest
from tests.server.kit import in_process, query


@contextmanager
def serving(
    url: str, monkeypatch: pytest.MonkeyPatch, drain_seconds: float
) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """Run `serve` in a process of its own."""
    monkeypatch.setenv("WAYPOST_DRAIN_SECONDS", str(drain_seconds))
    command = [sys.executable, "-u", "-m", "waypost_server.cli", "serve", "--port", "0", "--database", url]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[-1]
        wait_for(address)
        yield address, process
    finally:
        process.kill()
        process.wait()
        assert process.stdout is not None
        process.stdout.close()


def wait_for(address: str) -> None:
    deadline = time.monotonic() + 20
    while True:
        try:
            assert httpx2.get(f"{address}/readyz").status_code == 200
        except httpx2.TransportError:
            assert time.monotonic() < deadline
            time.sleep(0.1)
        else:
            return


def test_a_server_that_stops_is_not_ready_but_serves_on_for_a_while(
    sqlite_url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    with in_process(sqlite_url) as service:
        run, headers = service.learner.create_run(), service.learner.headers
    with serving(sqlite_url, monkeypatch, 4) as (address, process):
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
    sqlite_url: str, monkeypatch: pytest.MonkeyPatch, signals: list[signal.Signals], drain_seconds: float
) -> None:
    """The setting is 0, somebody pressed Ctrl-C, or the server was told a second time."""
    with serving(sqlite_url, monkeypatch, drain_seconds) as (_, process):
        for one in signals:
            process.send_signal(one)
            time.sleep(0.5)
        process.wait(10)
