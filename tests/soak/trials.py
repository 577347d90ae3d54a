"""Trials that try to make a store lose an answer. Each takes some seconds, and counts what it did and what was wrong.

The seed decides when servers are killed, which calls fail, and what power losses leave. It does not decide how the
threads of clients and server take turns.
"""

import errno
import random
import signal
import threading
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

from tests.conftest import Cluster
from tests.server.disk.disk import Call, File
from tests.server.disk.load import Told, answer_all, proof, send_again, team
from tests.server.disk.recording import Recording
from tests.server.processes import serving

from waypost_server.db import backup

Trial = Callable[[Path, int], Counter[str]]

N_ANNOTATORS = 4
N_QUERIES = 400
SHORTEST, LONGEST = 0.1, 1.5  # seconds until a server is killed


def power(folder: Path, seed: int) -> Counter[str]:
    """Record a server that is killed, and one that is stopped; let the power fail at every sync and acknowledgment."""
    recording = Recording(folder)
    recording.answer_and_end(recording.fill(48, N_ANNOTATORS), seed, 12)
    return _told(recording.told) + _after_losses(recording, seed)


def faults(folder: Path, seed: int) -> Counter[str]:
    """Let calls of a server's disk fail, then kill the server; let the power fail at every eleventh such moment."""
    recording, choose = Recording(folder), random.Random(seed)
    people, failed = recording.fill(N_QUERIES, N_ANNOTATORS), 0
    with recording.serving() as server:
        for number in range(12):
            calls = choose.choice([Call.WRITE, Call.SYNC, Call.WRITE | Call.SYNC])
            skip = choose.randrange(4 if calls is Call.SYNC else 40)
            file = choose.choice([None, None, File.STORE])
            recording.disk.fail(choose.choice([errno.EIO, errno.ENOSPC]), calls, file, skip=skip, times=1 + number % 3)
            recording.answer(server, people, seed + number, 3)
            recording.disk.heal()
            failed += recording.disk.failed
        server.process.send_signal(signal.SIGKILL)
        server.process.wait()
    wrong = proof(recording.disk.url, recording.told)
    wrong["other receipts"] += send_again(recording.disk.url, recording.told)
    return _told(recording.told) + Counter({"faults": failed}) + wrong + _after_losses(recording, seed, 11)


def kills(url: str, folder: Path, seed: int) -> Counter[str]:
    """Kill five servers, one after the other, while annotators answer."""
    told, choose, counts = Told(), random.Random(seed), Counter[str]()
    people = team(url, N_QUERIES, N_ANNOTATORS)
    for number in range(5):
        with serving(url, folder, {}) as server:
            work = (server.address, people, told, lambda: 0, seed + number, N_QUERIES)
            answering = threading.Thread(target=answer_all, args=work)
            answering.start()
            time.sleep(choose.uniform(SHORTEST, LONGEST))
            server.process.send_signal(signal.SIGKILL)
            server.process.wait()
            answering.join()
        counts["kills"] += 1
        counts += proof(url, told)
    counts["other receipts"] += send_again(url, told)
    return _told(told) + counts


def backups(folder: Path, seed: int) -> Counter[str]:
    """Back up a store five times while annotators answer, and restore each backup."""
    told, counts, url = Told(), Counter[str](), f"sqlite:///{folder / 'store.db'}"
    people = team(url, N_QUERIES, N_ANNOTATORS)
    with serving(url, folder, {}) as server:
        work = (server.address, people, told, lambda: 0, seed, N_QUERIES)
        answering = threading.Thread(target=answer_all, args=work)
        answering.start()
        for number in range(5):
            time.sleep(0.2)
            before, copy = told.so_far(), folder / f"{number}.backup"
            backup.back_up(url, copy)
            restored = f"sqlite:///{folder / f'{number}.db'}"
            backup.restore(copy, restored)
            counts["backups restored"] += 1
            counts += proof(restored, before)
        server.process.send_signal(signal.SIGKILL)
        answering.join()
    return _told(told) + counts + proof(url, told)


def every(cluster: Cluster | None) -> dict[str, Trial]:
    """Return all trials by name; without a cluster, those of SQLite."""
    trials: dict[str, Trial] = {
        "power": power,
        "faults": faults,
        "kills": lambda folder, seed: kills(f"sqlite:///{folder / 'store.db'}", folder, seed),
        "backups": backups,
    }
    if cluster is not None:
        trials["kills, PostgreSQL"] = lambda folder, seed: kills(cluster.create(), folder, seed)
    return trials


def _told(told: Told) -> Counter[str]:
    return Counter({"acknowledged": len(told.acknowledged()), "refused": told.statuses[503]})


def _after_losses(recording: Recording, seed: int, step: int = 1) -> Counter[str]:
    counts = Counter[str]()
    for loss in recording.losses(seed, step):
        counts += Counter({"power losses": 1}) + recording.wrong([loss])
    return counts
