"""Measures Label Studio and Waypost side by side, in turns: `python bench/label_studio.py`.

Both are real server processes with SQLite, used over loopback by the same client: threads that do not pause. A cycle is
one lease (Label Studio: `next`) and one answer (an annotation), each acknowledged. Questions of about 2 kB are asked
before the clock starts, and each annotator does one cycle before it. What counts as handed out twice is a question that
two annotators got, although each needs one answer. The script prints a table and asserts nothing.

Label Studio has its own virtual environment, which `make bench-label-studio` installs. It gets a new connection per
request: on one that stays open, each of its replies comes about 50 ms later.
"""

import argparse
import math
import statistics
import tempfile
import time
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Any

import httpx2
from bench.assignments import ANNOTATORS, ANSWER, ask_all, machine, query, serving
from bench.peers.client import Missing
from bench.peers.label_studio import LabelStudio, running

from waypost_server.http.context import VERSION

PATIENCE = 120.0  # seconds until a request counts as failed
PASS = {"from_name": "verdict", "to_name": "question", "type": "choices", "value": {"choices": ["pass"]}}
COLUMNS = ("cycles/s", "p50 ms", "p99 ms", "handed out twice")


class Annotator(ABC):
    """An annotator who leases and answers without a pause, whatever fails."""

    def __init__(self, url: str, headers: dict[str, str]) -> None:
        self._client = httpx2.Client(base_url=url, headers=headers, timeout=PATIENCE)
        self.milliseconds: list[float] = []  # of each cycle
        self.handed: set[Any] = set()  # the questions that this annotator got
        self.failed: Counter[str] = Counter()
        self.seconds = 0.0  # of work, until the last reply
        self.ran_out = False

    def warm_up(self) -> None:
        """Do a cycle that does not count."""
        self._cycle()
        self.milliseconds.clear()
        self.handed.clear()
        self.failed.clear()

    def work(self, seconds: float) -> None:
        """Work for this long, and finish the cycle that is under way then."""
        start = time.perf_counter()
        while time.perf_counter() < start + seconds and not self.ran_out:
            self._cycle()
        self.seconds = time.perf_counter() - start
        self._client.close()

    def _cycle(self) -> None:
        start = time.perf_counter()
        try:
            lease = self._lease()
            if lease is None:
                self.ran_out = True
                return
            self._answer(lease)
        except httpx2.HTTPStatusError as error:
            self.failed[f"HTTP {error.response.status_code}"] += 1
        except httpx2.TransportError as error:
            self.failed[type(error).__name__] += 1
        else:
            self.milliseconds.append(1_000 * (time.perf_counter() - start))

    @abstractmethod
    def _lease(self) -> dict[str, Any] | None: ...

    @abstractmethod
    def _answer(self, lease: dict[str, Any]) -> None: ...


class OfWaypost(Annotator):
    """An annotator of one of Waypost's runs."""

    def __init__(self, url: str, headers: dict[str, str], run: str) -> None:
        super().__init__(f"{url}/api/v1", headers)
        self._wanted = {"run": run}

    def _lease(self) -> dict[str, Any] | None:
        reply = self._client.post("/assignments", json=self._wanted).raise_for_status()
        if reply.status_code == 204:
            return None
        lease: dict[str, Any] = reply.json()
        self.handed.add(lease["query"]["id"])
        return lease

    def _answer(self, lease: dict[str, Any]) -> None:
        body = {"token": lease["token"], "answer": ANSWER}
        self._client.post(f"/assignments/{lease['id']}/answer", json=body).raise_for_status()


class OfLabelStudio(Annotator):
    """An annotator of one of Label Studio's projects."""

    def __init__(self, url: str, headers: dict[str, str], project: int) -> None:
        super().__init__(f"{url}/api", headers | {"Connection": "close"})
        self._next = f"/projects/{project}/next"

    def _lease(self) -> dict[str, Any] | None:
        reply = self._client.get(self._next)
        if reply.status_code == 404:
            return None
        task: dict[str, Any] = reply.raise_for_status().json()
        self.handed.add(task["id"])
        return task

    def _answer(self, lease: dict[str, Any]) -> None:
        body = {"result": [PASS], "lead_time": 1.0}
        self._client.post(f"/tasks/{lease['id']}/annotations/", json=body).raise_for_status()


def of_waypost(
    url: str, learner: dict[str, str], people: Sequence[dict[str, str]], queries: int, n: int
) -> list[Annotator]:
    """Ask the queries of a new run; return its first n annotators."""
    run = ask_all(url, learner, queries)
    return [OfWaypost(url, headers, run) for headers in people[:n]]


