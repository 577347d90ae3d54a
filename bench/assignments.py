"""Measures the throughput and the latency of leasing and answering: `python bench/assignments.py`.

A real server process is used over loopback, with queries of about 2 kB and annotators who do not pause. A cycle is one
lease and one answer, each acknowledged after it is on disk. In a chain, the reply to the answer contains the next
lease, so a cycle is one call. In batches, one call leases 32 queries and one answers them. In batches of answers, all
queries are leased before the clock starts, so a cycle is one answer. All queries are asked before the clock starts. The
script prints a table per database and asserts nothing.

The annotators are threads of this process, which take about as much CPU time as the server. With `--client wrk`, they
are threads of wrk, a program in C, which take little.
"""

import argparse
import json
import os
import platform
import shutil
import sqlite3
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, closing, contextmanager
from itertools import product
from pathlib import Path
from typing import Any

import httpx2
from tests.conftest import Cluster, postgresql_binaries

from waypost_server.auth import tokens
from waypost_server.db.engine import Database
from waypost_server.users import service as users

ANNOTATORS = (1, 8, 32)
BATCH = 100  # queries asked at a time
BACKLOG = 9_500  # open queries at the start; a run may have 10,000
ONE_BY_ONE = ("lease + answer", "chained")
MODES = (*ONE_BY_ONE, "batches", "batches of answers")
TOGETHER = 32  # queries of a batch of answers
VOCABULARY = {"domain": "bench", "subgoals": ["here"], "actions": ["up", "down"], "renderer": "none"}
ANSWER = {"kind": "inspect_lo", "verdict": "pass"}
HEADER = (
    "| database | mode | annotators | open | cycles/s | limit / ours | p50 ms | p99 ms | max ms | CPU ms/cycle | "
    "duplicates |"
)


def query(number: int) -> dict[str, Any]:
    """Return a query of about 2 kB: a segment of 20 steps on a 17 x 17 grid."""
    cells = [[(number * 31 + row * 17 + column) % 97 for column in range(17)] for row in range(2)]
    states = [{"at": [step % 17, number % 17], "facing": step % 4, "seen": cells[step % 2]} for step in range(21)]
    segment = {"subgoal": "here", "states": states, "actions": ["up"] * 20}
    asked = {"kind": "inspect_lo", "episode": number // 100, "ordinal": number % 100, "question": "Did it get there?"}
    return asked | {"instance": {"cells": cells}, "segments": [segment]}


@contextmanager
def serving(database: str, processes: int = 1) -> Iterator[tuple[str, int, dict[str, str], list[dict[str, str]]]]:
    """Run `serve`; yield its address, its process id, and the headers of a learner and of annotators."""
    db = Database(database)

    def headers(name: str, role: Any) -> dict[str, str]:
        user = db.write_now(lambda tx: users.ensure_user(tx, name, role))
        return {"Authorization": f"Bearer {db.write_now(lambda tx: tokens.create_token(tx, user.id, '')).token}"}

    learner = headers("learner", "learner")
    annotators = [headers(f"annotator{n}", "annotator") for n in range(max(ANNOTATORS))]
    db.close()
    command = [sys.executable, "-u", "-m", "waypost_server.cli", "serve", "--port", "0", "--database", database]
    command += ["--processes", str(processes)]
    unlimited = os.environ | {"WAYPOST_MAX_OPEN_QUERIES": "1000000"}  # per run; by default 10,000
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=unlimited) as process:
        assert process.stdout is not None
        url = process.stdout.readline().split()[-1]
        _wait_until_ready(url)
        try:
            yield url, process.pid, learner, annotators
        finally:
            process.terminate()


def _wait_until_ready(url: str) -> None:
    while True:
        try:
            httpx2.get(f"{url}/readyz")
        except httpx2.TransportError:
            time.sleep(0.05)
        else:
            return


def ask_all(url: str, headers: dict[str, str], backlog: int) -> str:
    """Create a run with this many open queries; return its id."""
    with httpx2.Client(base_url=f"{url}/api/v1", headers=headers, timeout=60) as client:
        body = {"name": "bench", "algorithm": "bench", "seed": 0, "vocabulary": VOCABULARY}
        run = str(client.post("/runs", json=body).json()["id"])
        for first in range(0, backlog, BATCH):
            asked = [query(number) for number in range(first, min(first + BATCH, backlog))]
            client.post(f"/runs/{run}/queries", json={"queries": asked}).raise_for_status()
    return run


