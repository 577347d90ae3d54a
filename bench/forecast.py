"""Compares forecasts with what the committed runs then did: `python bench/forecast.py --to docs/results/forecast`.

Each run is cut at a share of its units, and forecast from what was known then. Runs with even seeds chose the constants
of `server/waypost_server/runs/futures.py`; the tables are of the others, and of the even ones apart. A run is never
among the finished runs that its own forecast uses. It writes `backtest.csv.gz`, with one row per forecast, and prints
tables. `--report FILE` writes a document with one row per run. It asserts nothing. `--score` prints only the mean score
of the even seeds: lower is better.
"""

import argparse
import csv
import gzip
import math
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from statistics import mean, median

from waypost.wire import KINDS, SuccessLevel
from waypost_server.runs.futures import CONSTANTS, Constants, Finished, Outcomes, Outlook, Span, futures_of
from waypost_server.runs.service import TRAILING

RESULTS = Path(__file__).parents[1] / "docs" / "results"
FILES = [RESULTS / folder / "runs.csv.gz" for folder in (".", "lean", "montezuma")]
SETTINGS = ("algorithm", "domain", "instances", "preset", "episodes", "in_flight", "warm_start", "redraw", "head_start")
MORE_SETTINGS = ("environments", "told", "values")
PARTS = (0.25, 0.5, 0.75)
TARGETS: tuple[SuccessLevel, ...] = ("0.8", "0.9", "0.95")
FURTHEST = 50  # for the score, everything beyond so many times the units spent is equally far


@dataclass(frozen=True)
class Run:
    """A committed run: its settings without the seed, its tests, its units, and when it reached each level."""

    settings: tuple[str, ...]
    seed: int
    tests: Outcomes
    spent: float
    reached: Outlook

    @property
    def kind(self) -> tuple[str, str]:
        """The algorithm and the domain."""
        return self.settings[0], self.settings[1]

    @property
    def chose(self) -> bool:
        """Whether it chose the constants."""
        return self.seed % 2 == 0


def committed() -> list[Run]:
    """Return the runs with units and with at least one window of tests; a run in two files counts once."""
    rows = defaultdict[tuple[str, ...], dict[int, dict[str, str]]](dict)
    for path in FILES:
        with gzip.open(path, "rt", newline="") as file:
            for row in csv.DictReader(file):
                settings = tuple(row.get(name) or "" for name in (*SETTINGS, *MORE_SETTINGS, "seed"))
                rows[settings][int(row["episode"])] = row
    found = []
    for (*settings, seed), by_episode in rows.items():
        of_run = [(sum(float(row[kind] or 0) for kind in KINDS), row) for _, row in sorted(by_episode.items())]
        made = [(units, row["test_success"] == "1") for units, row in of_run if row["test_success"]]
        tests = Outcomes([units for units, _ in made], [passed for _, passed in made])
        spent = of_run[-1][0]
        if spent > 0 and len(made) >= TRAILING:
            found.append(Run(tuple(settings), int(seed), tests, spent, tests.reached()))
    return found


def differences(run: Run, other: Run) -> int:
    """Return the number of settings in which two runs differ."""
    return sum(a != b for a, b in zip(run.settings, other.settings, strict=True))


INFORMATION: dict[str, Callable[[int], bool]] = {  # the finished runs that are used, by their number of differences
    "all other runs": lambda _: True,
    "only other configurations": lambda count: count > 0,
    "no finished run": lambda _: False,
}


@dataclass(frozen=True)
class Case:
    """One forecast, the truth, and what the baselines say."""

    run: Run
    target: SuccessLevel
    part: float
    information: str
    spent: float
    truth: float
    span: Span | None  # None: too early to say
    missed: float | None
    line: float
    finished: Span | None

    @property
    def covered(self) -> bool:
        """Whether the 80 % range holds the truth; a run that never got there needs a range without an end."""
        return self.span is not None and self.span.low <= self.truth <= self.span.high


def cases(runs: Sequence[Run], targets: Sequence[SuccessLevel], constants: Constants = CONSTANTS) -> Iterator[Case]:
    """Yield a forecast for each run, cut, information and target; none if the target was reached before the cut."""
    summaries = {id(run): Finished.of(run.tests, run.spent, 0) for run in runs}
    for run, part, (name, knows) in product(runs, PARTS, INFORMATION.items()):
        spent = run.spent * part
        n_tests = sum(units <= spent for units in run.tests.units)
        tests = Outcomes(run.tests.units[:n_tests], run.tests.passed[:n_tests])
        finished = [
            replace(summaries[id(other)], differences=count)
            for other in runs
            if other is not run and other.kind == run.kind and knows(count := differences(run, other))
        ]
        open_targets = [target for target in targets if run.reached[target] > spent]
        futures = futures_of(tests, spent, finished, constants) if open_targets else None
        for target in open_targets:
            assert futures is not None
            is_early = futures.too_early(target) is not None
            yield Case(
                run,
                target,
                part,
                name,
                spent,
                run.reached[target],
                None if is_early else futures.span(target),
                None if is_early else futures.missed(target),
                straight_line(tests, spent, float(target)),
                of_finished([max(spent, one.reached[target]) for one in finished]),
            )