def of_label_studio(server: LabelStudio, people: Sequence[dict[str, str]], tasks: int, n: int) -> list[Annotator]:
    """Import the tasks of a new project; return its first n annotators."""
    project = server.project([query(number) for number in range(tasks)])
    return [OfLabelStudio(server.url, headers, project) for headers in people[:n]]


def measure(annotators: Sequence[Annotator], seconds: float) -> tuple[float, list[str]]:
    """Return the cycles/s, and the cells of the table.

    The rate is the sum of the annotators' rates, so that one who waits long for a last reply makes no other one slower.
    """
    for one in annotators:
        one.warm_up()
    with ThreadPoolExecutor(len(annotators)) as pool:
        list(pool.map(lambda one: one.work(seconds), annotators))
    rate = sum(len(one.milliseconds) / one.seconds for one in annotators)
    times = sorted(milliseconds for one in annotators for milliseconds in one.milliseconds) or [math.nan]
    p99 = times[min(len(times) - 1, int(0.99 * len(times)))]
    handed = sum(len(one.handed) for one in annotators)
    twice = handed - len(set[Any]().union(*(one.handed for one in annotators)))
    failed = sum((one.failed for one in annotators), Counter[str]())
    remarks = [f"{twice:,} of {handed:,}", *(f"{count} {name}" for name, count in failed.items())]
    if any(one.ran_out for one in annotators):
        remarks.append("none was left")
    return rate, [f"{rate:,.1f}", f"{statistics.median(times):,.0f}", f"{p99:,.0f}", ", ".join(remarks)]


def resident(pid: int) -> float:
    """Return the MiB of memory that a process and the processes it started use (Linux)."""
    process = Path(f"/proc/{pid}")
    lines = (process / "status").read_text().splitlines()
    kib = next(int(line.split()[1]) for line in lines if line.startswith("VmRSS:"))
    started = [int(child) for task in (process / "task").iterdir() for child in (task / "children").read_text().split()]
    return kib / 1024 + sum(resident(child) for child in started)


def compare(folder: Path, options: argparse.Namespace) -> None:
    """Start both servers and print the table."""
    most = max(options.annotators)
    with ExitStack() as stack:
        theirs = stack.enter_context(running(folder))
        url, pid, learner, people = stack.enter_context(serving(f"sqlite:///{folder / 'waypost.db'}"))
        names = {f"Label Studio {theirs.version()}": theirs.pid, f"Waypost {VERSION}": pid}
        idle = [resident(one) for one in names.values()]
        signed_up = [theirs.sign_up(f"annotator{k}") for k in range(most)]
        sides: list[Callable[[int], Sequence[Annotator]]] = [
            partial(of_label_studio, theirs, signed_up, options.tasks),
            partial(of_waypost, url, learner, people, options.queries),
        ]
        heads = [f"{name}: {COLUMNS[0]} | {' | '.join(COLUMNS[1:])}" for name in names]
        print(f"| annotators | {' | '.join(heads)} | times as many cycles |")
        print("|---" * (2 + len(COLUMNS) * len(heads)) + "|")
        for n in options.annotators:
            (slow, left), (fast, right) = [measure(annotators(n), options.seconds) for annotators in sides]
            ratio = f"{fast / slow:.0f}" if slow else ""
            print(f"| {' | '.join([str(n), *left, *right, ratio])} |", flush=True)
        used = [f"{name} used {mib:.0f} MiB" for name, mib in zip(names, idle, strict=True)]
        after = " and ".join(f"{resident(one):.0f}" for one in names.values())
        print(f"\nWhen idle, {' and '.join(used)} of memory; after all rows {after}.")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=20.0, help="seconds per row")
    parser.add_argument("--annotators", type=int, nargs="+", default=list(ANNOTATORS))
    parser.add_argument("--tasks", type=int, default=1_000, help="open tasks of Label Studio at the start of a row")
    parser.add_argument("--queries", type=int, default=20_000, help="open queries of Waypost at the start of a row")
    options = parser.parse_args()
    if not all(0 < n <= max(ANNOTATORS) for n in options.annotators):
        parser.error(f"there can be 1 to {max(ANNOTATORS)} annotators")
    with tempfile.TemporaryDirectory(prefix="wp", dir=Path.cwd()) as folder:
        try:
            print(f"{machine()}\n")
            compare(Path(folder), options)
        except Missing as missing:
            print(f"Nothing was measured, because {missing}.")


if __name__ == "__main__":
    main()