class Annotator:
    """An annotator who answers without a pause, until there are no more queries or the time is over."""

    def __init__(self, url: str, headers: dict[str, str], run: str) -> None:
        self._client = httpx2.Client(base_url=f"{url}/api/v1", headers=headers, timeout=60)
        self._run = run
        self.milliseconds: list[float] = []  # of each cycle
        self.answered: list[int] = []  # the query of each cycle
        self._held: list[dict[str, Any]] = []  # what was leased before the clock started

    def hold(self, count: int) -> None:
        """Lease queries before the clock starts."""
        while len(self._held) < count and (more := self._lease_batch()):
            self._held += more

    def work(self, mode: str, until: float) -> None:
        """Work in one of `MODES`."""
        with closing(self._client):
            if mode == "batches":
                self._in_batches(until)
            elif mode == "batches of answers":
                self._answer_held(until)
            else:
                self._one_by_one(until, chained=mode == "chained")

    def _one_by_one(self, until: float, *, chained: bool) -> None:
        wanted = {"run": self._run}
        held: dict[str, Any] | None = None
        while time.perf_counter() < until:
            start = time.perf_counter()
            if held is None:
                reply = self._client.post("/assignments", json=wanted)
                if reply.status_code == 204:
                    return
                held = reply.json()
            body: dict[str, Any] = {"token": held["token"], "answer": ANSWER}
            if chained:
                body["next"] = wanted
            receipt = self._client.post(f"/assignments/{held['id']}/answer", json=body).raise_for_status().json()
            self.milliseconds.append(1_000 * (time.perf_counter() - start))
            self.answered.append(receipt["query"])
            held = receipt["next"]

    def _in_batches(self, until: float) -> None:
        while time.perf_counter() < until:
            start = time.perf_counter()
            held = self._lease_batch()
            if not held:
                return
            self._answer_batch(held, start)

    def _answer_held(self, until: float) -> None:
        for first in range(0, len(self._held), TOGETHER):
            if time.perf_counter() < until:
                self._answer_batch(self._held[first : first + TOGETHER], time.perf_counter())

    def _lease_batch(self) -> list[dict[str, Any]]:
        reply = self._client.post("/assignments/batch", json={"run": self._run, "count": TOGETHER})
        return list(reply.raise_for_status().json()["assignments"])

    def _answer_batch(self, held: list[dict[str, Any]], start: float) -> None:
        answers = [{"assignment": one["id"], "token": one["token"], "answer": ANSWER} for one in held]
        results = self._client.post("/assignments/answers", json={"answers": answers}).json()["results"]
        self.milliseconds += [1_000 * (time.perf_counter() - start) / len(held)] * len(held)
        self.answered += [result["receipt"]["query"] for result in results]


def work_with_wrk(
    url: str, headers: Sequence[dict[str, str]], runs: Sequence[str], mode: str, seconds: float
) -> list[list[str]]:
    """Let wrk work as one annotator per thread; return the milliseconds and the query of each cycle."""
    n, script = str(len(headers)), str(Path(__file__).with_suffix(".lua"))
    tokens = [one["Authorization"].removeprefix("Bearer ") for one in headers]
    command = ["wrk", "-t", n, "-c", n, "-d", f"{seconds:g}s", "-s", script, url, "--", mode, ",".join(runs)]
    done = subprocess.run([*command, json.dumps(ANSWER), *tokens], stdout=subprocess.PIPE, text=True, check=True)
    return [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("cycle ")]


