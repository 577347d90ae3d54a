"""Compares ways of asking less: units, keys and minutes of a person until runs reached 80, 90, 95 and 99 %.

    python -m bench.asking_less STORE ...

It reads stores of runs that were trained with `--measure`, with their checkpoints beside. Success is that of the
measurements. Keys and minutes are estimated from the answers, as `bench/person.py` says. The script prints a table of
medians and ranges over the seeds, and asserts nothing.
"""

import argparse
import math
from itertools import groupby
from pathlib import Path

from bench.levels import GOALS, Run, cell, runs_of
from bench.person import answered, effort, minutes_of

from waypost_learner.remote.embedded import embedded

Costs = dict[float, tuple[float, float, float]]
"""For each goal, the units, keys and minutes until a run reached it; infinite if it never did."""


def costs_of(store: Path) -> list[tuple[Run, Costs]]:
    """Return the measured runs of a store, and what they cost a person."""
    found = []
    with embedded(store) as connection:
        for run in runs_of(store):
            queries = answered(connection.learner, run.id)
            costs: Costs = {}
            for goal in GOALS:
                episode, units = run.first_at(goal)
                until = [query for query in queries if query.ask.episode <= episode]
                work = sum(effort(query)[0] for query in until), sum(map(minutes_of, until))
                costs[goal] = (units, *work) if math.isfinite(units) else (math.inf,) * 3
            found.append((run, costs))
    return found


def main() -> None:
    """Read the stores and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stores", nargs="*", type=Path, help="stores of measured runs, with their checkpoints beside")
    given = parser.parse_args()
    rows = sorted((one for store in given.stores for one in costs_of(store)), key=lambda one: one[0].name)
    if not rows:
        parser.exit(0, "Nothing was compared. Give stores of runs that were trained with --measure.\n")
    print("| run | seeds | success | units | keys | minutes |\n|---|---|---|---|---|---|")
    for name, some in groupby(rows, key=lambda one: one[0].name):
        costs = [one for _, one in some]
        for goal in GOALS:
            units, keys, minutes = zip(*(one[goal] for one in costs), strict=True)
            success = f"{goal:.0%}".replace("%", " %")
            print(f"| {name} | {len(costs)} | {success} | {cell(units)} | {cell(keys)} | {cell(minutes, 1)} |")


if __name__ == "__main__":
    main()
