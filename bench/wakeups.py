"""Measures how soon a request that waits at one server process gets what another process stores.

`python bench/wakeups.py`: two server processes share one PostgreSQL database. An annotator waits at one for a query,
which a learner asks at the other. The script prints the times from the learner's request to the annotator's reply.
"""

import statistics
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

import httpx2
from bench.assignments import ANSWER, VOCABULARY, machine, query, serving
from tests.conftest import Cluster, postgresql_binaries

N = 500


def main() -> None:
    binaries = postgresql_binaries()
    if binaries is None:
        raise SystemExit("This needs PostgreSQL's programs (Debian: apt install postgresql).")
    with ExitStack() as stack:
        cluster = Cluster(binaries, Path(stack.enter_context(TemporaryDirectory(prefix="wp"))), fsync=True)
        stack.callback(cluster.stop)
        database = cluster.create()
        here, _, learner, _ = stack.enter_context(serving(database))
        there, _, _, annotators = stack.enter_context(serving(database))
        asking = stack.enter_context(httpx2.Client(base_url=f"{here}/api/v1", headers=learner, timeout=90))
        waiting = stack.enter_context(httpx2.Client(base_url=f"{there}/api/v1", headers=annotators[0], timeout=90))
        pool = stack.enter_context(ThreadPoolExecutor(1))
        body = {"name": "bench", "algorithm": "bench", "seed": 0, "vocabulary": VOCABULARY}
        run = asking.post("/runs", json=body).json()["id"]
        times = []
        for number in range(N):
            reply = pool.submit(waiting.post, "/assignments", json={"wait": 60})
            time.sleep(0.1 + 0.003 * (number % 50))  # the annotator waits, and has not just polled
            start = time.perf_counter()
            asking.post(f"/runs/{run}/queries", json={"queries": [query(number)]}).raise_for_status()
            held = reply.result().json()
            times.append(1_000 * (time.perf_counter() - start))
            answer = {"token": held["token"], "answer": ANSWER}
            waiting.post(f"/assignments/{held['id']}/answer", json=answer).raise_for_status()
    times.sort()
    print(machine())
    middle, late = statistics.median(times), times[int(0.99 * N)]
    print(f"{N} queries: p50 {middle:.1f} ms, p99 {late:.1f} ms, max {times[-1]:.1f} ms")


if __name__ == "__main__":
    main()
