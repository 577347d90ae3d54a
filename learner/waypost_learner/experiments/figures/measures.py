"""Computes the numbers in the tables: values of single runs, their spread over seeds, and ratios of two series."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from waypost_learner.experiments.figures.data import Column, Comparison, RunCurves
from waypost_learner.experiments.figures.published import (
    EPISODES,
    LEVELS,
    MASTERED,
    NEVER,
    SUBGOALS,
    Published,
    published,
)
from waypost_learner.experiments.figures.statistics import TRAILING, Spread, Track, first_at, spread

Unit = Literal["%", "units", "hours", "minutes", "samples", "labels", "labels per 1,000 samples", ""]

LATE = 500  # episodes: most LO labels are needed before, so the tables show the share of the cost after them
UNKNOWN = float("nan")  # the value of an unfinished run, which may still reach the level


@dataclass(frozen=True)
class Measure:
    """A number that is computed from one run; `of` takes the run and whether costs exclude inspections."""

    name: str
    unit: Unit
    of: Callable[[RunCurves, bool], float]
    published: Callable[[Published], float | None] = lambda _: None


@dataclass(frozen=True)
class Topic:
    """The measures of one table."""

    title: str
    measures: tuple[Measure, ...]


@dataclass(frozen=True)
class Result:
    """The spread of a measure over the runs of a series (or of a ratio of two series), and its published value."""

    group: str
    series: str
    measure: str
    unit: Unit
    ours: Spread | None
    published: float | None


def results(comparison: Comparison, topic: Topic) -> Iterator[Result]:
    """Yield the results of a topic's measures for every series."""
    group = comparison.group
    for series, runs in comparison.runs.items():
        known = published(group, series)
        for measure in topic.measures:
            ours = spread([measure.of(run, group.labels_only) for run in runs])
            yield Result(group.name, series.label, measure.name, measure.unit, ours, measure.published(known))


def topics(comparison: Comparison) -> tuple[Topic, ...]:
    """Return the tables of a group."""
    if comparison.group.lean:
        return _LEAN
    if any(run.reached for runs in comparison.runs.values() for run in runs):
        return _BY_SUBGOAL
    return _HYBRID if comparison.group.hybrid else _IMITATION


# --- numbers of one run


def at_end(run: RunCurves, column: Column) -> float:
    """Return a column's last value, or `UNKNOWN` if the run is unfinished."""
    return float(column[-1]) if run.complete else UNKNOWN


def success_after(run: RunCurves, episodes: int) -> float:
    """Return the success rate in percent after a number of episodes."""
    row = np.flatnonzero(run.episodes == episodes)
    return 100 * float(run.success_rate[row[0]]) if len(row) else UNKNOWN


def at_level(run: RunCurves, level: float, column: Column) -> float:
    """Return a column's value where the success rate first reached a level.

    It is infinite if a complete run never did, and unknown if the run had too few tests for a rate.
    """
    row = first_at(level, run.test_success, run.success_rate)
    if row is not None:
        return float(column[row])
    has_rate = np.count_nonzero(~np.isnan(run.test_success)) >= TRAILING
    return NEVER if run.complete and has_rate else UNKNOWN


def samples_until_learned(run: RunCurves, subgoal: str) -> float:
    """Return the LO samples when a subgoal was learned; infinite if a complete run never learned it."""
    learned = np.flatnonzero(run.reached[subgoal] > MASTERED) if subgoal in run.reached else np.array([], int)
    return float(run.lo_samples[learned[0]]) if len(learned) else NEVER if run.complete else UNKNOWN


def late_share(run: RunCurves, column: Column) -> float:
    """Return the percentage of a cumulative column's last value that was added after episode 500."""
    end, row = at_end(run, column), np.flatnonzero(run.episodes == LATE)
    return 100 * (end - float(column[row[0]])) / end if len(row) and end > 0 else UNKNOWN


def labels_per_thousand_samples(run: RunCurves, begin: float, end: float) -> float:
    """Return the HI labels per 1,000 LO samples in one part of a run.

    The part lies between the shares `begin` and `end` (0 to 1) of the run's LO samples.
    """
    samples = at_end(run, run.lo_samples)
    if not samples > 0:
        return UNKNOWN
    before, after = Track(run.lo_samples, run.hi_labels, run.complete).at(samples * np.array([begin, end]))
    return float(1_000 * (after - np.nan_to_num(before)) / (samples * (end - begin)))


# --- the measures of the tables


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


_HOURS = Measure("learner's wall time, hours", "hours", lambda run, _: at_end(run, run.learner_seconds) / 3600)
_MINUTES = Measure("learner's wall time, minutes", "minutes", lambda run, _: at_end(run, run.learner_seconds) / 60)