def straight_line(tests: Outcomes, spent: float, target: float) -> float:
    """Baseline 1: the last half of the tests goes on in a straight line (least squares)."""
    half = len(tests.units) // 2
    units, passed = tests.units[half:], tests.passed[half:]
    if len(units) < 2:
        return math.inf
    x, y = mean(units), mean(passed)
    spread = sum((one - x) ** 2 for one in units)
    slope = sum((one - x) * (success - y) for one, success in zip(units, passed, strict=True)) / (spread or 1.0)
    return max(spent, x + (target - y) / slope) if slope > 0 else math.inf


def of_finished(reached: list[float]) -> Span | None:
    """Baseline 2: when the finished runs of the domain and algorithm reached it; their median and middle 80 %."""
    reached.sort()
    at = [reached[min(int(share * len(reached)), len(reached) - 1)] for share in (0.1, 0.5, 0.9)] if reached else None
    return Span(*at) if at else None


def error(forecast: float, truth: float) -> float:
    """Return the absolute difference of logarithms."""
    return abs(math.log(forecast / truth)) if forecast < math.inf else math.inf


def score(case: Case) -> float:
    """Return the interval score of an 80 % range, in logarithms of units (Gneiting and Raftery 2007, section 6.2)."""
    assert case.span is not None
    low, high, truth = (
        math.log(min(units, FURTHEST * case.spent)) for units in (case.span.low, case.span.high, case.truth)
    )
    return high - low + 10 * max(0.0, low - truth) + 10 * max(0.0, truth - high)


def line_of(found: Sequence[Case]) -> str:
    """Return the cells of a table about these forecasts."""
    said = [case for case in found if case.span is not None]
    got_there = [case for case in said if case.truth < math.inf]
    never = [case for case in said if case.truth == math.inf]
    known = [case for case in said if case.finished is not None]
    open_never = sum(case.covered for case in never)
    known_covered = sum(case.finished.low <= case.truth <= case.finished.high for case in known if case.finished)
    ours = [error(case.span.median, case.truth) for case in got_there if case.span]
    lines = [error(case.line, case.truth) for case in got_there]
    medians = [error(case.finished.median, case.truth) for case in got_there if case.finished]
    cells = [
        f"{len(found)}",
        f"{len(found) - len(said)}",
        share(sum(case.covered for case in said), len(said)),
        f"{open_never} of {len(never)}",
        share(known_covered, len(known)),
        *(middle(errors) for errors in (ours, lines, medians)),
        f"{len(got_there)}",
    ]
    return " | ".join(cells)


def share(part: int, whole: int) -> str:
    """Return a share as text."""
    return f"{part} of {whole} ({part / whole:.0%})" if whole else "none"


def middle(errors: Sequence[float]) -> str:
    """Return the median as text."""
    return f"{median(errors):.2f}".replace("inf", "∞") if errors else "none"


HEAD = (
    "runs | too early | in the 80 % range | of them never there | in the range of the finished runs | error | "
    "error, straight line | error, median of the finished runs | n of errors"
)


def table(title: str, rows: dict[str, list[Case]]) -> None:
    """Print a table."""
    print(f"\n**{title}**\n\n| | {HEAD} |\n|{'---|' * 10}")
    for name, found in rows.items():
        if found:
            print(f"| {name} | {line_of(found)} |")


