"""Measures memory and time of import and export: `python bench/export.py --answers 1000000`.

The run has rollouts in the corridor with 30 segments of one step, and 62 answers about each, given by the oracle.
`waypost import` takes the first 200 episodes into a new store. For the formats that need no replay, SQL then copies
these episodes until the store has enough answers. Each step is a process of its own, whose peak memory the operating
system reports. The script prints a table and asserts nothing.
"""

import argparse
import os
import platform
import sqlite3
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from waypost import prices as pricing
from waypost import wire
from waypost.trajectory import Segment, State
from waypost_learner.algorithms.queries import InspectFull, InspectLo, LabelHi, LabelLo, Query
from waypost_learner.domains.corridor import MAX_STEPS, CorridorDomain, moved
from waypost_learner.exchange.formats import jsonl
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.runs.config import TrainConfig, config_values
from waypost_learner.runs.instances import Instances

PRICES = wire.Prices()
PER_EPISODE = 2 + 2 * MAX_STEPS
RUN = "0123456789ab"
FORMATS = ("jsonl", "parquet", "minari")
COPIED = ("jsonl", "parquet")
SHIFTED = {  # the columns with ids, by table
    "queries": ("id", "answer_id"),
    "assignments": ("id", "query_id"),
    "answers": ("id", "query_id", "assignment_id"),
    "ledger": ("id", "query_id", "answer_id"),
    "episodes": (),
}
# Not `getrusage`, whose peak includes the parent's memory before `exec` (Linux only).
WATCHED = """
import atexit, sys, time

def report():
    peak = next(line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM"))
    print(time.monotonic() - began, time.process_time(), peak, file=sys.stderr)

began = time.monotonic()
atexit.register(report)
from waypost_learner.cli import main
main()
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--answers", type=int, default=100_000, help="in the store that jsonl and parquet export")
    parser.add_argument("--episodes", type=int, default=200, help="that are imported, and replayed for Minari")
    parser.add_argument("--formats", default=",".join(FORMATS))
    parser.add_argument("--python", default=sys.executable, help="the Python that exports, for LeRobot")
    chosen = parser.parse_args()
    load = ", ".join(f"{one:.1f}" for one in os.getloadavg())
    print(f"{platform.machine()}, {os.cpu_count()} cores, load {load}, Python {platform.python_version()}.\n")
    print("| step | answers | seconds | CPU seconds | answers/CPU second | peak MiB | MiB on disk |")
    print("|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory(prefix="wp") as name:
        folder, store = Path(name), Path(name) / "waypost.db"
        (folder / "made").mkdir()
        jsonl.write(records(chosen.episodes), folder / "made")
        n = chosen.episodes * PER_EPISODE
        report("import jsonl", n, *measured(chosen.python, "import", folder / "made", "--store", store), store)
        formats = sorted(chosen.formats.split(","), key=COPIED.__contains__)
        for form in formats:
            if form in COPIED and n < chosen.answers:
                n = multiply(store, -(-chosen.answers // n)) * PER_EPISODE
            out = folder / form
            told = ("--store", store, "--format", form, "--out", out)
            report(f"export {form}", n, *measured(chosen.python, "export", RUN, *told), out)


def multiply(file: Path, times: int) -> int:
    """Copy all episodes of a store until there are `times` as many; return the number of episodes."""
    with closing(sqlite3.connect(file)) as store, store:
        (n,) = store.execute("SELECT count(*) FROM episodes").fetchone()
        (last,) = store.execute("SELECT max(id) FROM queries").fetchone()  # every query has one row in each table
        for shift, episodes in ((last * copy, n * copy) for copy in range(1, times)):
            for table, shifted in SHIFTED.items():
                columns = [row[1] for row in store.execute(f"PRAGMA table_info({table})")]
                values = [_shifted(one, one in shifted, shift, episodes) for one in columns]
                some = f"episode < {n}" if table == "episodes" else f"id <= {last}"
                store.execute(f"INSERT INTO {table} SELECT {', '.join(values)} FROM {table} WHERE {some}")
        store.execute(f"UPDATE runs SET spent = spent * {times}, episodes = {n * times}")
    return int(n * times)


def _shifted(column: str, is_id: bool, shift: int, episodes: int) -> str:
    """Return the SQL of a column's value in a copy."""
    if is_id:
        return f"{column} + {shift}"
    if column == "episode":
        return f"episode + {episodes}"
    if column in {"ask", "result"}:
        return f"""replace({column}, '"episode":' || episode || ',', '"episode":' || (episode + {episodes}) || ',')"""
    return column


