"""A disk that fails: the server refuses with 503, acknowledges nothing that it did not store, and goes on by itself."""

import errno
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

import httpx2
import pytest
from tests.server.disk.disk import Call, File
from tests.server.disk.load import Team, proof, send_again
from tests.server.disk.recording import Recording
from tests.server.kit import API, in_process
from tests.server.processes import Served

N_ANNOTATORS = 3
SEED = 20261126
RECOVERY_SECONDS = 5.0
FAULTS = [(errno.ENOSPC, Call.WRITE), (errno.EIO, Call.WRITE), (errno.EIO, Call.SYNC)]


@pytest.fixture
def recording(tmp_path: Path) -> Recording:
    return Recording(tmp_path)


def end(recording: Recording, server: Served, step: int) -> None:
    """Kill the server. What it left must be sound, also after power losses while the disk failed."""
    server.process.send_signal(signal.SIGKILL)
    server.process.wait()
    assert set(recording.told.statuses) <= {200, 201, 503}
    assert recording.wrong(recording.losses(SEED, step)) == Counter()
    assert proof(recording.disk.url, recording.told) == Counter()
    assert send_again(recording.disk.url, recording.told) == 0


def test_the_failure_of_any_write_or_sync_loses_nothing(recording: Recording) -> None:
    people = recording.fill(100, N_ANNOTATORS)
    with recording.serving() as server:
        for number, (what, calls) in enumerate(FAULTS * 2):
            recording.disk.fail(what, calls, skip=number * 7 % (30 if calls is Call.WRITE else 4), times=2)
            recording.answer(server, people, SEED + number, 2)
            recording.disk.heal()
            assert set(recording.told.statuses) <= {200, 201, 503}
            assert recording.disk.failed > 0
        assert recording.told.statuses[503] > 0
        assert len(recording.told.acknowledged()) == 2 * N_ANNOTATORS * 2 * len(FAULTS)
        end(recording, server, 61)


def test_while_a_disk_fails_changes_are_refused_and_afterwards_the_server_goes_on(recording: Recording) -> None:
    people = recording.fill(20, N_ANNOTATORS)
    with recording.serving() as server, httpx2.Client(base_url=server.address) as client:
        for number, (what, calls) in enumerate(FAULTS):
            recording.disk.fail(what, calls)
            assert_refused(client, people)
            recording.disk.heal()
            healed = time.monotonic()
            recording.answer(server, people, SEED + number, 1)
            assert becomes(client, 200)
            assert time.monotonic() - healed < RECOVERY_SECONDS
            assert len(recording.told.acknowledged()) == N_ANNOTATORS * (number + 1)
        end(recording, server, 21)


def assert_refused(client: httpx2.Client, people: Team) -> None:
    """Changes are refused, and the server is not ready. Reads are served."""
    reply = client.post(f"{API}/assignments", json={"run": people.run}, headers=people.annotators[0])
    assert (reply.status_code, reply.json()["type"]) == (503, "/problems/storage-failed")
    assert "retry-after" in reply.headers
    assert becomes(client, 503), "a server may repeat what it found a second ago"
    assert client.get("/healthz").status_code == 200
    assert client.get(f"{API}/runs", headers=people.annotators[0]).is_success


def becomes(client: httpx2.Client, status: int) -> bool:
    """Whether the server is ready, or is not, within two seconds."""
    until = time.monotonic() + 2
    while client.get("/readyz").status_code != status:
        if time.monotonic() > until:
            return False
        time.sleep(0.05)
    return True


def test_answers_are_stored_while_the_log_cannot_be_copied_into_the_store(recording: Recording) -> None:
    people = recording.fill(60, N_ANNOTATORS)
    with recording.serving() as server:
        recording.disk.fail(errno.EIO, Call.WRITE | Call.SYNC, File.STORE)
        recording.answer(server, people, SEED, 14)
        assert recording.disk.failed > 0
        assert (recording.told.statuses[503], len(recording.told.acknowledged())) == (0, 14 * N_ANNOTATORS)
        recording.disk.heal()
        recording.answer(server, people, SEED + 1, 3)
        assert File.STORE in {one.file for one in recording.disk.records() if one.call is Call.SYNC and not one.failed}
        end(recording, server, 61)


def test_an_answer_whose_sync_failed_may_be_stored_after_all_and_sent_again_it_is_charged_once(
    recording: Recording,
) -> None:
    people = recording.fill(1, 1)
    headers = people.annotators[0]
    with recording.serving() as server, httpx2.Client(base_url=server.address, headers=headers) as client:
        held = client.post(f"{API}/assignments", json={"run": people.run}).json()
        body = {"token": held["token"], "answer": {"kind": "inspect_full", "verdict": "pass"}}
        path = f"{API}/assignments/{held['id']}/answer"
        recording.disk.fail(errno.EIO, Call.SYNC)
        reply = client.post(path, json=body)
        assert (reply.status_code, reply.json()["detail"][:40]) == (503, "It is not known whether this was stored ")
        server.process.send_signal(signal.SIGKILL)
        server.process.wait()
    with in_process(recording.disk.url) as service:
        assert service.learner.costs(people.run)["total"] == 1, "the whole transaction is in the log"
        for _ in range(2):
            assert service.client.post(path, json=body, headers=headers).status_code == 200
        assert service.learner.costs(people.run)["total"] == 1


def test_a_server_does_not_start_on_a_disk_that_fails(recording: Recording) -> None:
    recording.fill(1, 1)
    recording.disk.fail(errno.EIO, Call.WRITE)
    command = [sys.executable, "-m", "waypost_server.cli", "serve", "--port", "0", "--database", recording.disk.url]
    environment = {**os.environ, **recording.disk.environment}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=30)
    assert done.returncode != 0
    assert "disk I/O error" in done.stderr
    assert "Traceback" not in done.stderr
