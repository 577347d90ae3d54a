"""Draws what labels bought at each level of what a learner is told, from runs with `--measure`.

    python bench/levels.py STORE ... --to docs/results/general --no-labels docs/results/general/no-labels.csv

It reads the measurements beside the runs' checkpoints, writes `measured.csv`, with one row per measurement, and
`levels.svg`, and prints a table: the units to 80, 90, 95 and 99 % of the measured instances. `--also` adds runs from a
`measured.csv` that was written before, whose stores need not exist any more. It asserts nothing.
"""

import argparse
import csv
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from waypost_learner.experiments.figures import look
from waypost_learner.experiments.figures.statistics import Track, spread
from waypost_learner.presets import find_preset
from waypost_learner.presets.told import LEVELS, STRUCTURE, level_of
from waypost_learner.runs.checkpoints import read_header
from waypost_learner.runs.config import TrainConfig

GOALS = (0.8, 0.9, 0.95, 0.99)
TITLES = {
    "nothing": "Told nothing",
    "symmetries": "Told symmetries",
    "centered": "Told where the agent is",
    "crop": "Told what is around it",
    STRUCTURE: "Told all structure",
}
STYLES = {
    "hg-DAgger": look.Style("#0072B2", "solid", "o"),
    "h-BC": look.Style("#D55E00", (0, (5, 2)), "s"),
    "flat DAgger": look.Style("#009E73", (0, (6, 2, 1, 2)), "^"),
    "first demonstrations alone": look.Style("#CC79A7", "none", "D"),
}
OTHER = look.Style("#E69F00", (0, (9, 2, 1, 2)), "v")
WITHOUT_LABELS = {"random actions": (0, (1, 3)), "planner": (0, (4, 4))}
EXPLANATION = "Lines: medians over the seeds. Bands: ranges. Points: single runs."
COLUMNS = (
    "told",
    "preset",
    "algorithm",
    "demonstrations",
    "values",
    "seed",
    "episode",
    "units",
    "episodes",
    "successes",
)


@dataclass(frozen=True)
class Series:
    """Runs that differ only in the seed. A run of h-BC with values is trained longer on its few demonstrations."""

    told: str
    preset: str
    algorithm: str
    demonstrations: int
    values: str

    @property
    def label(self) -> str:
        """The name in the legend."""
        if self.algorithm == "h-bc" and self.values:
            return "first demonstrations alone"
        named = {"hg-dagger": "hg-DAgger", "h-bc": "h-BC", "flat-dagger": "flat DAgger"}
        return f"{named.get(self.algorithm, self.algorithm)}{', ' if self.values else ''}{self.values}"

    @property
    def name(self) -> str:
        """The name in the table."""
        n = self.demonstrations
        return f"{self.label} ({self.preset}), told {self.told}, {n} demonstration{'s' * (n != 1)}"


@dataclass(frozen=True)
class Run:
    """A run: its id, its series, its seed, its measurements (episode, units, instances, successes)."""

    id: str
    series: Series
    seed: int
    rows: Sequence[tuple[int, float, int, int]]

    @property
    def name(self) -> str:
        """The name of its series."""
        return self.series.name

    def first_at(self, goal: float) -> tuple[float, float]:
        """Return the episode and units of the first measurement as high as the goal; both infinite without one."""
        found = ((episode, units) for episode, units, n, successes in self.rows if successes >= goal * n)
        return next(found, (math.inf, math.inf))


def runs_of(store: Path) -> Iterator[Run]:
    """Yield the measured runs of a store that have a checkpoint."""
    for file in sorted(store.with_name(f"{store.name}.checkpoints").glob("*.measured.csv")):
        checkpoint = file.with_name(file.name.replace(".measured.csv", ".safetensors"))
        if not checkpoint.exists():
            continue
        config = read_header(checkpoint).config
        with file.open(newline="") as opened:
            rows = [measurement(row) for row in csv.DictReader(opened)]
        yield Run(file.name.removesuffix(".measured.csv"), series_of(config), config.seed, rows)


def measurement(row: Mapping[str, str]) -> tuple[int, float, int, int]:
    """Return a measurement of a CSV file."""
    return int(row["episode"]), float(row["units"]), int(row["episodes"]), int(row["successes"])


def series_of(config: TrainConfig) -> Series:
    """Return the series of a run. All episodes of h-BC are demonstrations."""
    preset = find_preset(config.preset, domain=config.domain)
    told = config.told or level_of(preset, q_functions=False)
    warm = preset.warm_start if config.warm_start is None else config.warm_start
    shown = config.episodes if config.algorithm == "h-bc" else warm
    return Series(told, config.preset, config.algorithm, shown, config.values or "")


def written(path: Path) -> Iterator[Run]:
    """Yield the runs that `write` wrote."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    for key, some in groupby(rows, key=lambda row: tuple(row[column] for column in COLUMNS[:6])):
        told, preset, algorithm, demonstrations, values, seed = key
        series = Series(told, preset, algorithm, int(demonstrations), values)
        yield Run("", series, int(seed), [measurement(row) for row in some])


def write(path: Path, runs: Iterable[Run]) -> None:
    """Write one row per measurement."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for run in runs:
            series = run.series
            about = series.told, series.preset, series.algorithm, series.demonstrations, series.values, run.seed
            writer.writerows((*about, episode, f"{units:g}", *rest) for episode, units, *rest in run.rows)


