"""Defines the data of figures: a run's curves as arrays, and the runs of a group by series."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from waypost import wire
from waypost.wire import Kind
from waypost_learner.experiments.plan.series import Group, Series
from waypost_learner.runs.config import TrainConfig

Column = NDArray[np.float64]

KINDS: tuple[Kind, ...] = ("hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")
INSPECTIONS: tuple[Kind, ...] = ("inspect_full", "inspect_lo")
LO_LABELS: tuple[Kind, ...] = ("label_lo", "label_full")


@dataclass(frozen=True, eq=False)
class RunCurves:
    """The curves of one run. Every array is float64[n] with one row per episode; sums are cumulative.

    Args:
        config: the configuration of the run.
        episode: episode numbers, from 0.
        test_success: 1 passed, 0 failed, nan not tested.
        success_rate: success rate over the trailing 100 tests (fewer at the start), 0 to 1; nan before the first test.
        hi_labels: size of D_HI.
        lo_samples: LO-level steps in training rollouts.
        learner_seconds: the learner's wall time in seconds, rounded to a tenth.
        lo_cost: cost of LO labels in units, including those of demonstrations.
        units: cost in units, by kind of query.
        reward: mean reward of the trailing 100 training rollouts (fewer at the start); nan if it is not known.
        reached: by subgoal that a Q-function learns, how many of the trailing 100 attempts reached it, 0 to 1.
    """

    config: TrainConfig
    episode: Column
    test_success: Column
    success_rate: Column
    hi_labels: Column
    lo_samples: Column
    learner_seconds: Column
    lo_cost: Column
    units: Mapping[Kind, Column]
    reward: Column
    reached: Mapping[str, Column]

    @classmethod
    def of(cls, config: TrainConfig, curves: wire.Curves) -> "RunCurves":
        """Convert the curves of the server's API."""
        return cls(
            config=config,
            episode=_column(curves.episode),
            test_success=_column(curves.test_success),
            success_rate=_column(curves.success_rate),
            hi_labels=_column(curves.hi_labels),
            lo_samples=_column(curves.lo_samples),
            learner_seconds=_column([round(seconds, 1) for seconds in curves.learner_seconds]),
            lo_cost=_column(curves.lo_cost),
            units={kind: _column(curves.cost_by_kind[kind]) for kind in KINDS},
            reward=_column(curves.reward),
            reached={subgoal: _column(rates) for subgoal, rates in curves.reached.items()},
        )

    @property
    def episodes(self) -> Column:
        """The number of episodes at each row, from 1."""
        return self.episode + 1

    @property
    def complete(self) -> bool:
        """Whether every planned episode was reported."""
        return len(self.episode) >= self.config.episodes

    def cost(self, labels_only: bool) -> Column:
        """Return the cumulative expert cost in units; with `labels_only` (as the authors count) without inspections."""
        return self._sum(kind for kind in KINDS if not (labels_only and kind in INSPECTIONS))

    @property
    def lo_label_cost(self) -> Column:
        """The cumulative cost of LO labels in units, without those of demonstrations."""
        return self._sum(LO_LABELS)

    def _sum(self, kinds: Iterable[Kind]) -> Column:
        return sum((self.units[kind] for kind in kinds), np.zeros(len(self.episode)))


@dataclass(frozen=True)
class Comparison:
    """The series of a group that have runs; each with its runs, ordered by seed."""

    group: Group
    runs: Mapping[Series, Sequence[RunCurves]]

    @classmethod
    def of(cls, group: Group, seeds: Sequence[int], found: Mapping[TrainConfig, RunCurves]) -> "Comparison":
        """Select a group's runs from all `found` runs."""
        chosen = {each: [found[one] for one in each.runs(seeds) if one in found] for each in group.series}
        return cls(group, {series: runs for series, runs in chosen.items() if runs})


def _column(values: Sequence[float | bool | None]) -> Column:
    return np.array([np.nan if value is None else value for value in values], np.float64)
