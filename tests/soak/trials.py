"""Trials that try to make a store lose an answer. Each takes some seconds, and counts what it did and what was wrong.

The seed decides when servers are killed, which calls fail, and what power losses leave. It does not decide how the
threads of clients and server take turns.
"""

import asyncio
import errno
import random
import signal
import threading
import time
from collections import Counter
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from tests.conftest import Cluster
from tests.server.answers.model import run_schedules
from tests.server.db.racing import race
from tests.server.disk.disk import Call, File
from tests.server.disk.load import Answer, Told, answer_all, proof, send_again, take_and_vanish, team
from tests.server.disk.recording import Recording
from tests.server.kit import in_one_thread
from tests.server.processes import serving
from tests.soak.link import Link

from waypost import wire
from waypost.client import Client
from waypost_server.db import backup

Trial = Callable[[Path, int], Counter[str]]

N_ANNOTATORS = 4
N_QUERIES = 400
N_KILLED = 1_200  # queries, for servers that are killed
N_RACED = 2_000
N_SCHEDULES = 100
SHORTEST, LONGEST = 0.1, 1.5  # seconds until a server is killed
LEASE_SECONDS = 2
CLOCKS = ("+1h", "-1h", "+1d", "-1d", "+0", "+2h", "-2h", "+90d", "-90d", "+3s", "-3s", "+0")  # beside the true time
EARLIEST = "-91d"
CLOCK = "clock"  # the file with the time of a stepped clock
CUT_RATE = 0.1  # of the requests


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
    """Kill ten servers, one after the other, while annotators answer."""
    told, choose, counts = Told(), random.Random(seed), Counter[str]()
    people = team(url, N_KILLED, N_ANNOTATORS)
    for number in range(10):
        with serving(url, folder, {}) as server:
            work = (server.address, people, told, lambda: 0, seed + number, N_KILLED)
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


def kills_of_one_of_two(url: str, folder: Path, seed: int) -> Counter[str]:
    """Ten times, kill one of two servers while annotators answer; those of the killed one go on at the other."""
    told, choose, counts = Told(), random.Random(seed), Counter[str]()
    people = team(url, N_KILLED, 2 * N_ANNOTATORS)
    some = replace(people, annotators=people.annotators[:N_ANNOTATORS])
    others = replace(people, annotators=people.annotators[N_ANNOTATORS:])
    (second := folder / "second").mkdir()
    for number in range(10):
        how = (told, lambda: 0, seed + number)
        with serving(url, folder, {}) as killed, serving(url, second, {}) as kept, ThreadPoolExecutor() as pool:
            at_killed = pool.submit(answer_all, killed.address, some, *how, N_KILLED)
            at_kept = pool.submit(answer_all, kept.address, others, *how, N_KILLED)
            time.sleep(choose.uniform(SHORTEST, LONGEST))
            killed.process.send_signal(signal.SIGKILL)
            killed.process.wait()
            at_killed.result()
            answer_all(kept.address, some, *how, 5)
            kept.process.send_signal(signal.SIGTERM)
            kept.process.wait()
            at_kept.result()
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


def cuts(url: str, folder: Path, seed: int) -> Counter[str]:
    """Let annotators answer with the client of the public package, through a network that breaks connections."""
    told = Told()
    people = team(url, N_QUERIES, N_ANNOTATORS)
    with serving(url, folder, {}) as server:
        link = Link(urlsplit(server.address).port or 0, CUT_RATE, seed)
        with link.serving() as address, ThreadPoolExecutor(N_ANNOTATORS) as pool:
            list(pool.map(lambda headers: _annotate(address, headers, people.run, told), people.annotators))
    counts = Counter({"link cuts": link.cuts.total(), "not answered": N_QUERIES - len(told.answers)})
    return _told(told) + counts + proof(url, told) + Counter({"other receipts": send_again(url, told)})


def clocks(folder: Path, seed: int) -> Counter[str]:
    """Set the clock of a server and its store forward and back while annotators answer; then empty the queue."""
    return _clocks(f"sqlite:///{folder / 'store.db'}", folder, seed, _stepped(folder))


def clocks_of_postgresql(binaries: Path, folder: Path, seed: int) -> Counter[str]:
    """Do the same with a PostgreSQL whose clock is not the server's."""
    (place := folder / "cluster").mkdir()
    cluster = Cluster(binaries, place, fsync=True, variables=_stepped(folder))
    try:
        return _clocks(cluster.create(), folder, seed, {})
    finally:
        cluster.stop()


