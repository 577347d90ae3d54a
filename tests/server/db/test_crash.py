"""Kill -9: what was acknowledged is there afterwards, and sending it again costs nothing."""

import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import httpx2
from tests.server.kit import Json, Service, in_process, query

N_QUERIES = 200


@contextmanager
def killed_server(url: str) -> Iterator[tuple[str, subprocess.Popen[str]]]:
    """Run `serve` in a process of its own, to be killed."""
    command = [sys.executable, "-u", "-m", "waypost_server.cli", "serve", "--port", "0", "--database", url]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[-1]
        process.stdout.readline()
        yield address, process
    finally:
        process.kill()
        process.wait()
        assert process.stdout is not None
        process.stdout.close()


def prepared(url: str) -> tuple[str, dict[str, str]]:
    """Fill a store with queries; returns the run and the annotator's headers."""
    with in_process(url) as service:
        run = service.learner.create_run(budget=N_QUERIES)
        service.learner.ask(run, *(query(ordinal=n) for n in range(N_QUERIES)))
        return run, service.annotator.headers


def answer_until_dead(address: str, run: str, headers: dict[str, str], done: list[tuple[Json, Json, Json]]) -> None:
    """Answer until the server is gone; the last answer may or may not have been stored."""
    with httpx2.Client(base_url=address, headers=headers, timeout=10) as client:
        try:
            while True:
                held = client.post("/api/v1/assignments", json={"run": run}).json()
                body = {"token": held["token"], "answer": {"kind": "inspect_full", "verdict": "fail"}}
                done.append((held, body, {}))
                done[-1] = (held, body, client.post(f"/api/v1/assignments/{held['id']}/answer", json=body).json())
        except httpx2.TransportError:
            return


def test_what_was_acknowledged_before_kill_9_is_kept_and_charged_once(database_url: str) -> None:
    run, headers = prepared(database_url)
    done: list[tuple[Json, Json, Json]] = []
    with killed_server(database_url) as (address, process):
        annotator = threading.Thread(target=answer_until_dead, args=(address, run, headers, done))
        annotator.start()
        while len(done) < 12:
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        annotator.join()
    acknowledged = [one for one in done if one[2]]
    assert len(acknowledged) >= 11
    with in_process(database_url) as service:
        before = service.learner.costs(run)["total"]
        assert before in {len(acknowledged), len(acknowledged) + 1}
        for held, body, receipt in done:
            reply: Any = service.client.post(f"/api/v1/assignments/{held['id']}/answer", json=body, headers=headers)
            assert reply.status_code == 200
            assert not receipt or reply.json() == receipt
        assert_charged_once(service, run, len(done))


def assert_charged_once(service: Service, run: str, n_answers: int) -> None:
    costs = service.learner.costs(run)
    assert (costs["total"], costs["reserved"]) == (n_answers, N_QUERIES - n_answers)
    assert costs["by_kind"]["inspect_full"]["queries"] == n_answers
    if service.db.url.get_backend_name() == "sqlite":
        check = service.db.read_now(lambda tx: tx.conn.exec_driver_sql("PRAGMA integrity_check").scalar_one())
        assert check == "ok"
