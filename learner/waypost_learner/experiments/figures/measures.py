"""The numbers that are compared: of each run, over the runs of a series, beside the published ones."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from waypost_learner.experiments.figures.data import Column, Comparison, RunCurves
from waypost_learner.experiments.figures.published import EPISODES, LEVELS, NEVER, Published, published
from waypost_learner.experiments.figures.statistics import Spread, Track, first_at, spread

Unit = Literal["%", "units", "hours", "minutes", "samples", "labels", "labels per 1,000 samples", ""]

LATE = 500  # episodes: LO labels are needed early, so the cost after these is looked at
UNKNOWN = float("nan")  # an unfinished run may still get there


@dataclass(frozen=True)
class Measure:
    """A number of a run; `of` takes the run and whether inspections are left out of costs."""

    name: str
    unit: Unit
    of: Callable[[RunCurves, bool], float]
    published: Callable[[Published], float | None] = lambda _: None


@dataclass(frozen=True)
class Topic:
    """Measures that stand in one table."""

    title: str
    measures: tuple[Measure, ...]


@dataclass(frozen=True)
class Result:
    """A measure over the runs of a series, or of two, and what was published of it."""

    group: str
    series: str
    measure: str
    unit: Unit
    ours: Spread | None
    published: float | None


def results(comparison: Comparison, topic: Topic) -> Iterator[Result]:
    """Yield a topic's measures of every series."""
    group = comparison.group
    for series, runs in comparison.runs.items():
        known = published(group, series)
        for measure in topic.measures:
            ours = spread([measure.of(run, group.labels_only) for run in runs])
            yield Result(group.name, series.label, measure.name, measure.unit, ours, measure.published(known))


def topics(comparison: Comparison) -> tuple[Topic, ...]:
    """Return what is compared in a group."""
    if comparison.group.lean:
        return _LEAN
    return _HYBRID if comparison.group.hybrid else _IMITATION


# --- one run's numbers


def at_end(run: RunCurves, column: Column) -> float:
    """Return a column's last value, of a complete run."""
    return float(column[-1]) if run.complete else UNKNOWN


def success_after(run: RunCurves, episodes: int) -> float:
    """Return the success rate, in percent, after a number of episodes."""
    row = np.flatnonzero(run.episodes == episodes)
    return 100 * float(run.success_rate[row[0]]) if len(row) else UNKNOWN


def at_level(run: RunCurves, level: float, column: Column) -> float:
    """Return a column's value where the success rate first reached a level; infinite if it never did."""
    row = first_at(level, run.test_success, run.success_rate)
    if row is None:
        return NEVER if run.complete else UNKNOWN
    return float(column[row])


def late_share(run: RunCurves, column: Column) -> float:
    """Return the share, in percent, of a cumulative column that came after episode 500."""
    end, row = at_end(run, column), np.flatnonzero(run.episodes == LATE)
    return 100 * (end - float(column[row[0]])) / end if len(row) and end > 0 else UNKNOWN


def labels_per_thousand_samples(run: RunCurves, begin: float, end: float) -> float:
    """Return the HI labels per 1,000 LO samples between two shares of the run's LO samples."""
    samples = at_end(run, run.lo_samples)
    if not samples > 0:
        return UNKNOWN
    before, after = Track(run.lo_samples, run.hi_labels, run.complete).at(samples * np.array([begin, end]))
    return float(1_000 * (after - np.nan_to_num(before)) / (samples * (end - begin)))


# --- what is compared


def _success(episodes: int) -> Measure:
    return Measure(
        f"success after {episodes:,} episodes",
        "%",
        lambda run, _: success_after(run, episodes),
        lambda known: _percent(known.success.get(episodes)),
    )


def _cost_at(level: float) -> Measure:
    return Measure(
        f"expert cost when {level:.0%} was reached",
        "units",
        lambda run, labels_only: at_level(run, level, run.cost(labels_only)),
        lambda known: known.cost_at.get(level),
    )


def _percent(share: float | None) -> float | None:
    return None if share is None else 100 * share


_HOURS = Measure("learner's hours", "hours", lambda run, _: at_end(run, run.learner_seconds) / 3600)

