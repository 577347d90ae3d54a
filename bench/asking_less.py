"""Compares ways of asking less: units, keys and minutes of a person until runs reached 80, 90, 95 and 99 %.

    python -m bench.asking_less STORE ... [--to asking-less.csv] [--also asking-less.csv]

It reads stores of runs that were trained with `--measure`, with their checkpoints beside. Success is that of the
measurements. Keys and minutes are estimated from the answers, as `bench/person.py` says. The script prints a table of
medians and ranges over the seeds, and asserts nothing. `--to` writes the numbers of each run, and `--also` adds runs
whose numbers were written before.
"""

import argparse
import csv
import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from pathlib import Path

from bench.levels import GOALS, cell, runs_of
from bench.person import answered, work_of

from waypost_learner.remote.embedded import embedded

Costs = dict[float, tuple[float, float, float]]
"""For each goal, the units, keys and minutes until a run reached it; infinite if it never did."""
Row = tuple[str, int, Costs]
"""A run: the name of its series, its seed, its costs."""
COLUMNS = ("run", "seed", "success", "units", "keys", "minutes")


def costs_of(store: Path) -> list[Row]:
    """Return the measured runs of a store, and what they cost a person."""
    found = []
    with embedded(store) as connection:
        for run in runs_of(store):
            queries = answered(connection.learner, run.id)
            costs: Costs = {}
            for goal in GOALS:
                episode, units = run.first_at(goal)
                until = [work_of(query) for query in queries if query.ask.episode <= episode]
                work = sum(keys for keys, _, _ in until), sum(minutes for _, _, minutes in until)
                costs[goal] = (units, *work) if math.isfinite(units) else (math.inf,) * 3
            found.append((run.name, run.seed, costs))
    return found


def written(path: Path) -> Iterator[Row]:
    """Yield the runs that `write` wrote."""
    with path.open(newline="") as file:
        for (name, seed), some in groupby(csv.DictReader(file), key=lambda row: (row["run"], int(row["seed"]))):
            costs: Costs = {}
            for row in some:
                units, keys, minutes = (float(row[what]) for what in ("units", "keys", "minutes"))
                costs[float(row["success"])] = units, keys, minutes
            yield name, seed, costs


def write(path: Path, rows: Iterable[Row]) -> None:
    """Write one row per run and goal."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for name, seed, costs in rows:
            writer.writerows((name, seed, goal, *(f"{one:g}" for one in found)) for goal, found in costs.items())


def lines_of(rows: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of a table in Markdown."""
    yield "| run | seeds | success | units | keys | minutes |"
    yield "|---|---|---|---|---|---|"
    for name, some in groupby(rows, key=lambda row: row[0]):
        costs = [one for *_, one in some]
        for goal in GOALS:
            units, keys, minutes = zip(*(one[goal] for one in costs), strict=True)
            success = f"{goal:.0%}".replace("%", " %")
            yield f"| {name} | {len(costs)} | {success} | {cell(units)} | {cell(keys)} | {cell(minutes, 1)} |"


def main() -> None:
    """Read the stores and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stores", nargs="*", type=Path, help="stores of measured runs, with their checkpoints beside")
    parser.add_argument("--also", nargs="*", type=Path, default=[], help="files that `--to` wrote, with other runs")
    parser.add_argument("--to", type=Path, help="the CSV file to write")
    given = parser.parse_args()
    rows = [row for store in given.stores for row in costs_of(store)]
    rows += [row for file in given.also for row in written(file)]
    rows.sort(key=lambda row: row[:2])
    if not rows:
        parser.exit(0, "Nothing was compared. Give stores of runs that were trained with --measure.\n")
    if given.to is not None:
        write(given.to, rows)
    print("\n".join(lines_of(rows)))


if __name__ == "__main__":
    main()