def drawn(groups: Sequence[tuple[Series, Sequence[Run]]], without: Mapping[str, Mapping[str, float]]) -> Figure:
    """Return the figure: for each level a panel, with the median and range of success against cost of each series.

    Args:
        groups: the series with their runs.
        without: for a level, the percentage of success without any label, by what acts.
    """
    levels = [level for level in (*LEVELS, STRUCTURE) if any(series.told == level for series, _ in groups)]
    figure = Figure((4.2 * len(levels), 4.6), layout="constrained")
    panels = figure.subplots(1, len(levels), sharex=True, sharey=True, squeeze=False)[0]
    for level, axes in zip(levels, panels, strict=True):
        axes.set_title(TITLES[level])
        for series, runs in groups:
            if series.told == level:
                draw(axes, runs, STYLES.get(series.label, OTHER))
        for what, percent in without.get(level, {}).items():
            axes.axhline(percent, color="black", linewidth=1.2, linestyle=WITHOUT_LABELS[what])
        look.count_axis(axes.xaxis, "Expert cost, units")
    look.percent_axis(panels[0], "Success on fresh instances")
    figure.legend(
        handles=handles(groups, without),
        loc="outside lower left",
        ncols=3,
        handlelength=3.6,
        title=EXPLANATION,
        alignment="left",
        title_fontsize=9,
    )
    return figure


def draw(axes: Axes, runs: Sequence[Run], style: look.Style) -> None:
    """Draw the runs of a series: as a curve, or, if its style has no line, only how each ended, as points."""
    if style.line != "none":
        look.curve(axes, [track(run) for run in runs], style)
        return
    ends = [(units, 100 * successes / n) for _, units, n, successes in (run.rows[-1] for run in runs)]
    axes.plot(*zip(*ends, strict=True), style.marker, color=style.color, markersize=6)


def handles(
    groups: Sequence[tuple[Series, Sequence[Run]]], without: Mapping[str, Mapping[str, float]]
) -> Sequence[Line2D]:
    """Return the entries of the legend."""
    styles = {series.label: STYLES.get(series.label, OTHER) for series, _ in groups}
    lines = [
        Line2D([], [], color=one.color, linestyle=one.line, linewidth=1.8, marker=marker, label=label)
        for label, one in styles.items()
        for marker in ["" if one.line != "none" else one.marker]
    ]
    shown = {series.told for series, _ in groups}
    for what in dict.fromkeys(what for level, acts in without.items() if level in shown for what in acts):
        label = f"without labels: {what}"
        lines.append(Line2D([], [], color="black", linestyle=WITHOUT_LABELS[what], linewidth=1.2, label=label))
    return lines


def track(run: Run) -> Track:
    """Return a run's success as a function of its cost."""
    _, units, n, successes = np.array(run.rows, float).T
    return Track(units, 100 * successes / n, over=True)


def no_labels(path: Path) -> Mapping[str, Mapping[str, float]]:
    """Return the success without labels that `bench/no_labels.py` wrote, in percent: its medians over the seeds."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    random, planner = (float(np.median([float(row[one]) for row in rows])) * 100 for one in ("random", "planner"))
    return {level: {"random actions": random} for level in LEVELS} | {
        STRUCTURE: {"random actions": random, "planner": planner}
    }


def lines_of(groups: Sequence[tuple[str, Sequence[Run]]]) -> Iterator[str]:
    """Yield the lines of a table in Markdown: medians over the runs, with their ranges."""
    yield f"| run | seeds | {' | '.join(f'units to {goal:.0%}'.replace('%', ' %') for goal in GOALS)} |"
    yield f"|{'---|' * (2 + len(GOALS))}"
    for name, runs in groups:
        cells = [cell([run.first_at(goal)[1] for run in runs]) for goal in GOALS]
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
    parser.add_argument("--also", nargs="*", type=Path, default=[], help="files measured.csv of other runs")
    parser.add_argument("--to", type=Path, help="the folder to write to; without it, only the table is printed")
    parser.add_argument("--no-labels", type=Path, help="what bench/no_labels.py wrote")
    given = parser.parse_args()
    found = [run for store in given.stores for run in runs_of(store)]
    found += [run for file in given.also for run in written(file)]
    runs = sorted(found, key=lambda run: (run.name, run.seed))
    if not runs:
        parser.exit(0, "Nothing was drawn. Give stores of runs that were trained with --measure.\n")
    groups = [(series, list(some)) for series, some in groupby(runs, key=lambda run: run.series)]
    if given.to is not None:
        given.to.mkdir(parents=True, exist_ok=True)
        write(given.to / "measured.csv", runs)
        with rc_context(look.RC):
            without = {} if given.no_labels is None else no_labels(given.no_labels)
            drawn(groups, without).savefig(given.to / "levels.svg", metadata={"Date": None})
    print("\n".join(lines_of([(series.name, some) for series, some in groups])))


if __name__ == "__main__":
    main()
