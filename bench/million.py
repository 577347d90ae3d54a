"""Measures a store with very many answers: `python bench/million.py --answers 1000000`.

A learner asks queries of about 2 kB, a thousand at a time, and reports an episode for every hundred; two annotators
lease and answer them in batches of 32. Then annotators lease and answer a new run's queries one by one, on that store
and on a new one, and Chromium opens the page of the large run. The script prints tables and asserts nothing.

With `--store FILE`, the store is kept, and the next call goes on filling it. The times of asking and answering are then
those of the last call, for the answers that it added.
"""

import argparse
import statistics
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import repeat
from pathlib import Path
from typing import Any

import httpx2
from bench.assignments import HEADER, VOCABULARY, Annotator, machine, query, raw_commits, row, serving
from bench.page import opened, table
from tests.browser.kit import chromium

AT_ONCE = 1_000  # queries that are asked, then answered
PER_EPISODE = 100  # queries, as `query` numbers them
VIEWS = 40  # of the page
CHARTS = 2
WATCH = f"""() => {{
    const drawn = () => document.querySelectorAll('[role=slider] svg').length === {CHARTS};
    const see = now => drawn() ? console.log('drawn', now) : requestAnimationFrame(() => see(performance.now()));
    see(0);
}}"""


def report(episodes: Iterable[int]) -> dict[str, Any]:
    """Return a report of episodes, of which more and more succeed."""
    same = {"warm_start": False, "train_steps": 20, "test_steps": 20, "hi_labels": 0, "lo_labels": 0, "seconds": 1.0}
    results = [one % 7 < one % 11 for one in episodes]
    return {
        "episodes": [
            {"episode": one, "train_success": success, "test_success": success, **same}
            for one, success in zip(episodes, results, strict=True)
        ]
    }


@dataclass(frozen=True)
class Filled:
    """A run whose queries were answered: its id, the answers that were added, and the seconds that this took."""

    run: str
    added: int
    asking: float
    answering: float


def fill(url: str, learner: dict[str, str], annotators: list[dict[str, str]], answers: int) -> Filled:
    """Have a run's queries answered, beginning where an earlier call ended."""
    asking = answering = 0.0
    with httpx2.Client(base_url=f"{url}/api/v1", headers=learner, timeout=60) as client, ThreadPoolExecutor() as pool:
        body = {"name": f"{answers:,} answers", "algorithm": "bench", "seed": 0, "vocabulary": VOCABULARY}
        earlier = [one for one in client.get("/runs").json()["runs"] if one["name"] == body["name"]]
        (found,) = earlier or [client.post("/runs", json=body).json()]
        run, before = str(found["id"]), int(found["spent"])  # an answer costs a unit
        for first in range(before // AT_ONCE * AT_ONCE, answers, AT_ONCE):
            numbers = range(first, min(first + AT_ONCE, answers))
            start = time.perf_counter()
            client.post(f"/runs/{run}/queries", json={"queries": [*map(query, numbers)]}).raise_for_status()
            episodes = range(numbers[0] // PER_EPISODE, numbers[-1] // PER_EPISODE + 1)
            client.post(f"/runs/{run}/episodes", json=report(episodes)).raise_for_status()
            asked = time.perf_counter()
            working = [Annotator(url, headers, run) for headers in annotators]
            list(pool.map(Annotator.work, working, repeat("batches"), repeat(asked + 60)))
            asking, answering = asking + asked - start, answering + time.perf_counter() - asked
            print(f"{numbers[-1] + 1:,} answers", end="\r", file=sys.stderr)
    return Filled(run, answers - before, asking, answering)


def page_loads(url: str, run: str, headers: dict[str, str], views: int = VIEWS) -> Iterator[float]:
    """Open the page of a run again and again; yield the milliseconds until its curves are drawn."""
    with chromium() as browser:
        for _ in range(views):
            context = browser.new_context(base_url=url, extra_http_headers=headers)
            page = opened(context)
            page.add_init_script(f"({WATCH})()")
            # Waiting for a message, as looking into the page would keep its main thread busy for about 20 ms.
            with page.expect_console_message(lambda one: one.text.startswith("drawn ")) as drawn:
                page.goto(f"/runs/{run}", wait_until="commit")
            yield float(drawn.value.text.split()[1])
            context.close()


def memory_mib(pid: int) -> float:
    """Return the memory that a process has now (Linux)."""
    status = Path(f"/proc/{pid}/status").read_text().splitlines()
    return int(next(line.split()[1] for line in status if line.startswith("VmRSS"))) / 1_024


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--answers", type=int, default=20_000)
    parser.add_argument("--store", type=Path, help="the SQLite file to keep and to go on filling")
    parser.add_argument("--seconds", type=float, default=8.0, help="per row of the last table")
    parser.add_argument("--client", choices=("python", "wrk"), default="python", help="who the last annotators are")
    options = parser.parse_args()
    print(f"{machine()}\n")
    with tempfile.TemporaryDirectory(prefix="wp", dir=Path.cwd()) as folder:
        store, new = options.store or Path(folder) / "large.db", Path(folder) / "new.db"
        with serving(f"sqlite:///{store}") as (url, pid, learner, annotators):
            idle = memory_mib(pid)
            filled = fill(url, learner, annotators[:2], options.answers)
            loads = sorted(page_loads(url, filled.run, learner))
            loaded = memory_mib(pid)
        p95 = loads[int(0.95 * (len(loads) - 1))]
        times = [filled.added, f"{filled.asking:.0f}", f"{filled.answering:.0f}"]
        disk = store.stat().st_size / 2**20
        header = ["answers", "added", "asking, s", "answering, s", "MiB on disk", "server's MiB before", "after"]
        header += ["run page, p50 ms", "p95 ms"]
        memory = [f"{idle:.0f}", f"{loaded:.0f}"]
        seen = [f"{statistics.median(loads):.0f}", f"{p95:.0f}"]
        table(header, [[options.answers, *times, f"{disk:.0f}", *memory, *seen]])
        print(HEADER.replace("database", "store"))
        print("|---" * HEADER.count(" | ") + "|---|")
        limit = raw_commits(Path(folder))
        for name, file in (("new", new), ("large", store)):
            one = (name, f"sqlite:///{file}", 8, options.seconds, "lease + answer", 9_500, limit)
            print(row(*one, with_wrk=options.client == "wrk"), flush=True)


if __name__ == "__main__":
    main()