def cpu_seconds(pid: int) -> float:
    """Return the CPU time that a process has used, with the processes it started that still run (Linux)."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    started = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK") + sum(
        cpu_seconds(int(one)) for one in started
    )


def row(
    name: str,
    database: str,
    n: int,
    seconds: float,
    mode: str,
    backlog: int,
    limit: float,
    *,
    with_wrk: bool,
    processes: int = 1,
    n_runs: int = 1,
) -> str:
    """Measure and return one row of the table; `limit` is the number of commits/s of SQLite alone on this disk."""
    with serving(database, processes) as (url, pid, learner, headers):
        runs = [ask_all(url, learner, backlog // n_runs) for _ in range(n_runs)]
        annotators = [Annotator(url, headers[k], runs[k % n_runs]) for k in range(n)]
        if mode == "batches of answers":
            for one in annotators:
                one.hold(backlog // n)
        before, start = cpu_seconds(pid), time.perf_counter()
        if with_wrk:
            cycles = work_with_wrk(url, headers[:n], runs, mode, seconds)
        else:
            with ThreadPoolExecutor(n) as pool:
                list(pool.map(lambda one: one.work(mode, start + seconds), annotators))
            cycles = [cycle for one in annotators for cycle in zip(one.milliseconds, one.answered, strict=True)]
        cpu, took = cpu_seconds(pid) - before, time.perf_counter() - start
    times = sorted(float(milliseconds) for milliseconds, _ in cycles)
    answered = [query for _, query in cycles]
    p99 = times[min(len(times) - 1, int(0.99 * len(times)))]
    duplicates = len(answered) - len(set(answered))
    rate = len(times) / took
    server = name if processes == 1 else f"{name}, {processes} processes"
    server = server if n_runs == 1 else f"{server}, {n_runs} runs"
    at_least = "≥ " if with_wrk and len(cycles) == backlog else ""  # wrk goes on when no query is left
    return (
        f"| {server} | {mode} | {n} | {backlog} | {at_least}{rate:.0f} | {limit / rate:.0f} | "
        f"{statistics.median(times):.1f} | {p99:.1f} | {times[-1]:.0f} | {1_000 * cpu / len(times):.2f} | "
        f"{duplicates}/{len(answered)} |"
    )


def raw_commits(folder: Path, seconds: float = 2.0) -> float:
    """Return the number of one-row commits/s of SQLite alone on the same disk, with synchronous=FULL."""
    db = sqlite3.connect(folder / "raw.db", isolation_level=None)
    db.execute("PRAGMA journal_mode = WAL")
    db.execute("PRAGMA synchronous = FULL")
    db.execute("CREATE TABLE t (x)")
    start, n = time.perf_counter(), 0
    while time.perf_counter() < start + seconds:
        db.execute("INSERT INTO t VALUES (1)")
        n += 1
    db.close()
    return n / seconds


def machine() -> str:
    """Describe the machine: the processor, its load, and the versions of Python and SQLite."""
    cpus = Path("/proc/cpuinfo")
    lines = cpus.read_text().splitlines() if cpus.exists() else []
    model = next((line.partition(": ")[2] for line in lines if line.startswith("model name")), platform.processor())
    load = ", ".join(f"{one:.1f}" for one in os.getloadavg())
    python = platform.python_version()
    return f"{model}, {os.cpu_count()} cores, load {load}, Python {python}, SQLite {sqlite3.sqlite_version}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="seconds per row")
    parser.add_argument("--annotators", type=int, nargs="+", default=list(ANNOTATORS))
    parser.add_argument("--modes", nargs="+", choices=MODES, default=list(MODES))
    parser.add_argument("--backlogs", type=int, nargs="+", default=[BACKLOG], help="open queries at the start")
    databases = ("SQLite", "PostgreSQL")
    parser.add_argument("--databases", nargs="+", choices=databases, default=list(databases))
    parser.add_argument("--client", choices=("python", "wrk"), default="python", help="who the annotators are")
    parser.add_argument("--processes", type=int, nargs="+", default=[1], help="of the server; several: PostgreSQL only")
    parser.add_argument("--runs", type=int, default=1, help="the annotators' runs, by turns; they share the queries")
    options = parser.parse_args()
    with_wrk = options.client == "wrk"
    if with_wrk and not {*options.modes} <= {*ONE_BY_ONE}:
        parser.error(f"wrk has no batches; add --modes {' '.join(map(repr, ONE_BY_ONE))}")
    if with_wrk and shutil.which("wrk") is None:
        parser.error("there is no wrk on this machine; Debian has it in the package wrk")
    if any(one % options.runs for one in (*options.annotators, *options.backlogs)):
        parser.error("--runs must divide the numbers of annotators and of open queries, so that all runs have as many")
    print(machine())
    size = len(json.dumps(query(1)))
    print(f"A query has {size} bytes. Each row takes {options.seconds:g} s. Clients and server share the cores.\n")
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="wp", dir=Path.cwd())))
        targets = {"SQLite": lambda k: f"sqlite:///{folder / f'{k}.db'}"}
        binaries = postgresql_binaries()
        if binaries is not None:
            cluster_folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="wp")))
            cluster = Cluster(binaries, cluster_folder, fsync=True)
            stack.callback(cluster.stop)
            targets["PostgreSQL"] = lambda _: cluster.create()
        limit = raw_commits(folder)
        print(f"Upper limit: SQLite alone makes {limit:.0f} commits/s on this disk (WAL, FULL, one row each).\n")
        print(HEADER)
        print("|---" * HEADER.count(" | ") + "|---|")
        rows = product(options.databases, options.modes, options.backlogs, options.annotators, options.processes)
        for number, (name, mode, backlog, n, processes) in enumerate(rows):
            if name in targets and (processes == 1 or name == "PostgreSQL"):
                how = {"with_wrk": with_wrk, "processes": processes, "n_runs": options.runs}
                print(row(name, targets[name](number), n, options.seconds, mode, backlog, limit, **how), flush=True)


if __name__ == "__main__":
    main()
