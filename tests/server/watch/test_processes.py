"""`serve --processes`: several processes on one port."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

import httpx2
import pytest
from tests.conftest import Cluster
from tests.server.kit import Caller, in_process, query
from tests.server.processes import Served, serving
from typer.testing import CliRunner

from waypost_server.cli.main import app

# Nothing but a notification wakes a long poll within this test.
SETTINGS = {"poll_seconds": "60", "drain_seconds": "3"}


def workers(parent: int) -> list[int]:
    """The processes that serve, by their numbers."""
    children = Path(f"/proc/{parent}/task/{parent}/children").read_text().split()
    return [int(one) for one in children if b"spawn_main" in Path(f"/proc/{one}/cmdline").read_bytes()]


def is_alive(process: int) -> bool:
    status = Path(f"/proc/{process}/stat")
    return status.exists() and status.read_text().rpartition(")")[2].split()[0] != "Z"


def wait_until(what: object, seconds: float = 20) -> None:
    assert callable(what)
    deadline = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < deadline
        time.sleep(0.1)


@contextmanager
def only(one: int, server: Served) -> Iterator[None]:
    """Let one of the processes accept connections, and stop the others meanwhile."""
    others = [other for other in workers(server.process.pid) if other != one]
    for other in others:
        os.kill(other, signal.SIGSTOP)
    try:
        yield
    finally:
        for other in others:
            os.kill(other, signal.SIGCONT)


@contextmanager
def pinned(server: Served) -> Iterator[list[httpx2.Client]]:
    """A client of each process: each keeps the connection that this process has accepted."""
    with ExitStack() as stack:
        clients = []
        for one in workers(server.process.pid):
            with only(one, server):
                clients.append(stack.enter_context(httpx2.Client(base_url=server.address, timeout=30)))
                assert clients[-1].get("/healthz").status_code == 200
        yield clients


@pytest.fixture
def url(cluster: Cluster) -> str:
    return cluster.create()


@pytest.fixture
def server(url: str, tmp_path: Path) -> Iterator[Served]:
    with in_process(url):
        pass  # makes the users, and their tokens
    with serving(url, tmp_path, SETTINGS, "--processes", "2") as server:
        wait_until(lambda: len(workers(server.process.pid)) == 2)
        yield server


def test_an_answer_in_one_process_wakes_a_long_poll_in_the_other(url: str, server: Served) -> None:
    with in_process(url) as service:
        tokens = {"lea": service.learner.token, "abe": service.annotator.token}
    with pinned(server) as (one, other), ThreadPoolExecutor() as pool:
        learner, annotator = Caller(one, "lea", tokens["lea"]), Caller(other, "abe", tokens["abe"])
        run = learner.create_run()
        (asked,) = learner.ask(run, query())
        lease = annotator.lease(run=run)
        poll = pool.submit(learner.get, f"/queries/{asked['id']}", params={"wait": 20})
        time.sleep(0.5)
        assert not poll.done()
        annotator.answer(lease)
        answered = time.monotonic()
        assert poll.result()["state"] == "answered"
        assert time.monotonic() - answered < 5


def test_sigterm_drains_all_processes(server: Served) -> None:
    both = workers(server.process.pid)
    with pinned(server) as clients:
        server.process.send_signal(signal.SIGTERM)
        time.sleep(0.5)
        for client in clients:
            ready = client.get("/readyz")
            assert (ready.status_code, ready.json()["type"]) == (503, "/problems/stopping")
            assert client.get("/healthz").status_code == 200
    assert server.process.wait(20) == -signal.SIGTERM
    assert not any(is_alive(one) for one in both)


def test_a_process_that_is_killed_is_replaced(server: Served) -> None:
    killed, left = workers(server.process.pid)
    os.kill(killed, signal.SIGKILL)
    wait_until(lambda: len(set(workers(server.process.pid)) - {killed, left}) == 1)
    (new,) = set(workers(server.process.pid)) - {left}
    os.kill(left, signal.SIGSTOP)
    try:
        assert httpx2.get(f"{server.address}/readyz", timeout=30).status_code == 200, "the new one serves"
    finally:
        os.kill(left, signal.SIGCONT)
    assert is_alive(new)


def test_ctrl_c_in_a_terminal_reaches_the_first_process_alone(server: Served) -> None:
    """It passes the signal on. A process that gets it twice does not wait for open requests."""
    first = os.getpgid(server.process.pid)
    wait_until(lambda: all(os.getpgid(one) != first for one in workers(server.process.pid)))  # one may still start


def test_a_process_that_cannot_start_ends_all(url: str, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "waypost_server.cli", "serve", "--port", "0", "--database", url]
    environment = {**os.environ, "WAYPOST_PRACTICE": str(tmp_path / "missing.json")}
    done = subprocess.run(
        [*command, "--processes", "2"], env=environment, capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 2
    assert done.stderr.endswith("A server process did not start; see its log.\n")
    assert "missing.json has no practice queries" in done.stderr


def test_no_process_outlives_the_first(server: Served) -> None:
    both = workers(server.process.pid)
    server.process.kill()
    wait_until(lambda: not any(is_alive(one) for one in both))


def test_an_sqlite_store_is_for_one_process(sqlite_url: str) -> None:
    refused = CliRunner().invoke(app, ["serve", "--processes", "2", "--database", sqlite_url])
    assert refused.exit_code == 2
    assert "Leave out --processes, or give --database postgresql://" in refused.output
    assert not Path(sqlite_url.removeprefix("sqlite:///")).exists()
