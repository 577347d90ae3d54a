"""Draws what labels bought at each level of what a learner is told, from runs with `--measure`.

    python bench/levels.py STORE ... --to docs/results/general

It reads the measurements beside the runs' checkpoints, writes `measured.csv`, with one row per measurement, and
`levels.svg`, and prints a table: the units to 80, 90, 95 and 99 % of the measured instances. It asserts nothing.
"""

import argparse
import csv
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import cycle, groupby
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from waypost_learner.experiments.figures import look
from waypost_learner.experiments.figures.statistics import Track, spread
from waypost_learner.presets import find_preset
from waypost_learner.presets.told import level_of
from waypost_learner.runs.checkpoints import read_header
from waypost_learner.runs.config import TrainConfig

GOALS = (0.8, 0.9, 0.95, 0.99)
STYLES = (
    look.SUM,
    look.Style("#0072B2", (0, (5, 2)), "s"),
    look.Style("#D55E00", (0, (6, 2, 1, 2)), "^"),
    look.Style("#009E73", (0, (1, 1.2)), "D"),
    look.Style("#CC79A7", (0, (9, 2, 1, 2)), "v"),
)
EXPLANATION = "Lines: medians over the seeds. Bands: ranges. Measured after each change of the weights."


@dataclass(frozen=True)
class Run:
    """A run: its id, its name in the table, its seed, its measurements (episode, units, instances, successes)."""

    id: str
    name: str
    seed: int
    rows: Sequence[tuple[int, float, int, int]]

    def first_at(self, goal: float) -> tuple[float, float]:
        """Return the episode and units of the first measurement as high as the goal; both infinite without one."""
        found = ((episode, units) for episode, units, n, successes in self.rows if successes >= goal * n)
        return next(found, (math.inf, math.inf))


def runs_of(store: Path) -> Iterator[Run]:
    """Yield the measured runs of a store."""
    for file in sorted(store.with_name(f"{store.name}.checkpoints").glob("*.measured.csv")):
        config = read_header(file.with_name(file.name.replace(".measured.csv", ".safetensors"))).config
        with file.open(newline="") as opened:
            rows = [
                (int(row["episode"]), float(row["units"]), int(row["episodes"]), int(row["successes"]))
                for row in csv.DictReader(opened)
            ]
        yield Run(file.name.removesuffix(".measured.csv"), name_of(config), config.seed, rows)


def name_of(config: TrainConfig) -> str:
    """Return the algorithm, preset, level of what the learner is told, number of demonstrations, and changed values."""
    preset = find_preset(config.preset, domain=config.domain)
    told = config.told or level_of(preset, q_functions=False)
    if config.algorithm == "h-bc":
        return f"{config.algorithm} {config.preset}, told {told}"
    warm = preset.warm_start if config.warm_start is None else config.warm_start
    changed = f", {config.values}" if config.values else ""
    return f"{config.algorithm} {config.preset}, told {told}, {warm} demonstration{'s' * (warm != 1)}{changed}"


def write(path: Path, runs: Iterable[Run]) -> None:
    """Write one row per measurement."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("run", "seed", "episode", "units", "episodes", "successes"))
        for run in runs:
            writer.writerows((run.name, run.seed, episode, f"{units:g}", *rest) for episode, units, *rest in run.rows)


def drawn(groups: Sequence[tuple[str, Sequence[Run]]]) -> Figure:
    """Return the figure: for each group of runs, the median and range of success against cost."""
    figure = Figure(look.SIZE, layout="constrained")
    axes = figure.subplots()
    legend = []
    for (name, runs), style in zip(groups, cycle(STYLES), strict=False):
        look.curve(axes, [track(run) for run in runs], style)
        legend.append((f"{name} ({len(runs)} seed{'s' * (len(runs) != 1)})", style))
    look.percent_axis(axes, "Success on fresh instances")
    look.count_axis(axes.xaxis, "Expert cost, units")
    axes.set_xlim(left=0)
    handles = [Line2D([], [], color=one.color, linestyle=one.line, linewidth=1.8, label=name) for name, one in legend]
    figure.legend(
        handles=handles,
        loc="outside lower left",
        handlelength=3.6,
        title=EXPLANATION,
        alignment="left",
        title_fontsize=9,
    )
    return figure


def track(run: Run) -> Track:
    """Return a run's success as a function of its cost."""
    _, units, n, successes = np.array(run.rows, float).T
    return Track(units, 100 * successes / n, over=True)


def lines_of(groups: Sequence[tuple[str, Sequence[Run]]]) -> Iterator[str]:
    """Yield the lines of a table in Markdown: medians over the runs, with their ranges."""
    yield f"| run | seeds | {' | '.join(f'units to {goal:.0%}'.replace('%', ' %') for goal in GOALS)} |"
    yield f"|{'---|' * (2 + len(GOALS))}"
    for name, runs in groups:
        cells = []
        for goal in GOALS:
            cells.append(cell([run.first_at(goal)[1] for run in runs]))
        yield f"| {name} | {len(runs)} | {' | '.join(cells)} |"


def cell(values: Sequence[float], decimals: int = 0) -> str:
    """Return a median and a range in words."""
    found = spread(values)
    assert found is not None
    numbers = found.median, found.low, found.high
    median, low, high = ("never" if math.isinf(one) else f"{one:,.{decimals}f}" for one in numbers)
    return f"{median} ({low} to {high})"


def main() -> None:
    """Read the stores, write the files, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("stores", nargs="*", type=Path, help="stores of measured runs, with their checkpoints beside")
    parser.add_argument("--to", type=Path, help="the folder to write to; without it, only the table is printed")
    given = parser.parse_args()
    runs = sorted((run for store in given.stores for run in runs_of(store)), key=lambda run: (run.name, run.seed))
    if not runs:
        parser.exit(0, "Nothing was drawn. Give stores of runs that were trained with --measure.\n")
    groups = [(name, list(some)) for name, some in groupby(runs, key=lambda run: run.name)]
    if given.to is not None:
        given.to.mkdir(parents=True, exist_ok=True)
        write(given.to / "measured.csv", runs)
        with rc_context(look.RC):
            drawn(groups).savefig(given.to / "levels.svg", metadata={"Date": None})
    print("\n".join(lines_of(groups)))


if __name__ == "__main__":
    main()
