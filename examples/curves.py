"""Draws the curves of an example: success on unseen instances against the expert's cost, from the runs in stores.

    python examples/curves.py runs.db --to examples/minigrid/results

It writes `curves.csv`, with one row per run and episode, and `curves.svg`. It prints a table of the final policies,
whose checkpoints are beside each store: they are tested on the last 200 test instances. As a trivial baseline, it adds
200 episodes of random actions. Of several runs with the same algorithm and seed in a store, the newest counts.
"""

import argparse
import csv
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import groupby
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from waypost import wire
from waypost.domains import Domain, find_domain, place_of
from waypost_learner.commands import checkpoint_folder
from waypost_learner.experiments.figures import look
from waypost_learner.experiments.figures.statistics import Track, spread
from waypost_learner.experiments.plan.series import Series
from waypost_learner.remote.embedded import stored_runs
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs import checkpoints
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.evaluation import evaluate
from waypost_learner.runs.setup import build_learner

WINDOW = 20  # tests in a success rate
UNSEEN = 200  # test instances for the table
RANDOM = "random actions"
EXPLANATION = "Lines: medians over the seeds. Bands: ranges. Each rate is over the tests just before and after."
LABELS = {"hg-dagger": "hg-DAgger", "h-bc": "h-BC", "flat-dagger": "flat DAgger", "flat-bc": "flat BC"}


@dataclass(frozen=True)
class Row:
    """One episode of a run: the cost so far in units, and whether its test on an unseen instance succeeded."""

    domain: str
    algorithm: str
    seed: int
    episode: int
    units: float
    test_success: int


def main() -> None:
    """Read the stores, write the files, and print the table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("stores", nargs="+", type=Path, help="stores of one domain's runs")
    arguments.add_argument("--to", type=Path, required=True, help="the folder to write to")
    given = arguments.parse_args()
    rows, table = list[Row](), list[tuple[str, float, float]]()
    for store in given.stores:
        rows += rows_of(store)
        table += final_policies(store)
    domain = domain_of(given.stores[0])
    rows += random_actions(domain)
    table.append((RANDOM, 0, float(np.mean([row.test_success for row in rows if row.algorithm == RANDOM]))))
    rows.sort(key=lambda row: (row.algorithm, row.seed, row.episode))
    given.to.mkdir(parents=True, exist_ok=True)
    write(given.to / "curves.csv", rows)
    with rc_context(look.RC):
        curves(rows).savefig(given.to / "curves.svg", metadata={"Date": None})
    print("\n".join(lines_of(table)))


def rows_of(store: Path) -> Iterator[Row]:
    """Yield the rows of every run in a store. Episodes without a test are left out."""
    with stored_runs(store) as runs:
        for run in newest(runs.runs()):
            columns = runs.curves(run.id)
            for episode, units, success in zip(columns.episode, columns.cost, columns.test_success, strict=True):
                if success is not None:
                    yield Row(run.vocabulary.domain, run.algorithm, run.seed, episode, units, int(success))


def final_policies(store: Path) -> Iterator[tuple[str, float, float]]:
    """Yield the algorithm, the cost in units, and the success on unseen instances of each run's final policies."""
    with stored_runs(store) as runs:
        for run in newest(runs.runs()):
            path = checkpoint_folder(None, store, None) / f"{run.id}.safetensors"
            learner = build_learner(checkpoints.read_header(path).config, threads=1)
            checkpoints.load(path, learner)
            unseen = learner.domain.instances("random").test[-UNSEEN:]
            yield run.algorithm, runs.curves(run.id).cost[-1], evaluate(learner, unseen, len(unseen)).success_rate


def newest(runs: Sequence[wire.Run]) -> Sequence[wire.Run]:
    """Return the first run of each algorithm and seed; a store lists its newest run first."""
    found: dict[tuple[str, int], wire.Run] = {}
    for run in runs:
        found.setdefault((run.algorithm, run.seed), run)
    return list(found.values())


def domain_of(store: Path) -> Domain:
    """Return the domain of the runs in a store."""
    with stored_runs(store) as runs:
        return find_domain(place_of(runs.runs()[0]))


def random_actions(domain: Domain) -> Iterator[Row]:
    """Yield episodes in which all actions are equally likely."""
    rng, simulator = np.random.default_rng(0), Simulator(domain)
    for episode, instance in enumerate(domain.instances("random").test[-UNSEEN:]):
        simulator.reset(instance)
        while not simulator.ended:
            simulator.step(int(rng.integers(len(domain.actions))))
        yield Row(domain.name, RANDOM, 0, episode, 0, int(simulator.succeeded))


def write(path: Path, rows: Sequence[Row]) -> None:
    """Write the rows as CSV."""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(asdict(rows[0])), lineterminator="\n")
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)


def curves(rows: Iterable[Row]) -> Figure:
    """Return the figure: for each algorithm, the median and range over its seeds."""
    with rc_context(look.RC):
        figure = Figure(look.SIZE, layout="constrained")
        axes = figure.subplots()
    legend = []
    for algorithm, runs in groupby(rows, key=lambda row: row.algorithm):
        seeds = [list(run) for _, run in groupby(runs, key=lambda row: row.seed)]
        if algorithm == RANDOM:
            style = replace(look.SUM, line=(0, (1, 3)))
            success = 100 * float(np.mean([row.test_success for row in seeds[0]]))
            axes.axhline(success, color=style.color, linestyle=style.line)
        else:
            style = look.style_of(Series(TrainConfig(algorithm), algorithm))
            look.curve(axes, [track(run) for run in seeds], style)
        legend.append((LABELS.get(algorithm, algorithm), style))
    look.percent_axis(axes, f"Success on unseen instances ({WINDOW} tests)")
    look.count_axis(axes.xaxis, "Expert cost, units")
    look.legend(
        figure,
        legend,
        EXPLANATION,
        markers=False,
    )
    return figure


def track(run: Sequence[Row]) -> Track:
    """Return a run's success rate over the tests before and after each episode, as a function of its cost.

    A rate over past tests alone would lag behind, and most for algorithms whose episodes cost most.
    """
    success, half = [row.test_success for row in run], WINDOW // 2
    rate = [100 * float(np.mean(success[max(0, n - half) : n + half])) for n in range(len(run))]
    return Track(np.array([row.units for row in run]), np.array(rate), over=False)


def lines_of(table: Sequence[tuple[str, float, float]]) -> Iterator[str]:
    """Yield the lines of a table in Markdown: medians over the runs, with their ranges."""
    yield "| algorithm | runs | units | success on unseen instances |"
    yield "|---|---|---|---|"
    for algorithm, runs in groupby(sorted(table, key=lambda row: row[0]), key=lambda row: row[0]):
        _, costs, successes = zip(*runs, strict=True)
        units, success = spread(costs), spread([100 * rate for rate in successes])
        assert units is not None
        assert success is not None
        yield (
            f"| {LABELS.get(algorithm, algorithm)} | {len(costs)} | {units.median:,.0f} ({units.low:,.0f} to "
            f"{units.high:,.0f}) | {success.median:.0f} % ({success.low:.0f} to {success.high:.0f}) |"
        )


if __name__ == "__main__":
    main()