def _stepped(folder: Path) -> dict[str, str]:
    """Return the environment of a program whose clock is as far from the true time as a file in the folder says."""
    library = next(Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"), None)
    if library is None:
        pytest.skip("there is no libfaketime on this machine (Debian: faketime)")
    (clock := folder / CLOCK).write_text("+0")
    folder.chmod(0o755)  # PostgreSQL runs as another user than root, and reads the file
    faked = {"LD_PRELOAD": str(library), "FAKETIME_TIMESTAMP_FILE": str(clock), "FAKETIME_NO_CACHE": "1"}
    return faked | {"FAKETIME_DONT_FAKE_MONOTONIC": "1"}


def _clocks(url: str, folder: Path, seed: int, variables: Mapping[str, str]) -> Counter[str]:
    told, choose = Told(), random.Random(seed)
    steps = [*choose.sample(CLOCKS, len(CLOCKS)), EARLIEST]  # so that leases of the future are left at the end
    people = team(url, N_QUERIES, N_ANNOTATORS)
    settings = {"lease_seconds": str(LEASE_SECONDS)}
    with serving(url, folder, settings, variables=variables) as server:
        work = (server.address, people, told, lambda: 0, seed, N_QUERIES)
        answering = threading.Thread(target=answer_all, args=work)
        answering.start()
        for step in steps:
            time.sleep(choose.uniform(0.1, 0.5))
            take_and_vanish(server.address, people)
            (folder / CLOCK).write_text(step)
        answering.join()
        time.sleep(LEASE_SECONDS + 2)  # leases end after two seconds, and the server looks once a second
        answer_all(*work)
    counted = len({one.assignment for one in told.acknowledged()})
    return _told(told) + Counter({"clock steps": len(steps), "not answered": N_QUERIES - counted}) + proof(url, told)


def races(url: str, folder: Path, seed: int) -> Counter[str]:
    """Let 64 annotators empty a queue; every third answers after its lease now and then."""
    raced = asyncio.run(race(url, 64, N_RACED, seed))
    expected = {"accepted", "lease-expired", "stale"}
    return Counter(
        {
            "acknowledged": raced.seen["accepted"] + raced.seen["stale"],
            "late answers": raced.seen["lease-expired"] + raced.seen["stale"],
            "stale leases accepted": raced.seen["stale"],
            "lost": raced.seen["accepted"] - len(raced.charges),
            "charged twice": sum(n > 1 for n in raced.charges),
            "other problems": sum(n for name, n in raced.seen.items() if name not in expected),
            "the run's account differs": raced.costs["total"] != len(raced.charges) or raced.costs["reserved"] != 0,
        }
    )


def schedules(url: str, folder: Path, seed: int) -> Counter[str]:
    """Run sequences of calls, and compare the server with the model after each call."""
    with in_one_thread(url, follow_up_seconds=0) as service:
        run_schedules(service, N_SCHEDULES, 50, seed)
    return Counter({"schedules": N_SCHEDULES})


def every(cluster: Cluster | None) -> dict[str, Trial]:
    """Return all trials by name; without a cluster, those of SQLite."""
    trials: dict[str, Trial] = {"power": power, "faults": faults, "backups": backups, "clocks": clocks}
    on_both = {"kills": kills, "cuts": cuts, "races": races, "schedules": schedules}
    for name, trial in on_both.items():
        trials[name] = _on(trial, lambda folder: f"sqlite:///{folder / 'store.db'}")
    if cluster is not None:
        for name, trial in on_both.items():
            trials[f"{name}, PostgreSQL"] = _on(trial, lambda _: cluster.create())
        trials["clocks, PostgreSQL"] = partial(clocks_of_postgresql, cluster.binaries)
        trials["kills of one of two, PostgreSQL"] = _on(kills_of_one_of_two, lambda _: cluster.create())
    return trials


def _on(trial: Callable[[str, Path, int], Counter[str]], store: Callable[[Path], str]) -> Trial:
    return lambda folder, seed: trial(store(folder), folder, seed)


def _annotate(address: str, headers: Mapping[str, str], run: str, told: Told) -> None:
    """Answer until no query is left, also those whose assignment never arrived."""
    with closing(Client(address, headers["Authorization"].removeprefix("Bearer "))) as client:
        while held := client.lease(wire.Lease(run=run)) or next(iter(client.assignments()), None):
            answer = wire.InspectAnswer(kind="inspect_full", verdict="pass")
            body = {"token": held.token, "answer": answer.model_dump(mode="json")}
            sent = Answer(held.id, body, dict(headers))
            told.answers.append(sent)
            sent.receipt = client.answer(held, answer).model_dump(mode="json")
            sent.seen = 0


def _told(told: Told) -> Counter[str]:
    return Counter({"acknowledged": len(told.acknowledged()), "refused": told.statuses[503]})


def _after_losses(recording: Recording, seed: int, step: int = 1) -> Counter[str]:
    counts = Counter[str]()
    for loss in recording.losses(seed, step):
        counts += Counter({"power losses": 1}) + recording.wrong([loss])
    return counts