def write(path: Path, found: Sequence[Case]) -> None:
    """Write one row per forecast; an empty cell: never, or none."""

    def cell(units: float | None) -> str:
        return "" if units is None or units == math.inf else f"{units:.6g}"

    with gzip.open(path, "wt", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        names = ("chose", *SETTINGS[:4], "values", "seed", "target", "part", "information", "spent", "truth")
        writer.writerow((*names, "too_early", "low", "median", "high", "missed", "line", "finished_median"))
        for case in found:
            span, finished = case.span or Span(*[math.inf] * 3), case.finished or Span(*[math.inf] * 3)
            settings = (*case.run.settings[:4], case.run.settings[-1], case.run.seed)
            about = (case.target, case.part, case.information, cell(case.spent), cell(case.truth))
            amounts = (span.low, span.median, span.high, case.missed, case.line, finished.median)
            writer.writerow((int(case.run.chose), *settings, *about, int(case.span is None), *map(cell, amounts)))


REPORT = """# Forecasts of each run

`python bench/forecast.py --to docs/results/forecast --report docs/forecast-results.md` writes this document; do not
edit it. Each committed run was cut at a quarter of its units. From what was known then, and from all other runs, it was
forecast after how many units 90 % of the last 100 tests would succeed ([how](experimenter.md#how-much-is-left-to-pay)).
A range without an upper end holds a run that never got there.

The 80 % range held {totals}.
For {early} of the {shown} runs it was too early to say.{others}

| run | at a quarter: units | the 80 % range | it got there at | in the range |
|---|---|---|---|---|
{rows}
"""


def report(runs: Sequence[Run], quarter: Sequence[Case]) -> str:
    """Return a document about the forecasts of each run at a quarter of its units."""

    def held(words: str, chose: bool | None) -> str:
        said = [case for case in quarter if case.span is not None and chose in (None, case.run.chose)]
        return f"{sum(case.covered for case in said)} of {len(said)} {words}"

    totals = (
        f"{held('runs', None)}: {held('with odd seeds, which measure,', False)} and\n"
        f"{held('with even seeds, which chose the constants', True)}"
    )
    rows = [row_of(case) for case in sorted(quarter, key=lambda case: (case.run.settings, case.run.seed))]
    early = sum(case.span is None for case in quarter)
    done = len(runs) - len(quarter)
    others = f" {done} more had reached 90 % before." if done else ""
    return REPORT.format(totals=totals, early=early, shown=len(quarter), others=others, rows="\n".join(rows))


def row_of(case: Case) -> str:
    """Return a row about one forecast."""

    def amount(units: float) -> str:
        return f"{units:,.0f}" if units < math.inf else "never"

    values = dict(zip((*SETTINGS, *MORE_SETTINGS), case.run.settings, strict=True))
    shown = [values[name] for name in ("algorithm", "domain", "instances", "preset")]
    shown += [f"{values['episodes']} episodes"]
    shown += [f"{name} {values[name]}" for name in ("warm_start", "told") if values[name]]
    shown += ["redraw"] if values["redraw"] == "True" else []
    shown += [f"`{values['values']}`"] if values["values"] else []
    about = f"{', '.join(shown)}, seed {case.run.seed}"
    if case.span is None:
        span = "too early"
    else:
        span = "never" if case.span.low == math.inf else f"{amount(case.span.low)} to {amount(case.span.high)}"
    held = "" if case.span is None else "yes" if case.covered else "**no**"
    return f"| {about} | {amount(case.spent)} | {span} | {amount(case.truth)} | {held} |"


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--to", type=Path, metavar="FOLDER", help="where to write backtest.csv.gz")
    parser.add_argument("--report", type=Path, metavar="FILE", help="where to write one row per run")
    parser.add_argument("--score", action="store_true", help="print only the score of the runs that choose")
    arguments = parser.parse_args()
    runs = committed()
    if arguments.score:
        found = [case for case in cases(runs, ("0.9",)) if case.run.chose and case.span]
        print(f"{mean(map(score, found)):.3f}")
        return
    found = list(cases(runs, TARGETS))
    if arguments.to:
        arguments.to.mkdir(parents=True, exist_ok=True)
        write(arguments.to / "backtest.csv.gz", found)
    if arguments.report:
        every = [case for case in found if case.target == "0.9" and case.information == "all other runs"]
        arguments.report.write_text(report(runs, [case for case in every if case.part == PARTS[0]]))
    for chose, words in ((False, "odd seeds"), (True, "even seeds, which chose the constants")):
        ninety = [case for case in found if case.run.chose == chose and case.target == "0.9"]
        by_cut = {
            f"{information}, at {part:g} of the units": [
                case for case in ninety if case.information == information and case.part == part
            ]
            for information, part in product(INFORMATION, PARTS)
        }
        table(f"90 %, {words}", by_cut)
        quarter = [case for case in ninety if case.information == "all other runs" and case.part == PARTS[0]]
        kinds = sorted({case.run.kind for case in quarter})
        table(
            f"90 %, at a quarter of the units, {words}",
            {" in ".join(kind): [case for case in quarter if case.run.kind == kind] for kind in kinds},
        )
    odd = [case for case in found if not case.run.chose and case.information == "all other runs"]
    table(
        "Other targets, odd seeds, all other runs, at a quarter of the units",
        {target: [case for case in odd if case.target == target and case.part == PARTS[0]] for target in TARGETS},
    )


if __name__ == "__main__":
    main()