_IMITATION = (
    Topic("Success on unseen mazes", tuple(_success(episodes) for episodes in EPISODES)),
    Topic(
        "Expert cost",
        (
            *(_cost_at(level) for level in LEVELS),
            Measure(
                "total expert cost",
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
                "total LO cost",
                "units",
                lambda run, _: at_end(run, run.lo_cost),
                lambda known: known.cost if known.lo_only else None,
            ),
            Measure("share of total LO cost after episode 500", "%", lambda run, _: late_share(run, run.lo_cost)),
            Measure("LO cost without demonstrations", "units", lambda run, _: at_end(run, run.lo_label_cost)),
            Measure(
                "share of LO cost without demonstrations after episode 500",
                "%",
                lambda run, _: late_share(run, run.lo_label_cost),
            ),
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
            Measure("total expert cost", "units", lambda run, labels: at_end(run, run.cost(labels))),
            _MINUTES,
        ),
    ),
)

_AT_END = Measure(
    "success at the end",
    "%",
    lambda run, _: 100 * at_end(run, run.success_rate),
    lambda known: _percent(known.final),
)
_TOTAL_SAMPLES = Measure("total LO samples", "samples", lambda run, _: at_end(run, run.lo_samples))
_TOTAL_HI_LABELS = Measure(
    "total HI labels", "labels", lambda run, _: at_end(run, run.hi_labels), lambda known: known.hi_labels
)
_TOTAL_COST = Measure("total expert cost, with inspections", "units", lambda run, labels: at_end(run, run.cost(labels)))

_HYBRID = (
    Topic(
        "Success on unseen mazes",
        (
            _AT_END,
            Measure("episodes when 90% was reached", "", lambda run, _: at_level(run, 0.9, run.episodes)),
            Measure("LO samples when 90% was reached", "samples", lambda run, _: at_level(run, 0.9, run.lo_samples)),
            _TOTAL_SAMPLES,
            _HOURS,
        ),
    ),
    Topic(
        "HI labels",
        (
            _TOTAL_HI_LABELS,
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
            _TOTAL_COST,
        ),
    ),
)


def _learned(subgoal: str) -> Measure:
    return Measure(
        f"LO samples until {subgoal.replace('_', ' ')} was learned",
        "samples",
        lambda run, _: samples_until_learned(run, subgoal),
        lambda known: known.samples.get(subgoal),
    )


def _attempts(subgoal: str) -> Measure:
    return Measure(
        f"last 100 attempts at {subgoal.replace('_', ' ')}",
        "%",
        lambda run, _: 100 * at_end(run, run.reached[subgoal]) if subgoal in run.reached else 0.0,
    )


_BY_SUBGOAL = (
    Topic(
        "LO samples until more than 90 of the trailing 100 attempts reached a subgoal",
        (*map(_learned, SUBGOALS), _TOTAL_SAMPLES),
    ),
    Topic("Success at the end", (_AT_END, *map(_attempts, SUBGOALS))),
    Topic("Cost", (_TOTAL_HI_LABELS, _TOTAL_COST, _MINUTES)),
)


# --- ratios of two series, per seed


@dataclass(frozen=True)
class _Ratio:
    name: str
    of: str  # the algorithm in the numerator
    to: str  # the algorithm in the denominator
    amount: Callable[[RunCurves, bool], float]
    published: Callable[[Published], float | None] = lambda _: None


_RATIOS = (
    _Ratio(
        "expert cost, hg-DAgger / flat DAgger",
        "hg-dagger",
        "flat-dagger",
        lambda run, labels_only: at_end(run, run.cost(labels_only)),
        lambda known: known.cost,
    ),
    _Ratio(
        "LO cost, naive h-DAgger / hg-DAgger",
        "naive-h-dagger",
        "hg-dagger",
        lambda run, _: at_end(run, run.lo_cost),
    ),
    _Ratio(
        "LO cost without demonstrations, naive h-DAgger / hg-DAgger",
        "naive-h-dagger",
        "hg-dagger",
        lambda run, _: at_end(run, run.lo_label_cost),
    ),
)


def ratios(comparison: Comparison) -> Iterator[Result]:
    """Yield the ratios of series of a group. Each ratio compares runs with the same seed, which saw the same mazes.

    Of several series of one algorithm, the first is compared: the others are variants. Totals of runs with different
    numbers of episodes are not compared.
    """
    group = comparison.group
    by_algorithm = {series.config.algorithm: series for series in reversed(list(comparison.runs))}  # the first of each
    for ratio in _RATIOS:
        if ratio.of not in by_algorithm or ratio.to not in by_algorithm:
            continue
        above, below = by_algorithm[ratio.of], by_algorithm[ratio.to]
        if len({run.config.episodes for series in (above, below) for run in comparison.runs[series]}) > 1:
            continue
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
    """Return the results of all tables, including ratios."""
    return [
        result
        for comparison in comparisons
        for found in (*(results(comparison, topic) for topic in topics(comparison)), ratios(comparison))
        for result in found
    ]
