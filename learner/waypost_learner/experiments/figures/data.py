"""A run's curves as arrays, and the runs of a group."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from waypost import wire
from waypost.wire import Kind
from waypost_learner.experiments.plan import Group, Series
from waypost_learner.runs.config import TrainConfig

Column = NDArray[np.float64]

KINDS: tuple[Kind, ...] = ("hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")
INSPECTIONS: tuple[Kind, ...] = ("inspect_full", "inspect_lo")
LO_LABELS: tuple[Kind, ...] = ("label_lo", "label_full")


@dataclass(frozen=True, eq=False)
class RunCurves:
    """One run, a row per episode; every array is float64[n], and sums are cumulative.

    Args:
        config: what fixes the run.
        episode: numbers, from 0.
        test_success: 1 passed, 0 failed, nan not tested.
        success_rate: over the trailing 100 tests, or over those there are; nan before the first.
        hi_labels: the size of D_HI.
        lo_samples: LO-level steps taken in training rollouts.
        learner_seconds: the learner's wall time, to a tenth.
        lo_cost: units spent on LO labels, those of demonstrations included.
        units: units spent by kind of query.
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

    @classmethod
    def of(cls, config: TrainConfig, curves: wire.Curves) -> "RunCurves":
        """Return the curves of a run as a server gives them."""
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
        )

    @property
    def episodes(self) -> Column:
        """How many episodes there were, at each row."""
        return self.episode + 1

    @property
    def complete(self) -> bool:
        """Whether every planned episode was reported."""
        return len(self.episode) >= self.config.episodes

    def cost(self, labels_only: bool) -> Column:
        """Return the units spent; of labels alone, as the authors count, or of inspections too."""
        return self._sum(kind for kind in KINDS if not (labels_only and kind in INSPECTIONS))

    @property
    def lo_label_cost(self) -> Column:
        """The units spent on LO labels without those of demonstrations."""
        return self._sum(LO_LABELS)

    def _sum(self, kinds: Iterable[Kind]) -> Column:
        return sum((self.units[kind] for kind in kinds), np.zeros(len(self.episode)))


@dataclass(frozen=True)
class Comparison:
    """The series of a group that have runs, each with its runs in the order of seeds."""

    group: Group
    runs: Mapping[Series, Sequence[RunCurves]]

    @classmethod
    def of(cls, group: Group, seeds: Sequence[int], found: Mapping[TrainConfig, RunCurves]) -> "Comparison":
        """Choose a group's runs among those that were found."""
        chosen = {each: [found[one] for one in each.runs(seeds) if one in found] for each in group.series}
        return cls(group, {series: runs for series, runs in chosen.items() if runs})


def _column(values: Sequence[float | bool | None]) -> Column:
    return np.array([np.nan if value is None else value for value in values], np.float64)