_IMITATION = (
    Topic("Success on unseen mazes", tuple(_success(episodes) for episodes in EPISODES)),
    Topic(
        "Expert cost",
        (
            *(_cost_at(level) for level in LEVELS),
            Measure(
                "expert cost in all",
                "units",
                lambda run, labels_only: at_end(run, run.cost(labels_only)),
                lambda known: known.cost,
            ),
        ),
    ),
    Topic(
        "LO-level expert cost",
        (
            Measure(
                "LO cost in all",
                "units",
                lambda run, _: at_end(run, run.lo_cost),
                lambda known: known.cost if known.lo_only else None,
            ),
            Measure("share of it after episode 500", "%", lambda run, _: late_share(run, run.lo_cost)),
            Measure("LO cost without demonstrations", "units", lambda run, _: at_end(run, run.lo_label_cost)),
            Measure("share of that after episode 500", "%", lambda run, _: late_share(run, run.lo_label_cost)),
            _HOURS,
        ),
    ),
)

_LEAN = (
    Topic(
        "Success and cost",
        (
            *(_success(episodes) for episodes in (100, 200, 300)),
            *(_cost_at(level) for level in (0.8, 0.95, 0.99)),
            Measure("expert cost in all", "units", lambda run, labels: at_end(run, run.cost(labels))),
            Measure("learner's minutes", "minutes", lambda run, _: at_end(run, run.learner_seconds) / 60),
        ),
    ),
)

_HYBRID = (
    Topic(
        "Success on unseen mazes",
        (
            Measure(
                "success at the end",
                "%",
                lambda run, _: 100 * at_end(run, run.success_rate),
                lambda known: _percent(known.final),
            ),
            Measure("episodes when 90% was reached", "", lambda run, _: at_level(run, 0.9, run.episodes)),
            Measure("LO samples when 90% was reached", "samples", lambda run, _: at_level(run, 0.9, run.lo_samples)),
            Measure("LO samples in all", "samples", lambda run, _: at_end(run, run.lo_samples)),
            _HOURS,
        ),
    ),
    Topic(
        "HI labels",
        (
            Measure("HI labels in all", "labels", lambda run, _: at_end(run, run.hi_labels)),
            Measure(
                "HI labels per 1,000 LO samples, first fifth",
                "labels per 1,000 samples",
                lambda run, _: labels_per_thousand_samples(run, 0.0, 0.2),
            ),
            Measure(
                "HI labels per 1,000 LO samples, last fifth",
                "labels per 1,000 samples",
                lambda run, _: labels_per_thousand_samples(run, 0.8, 1.0),
            ),
            Measure("expert cost in all, with inspections", "units", lambda run, labels: at_end(run, run.cost(labels))),
        ),
    ),
)


# --- one series held against another, seed by seed


@dataclass(frozen=True)
class _Ratio:
    name: str
    of: str  # algorithms
    to: str
    amount: Callable[[RunCurves, bool], float]
    published: Callable[[Published], float | None] = lambda _: None


_RATIOS = (
    _Ratio(
        "expert cost of hg-DAgger to flat DAgger's",
        "hg-dagger",
        "flat-dagger",
        lambda run, labels_only: at_end(run, run.cost(labels_only)),
        lambda known: known.cost,
    ),
    _Ratio(
        "LO cost of naive h-DAgger to hg-DAgger's",
        "naive-h-dagger",
        "hg-dagger",
        lambda run, _: at_end(run, run.lo_cost),
    ),
    _Ratio(
        "LO cost of naive h-DAgger to hg-DAgger's, without demonstrations",
        "naive-h-dagger",
        "hg-dagger",
        lambda run, _: at_end(run, run.lo_label_cost),
    ),
)


def ratios(comparison: Comparison) -> Iterator[Result]:
    """Yield the ratios between series of a group: of runs of one seed, so that both saw the same mazes."""
    group = comparison.group
    by_algorithm = {series.config.algorithm: series for series in comparison.runs}
    for ratio in _RATIOS:
        if ratio.of not in by_algorithm or ratio.to not in by_algorithm:
            continue
        above, below = by_algorithm[ratio.of], by_algorithm[ratio.to]
        amounts = [
            {run.config.seed: ratio.amount(run, group.labels_only) for run in comparison.runs[series]}
            for series in (above, below)
        ]
        ours = spread([_divided(amount, amounts[1].get(seed, UNKNOWN)) for seed, amount in amounts[0].items()])
        known = [ratio.published(published(group, series)) for series in (above, below)]
        yield Result(group.name, "", ratio.name, "", ours, known[0] / known[1] if known[0] and known[1] else None)


def _divided(amount: float, by: float) -> float:
    return amount / by if by else UNKNOWN


def summary(comparisons: Sequence[Comparison]) -> list[Result]:
    """Return every result there is."""
    return [
        result
        for comparison in comparisons
        for found in (*(results(comparison, topic) for topic in topics(comparison)), ratios(comparison))
        for result in found
    ]