def measured(python: str, *arguments: str | Path) -> tuple[float, float, float]:
    """Run a `waypost` command; return its wall time and CPU time in seconds, and its peak memory in MiB."""
    done = subprocess.run([python, "-c", WATCHED, *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"waypost {arguments[0]} failed: {done.stderr}")
    wall, cpu, peak = done.stderr.split()[-3:]
    return float(wall), float(cpu), float(peak) / 2**10


def report(step: str, answers: int, wall: float, cpu: float, peak: float, path: Path) -> None:
    """Print one row."""
    numbers = (f"{wall:.0f}", f"{cpu:.0f}", f"{answers / cpu:,.0f}", f"{peak:.0f}")
    files = path.rglob("*") if path.is_dir() else path.parent.glob(f"{path.name}*")
    size = sum(one.stat().st_size for one in files if one.is_file()) / 2**20
    print(f"| {' | '.join((step, f'{answers:,}', *numbers, f'{size:.0f}'))} |", flush=True)


# --- the run


def records(episodes: int) -> Iterator[wire.Record]:
    """Yield the records of a run in which everything is answered and used."""
    domain = CorridorDomain()
    config = TrainConfig("hg-dagger", "corridor", preset="paper", episodes=episodes)
    instances, known = (
        Instances(domain.instances("random"), config.seed),
        dict[Any, list[tuple[wire.Ask, wire.Answer]]](),
    )

    def answered(episode: int) -> Iterator[tuple[wire.Ask, wire.Answer]]:
        instance = instances.train(episode)
        if instance not in known:
            known[instance] = questions(domain, instance)
        for ask, answer in known[instance]:
            yield ask.model_copy(update={"episode": episode}), answer

    one = sum(pricing.cost(answer, PRICES).units for _, answer in answered(0))
    spent = pricing.to_units(one * episodes)  # the answers of all episodes have the same lengths
    yield wire.RunRecord(
        run=wire.Run(
            **{"id": RUN, "name": "a large run", "algorithm": "hg-dagger", "seed": 0, "state": "finished"},
            vocabulary=vocabulary(domain),
            config=config_values(config),
            prices=PRICES,
            **{"budget": None, "reserved": 0.0, "spent": spent, "priority": 0, "episodes": episodes},
            **{"episodes_done": episodes, "success_rate": 1.0, "open_queries": 0, "gold_rate": 0.0, "result": None},
            **{"created_at": 1e9, "finished_at": 2e9},
        )
    )
    for episode in range(episodes):
        for ask, answer in answered(episode):
            yield query(ask, answer)
    for episode in range(episodes):
        for ask, answer in answered(episode):
            yield charge(ask, answer)
    for episode in range(episodes):
        yield wire.EpisodeRecord(result=result(episode), at=1e9 + episode)


def questions(domain: CorridorDomain, instance: Any) -> list[tuple[wire.Ask, wire.Answer]]:
    """Return the queries about a rollout that never reaches the target, and the oracle's answers."""
    cells, actions = [instance.start], list[int]()
    for step in range(MAX_STEPS):
        wish = step % 2
        actions.append(1 - wish if moved(cells[-1], wish) == instance.target else wish)
        cells.append(moved(cells[-1], actions[-1]))
    states = [State(np.empty(0, np.float32), cell) for cell in cells]  # queries have views, not observations
    sigma = tuple(
        Segment(action, (states[step], states[step + 1]), (action,), terminated=True)
        for step, action in enumerate(actions)
    )
    asked: list[Query] = [InspectFull(sigma), LabelHi(sigma)]
    for h, segment in enumerate(sigma):
        asked += [InspectLo(segment, sigma[:h]), LabelLo(segment, sigma[:h])]
    translator, oracle = Translator(domain, instance), OracleExpert(domain)
    asks = [translator.ask(one, 0, ordinal) for ordinal, one in enumerate(asked)]
    return [(ask, oracle(ask)) for ask in asks]


def query(ask: wire.Ask, answer: wire.Answer) -> wire.QueryRecord:
    """Return the record of an answered query."""
    units = pricing.to_units(pricing.cost(answer, PRICES).units)
    given = wire.AnswerRecord(content=answer, revision=0, units=units, seconds=2.5, active_seconds=2.0, at=1e9)
    held = wire.AssignmentRecord(
        **{"annotator": f"annotator-{ask.episode % 100}", "state": "answered", "deferring": False, "reason": None},
        **{"leased_at": 1e9, "expires_at": 2e9, "ended_at": 1e9},
        answer=given,
    )
    return wire.QueryRecord(state="answered", priority=0, used=True, created_at=1e9, ask=ask, answered=held, earlier=[])


def charge(ask: wire.Ask, answer: wire.Answer) -> wire.LedgerRecord:
    """Return the charge of an answer."""
    cost = pricing.cost(answer, PRICES)
    return wire.LedgerRecord(
        **{"entry": "charge", "kind": ask.kind, "episode": ask.episode, "ordinal": ask.ordinal, "revision": 0},
        units=pricing.to_units(cost.units),
        lo_units=pricing.to_units(cost.lo),
        **{"seconds": 2.5, "active_seconds": 2.0, "at": 1e9},
    )


def result(episode: int) -> wire.EpisodeResult:
    """Return the result of an episode."""
    return wire.EpisodeResult(
        **{"episode": episode, "warm_start": False, "train_success": False, "test_success": True},
        **{"train_steps": MAX_STEPS, "test_steps": 5, "hi_labels": 30, "lo_labels": 60, "seconds": 0.1},
    )


if __name__ == "__main__":
    main()
