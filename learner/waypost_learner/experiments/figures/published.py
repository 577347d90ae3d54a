"""Contains the published numbers of the experiments.

Those of Montezuma's Revenge are in `montezuma_authors.csv`: about 60 rows of the log of each of the authors' five runs.
A run ended when it had reached the door in 91 of the last 100 attempts.

Those of the maze are medians of five runs on corner mazes. We read them from the plots of Le et al. 2018 (figure "Maze
navigation: hierarchical versus flat imitation learning") and of the authors' own experiments, with an accuracy of about
one percentage point and 500 units. Their costs include only labels. Their episodes exclude training rollouts that
succeeded at once.
"""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import groupby
from pathlib import Path

import numpy as np

from waypost_learner.experiments.figures.data import Column
from waypost_learner.experiments.plan.series import Group, Series

NEVER = float("inf")
SUBGOALS = ("stair", "key", "stair_back", "door")  # of Montezuma's Revenge
MASTERED = 0.9  # a subgoal is learned when more than this share of the trailing 100 attempts reached it
EPISODES = (270, 500, 600, 1_000)  # success is compared after these episodes
LEVELS = (0.8, 0.95)  # the cost to reach these success rates is compared


@dataclass(frozen=True)
class Published:
    """The published numbers of one algorithm; empty if there are none.

    Args:
        success: success rate (0 to 1) by number of episodes.
        cost: expert cost after 1,000 episodes, in units.
        cost_at: expert cost in units when a success rate was first reached; infinite if it never was.
        lo_only: whether all its labels are LO-level labels. Then its LO-level cost equals its cost.
        final: the success rate at the end, 0 to 1.
        samples: by subgoal, the LO samples when it was learned.
        hi_labels: the number of HI labels at the end.
    """

    success: Mapping[int, float] = field(default_factory=dict)
    cost: float | None = None
    cost_at: Mapping[float, float] = field(default_factory=dict)
    lo_only: bool = False
    final: float | None = None
    samples: Mapping[str, float] = field(default_factory=dict)
    hi_labels: float | None = None


def _curve(success: tuple[float, ...], cost: float, at: tuple[float, float], lo_only: bool = False) -> Published:
    by_episode = dict(zip(EPISODES, success, strict=True))
    return Published(by_episode, cost, dict(zip(LEVELS, at, strict=True)), lo_only, success[-1])


_IMITATION = {
    "hg-dagger": _curve((0.50, 0.81, 0.95, 0.975), 21_000, (14_500, 17_000)),
    "h-bc": _curve((0.42, 0.76, 0.78, 0.87), 64_000, (36_000, NEVER)),
    "flat-dagger": _curve((0.41, 0.67, 0.72, 0.80), 60_000, (51_000, NEVER), lo_only=True),
    "flat-bc": _curve((0.32, 0.55, 0.56, 0.69), 44_000, (NEVER, NEVER), lo_only=True),
}

_H_DQN_WITH_HEAD_START = Published(final=0.30)  # "flattens out at 30% success rate" (appendix)
_H_DQN = Published(final=0.0)  # "we were not able to achieve non-zero rewards" (appendix)


@dataclass(frozen=True, eq=False)
class AuthorLog:
    """One of the authors' runs of hg-DAgger/Q on Montezuma's Revenge. Arrays are float64[rows].

    Args:
        lo_samples: the learner's own steps.
        reached: by subgoal, how many of the trailing 100 attempts reached it, 0 to 1.
        hi_labels: the number of HI labels at the end.
    """

    lo_samples: Column
    reached: Mapping[str, Column]
    hi_labels: float

    def samples(self, subgoal: str) -> float:
        """Return the LO samples when the subgoal was learned."""
        return float(self.lo_samples[np.argmax(self.reached[subgoal] > MASTERED)])


@cache
def author_logs() -> Sequence[AuthorLog]:
    """Return the authors' five runs on Montezuma's Revenge."""
    with (Path(__file__).parent / "montezuma_authors.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return [_log(list(of)) for _, of in groupby(rows, lambda row: row["run"])]


def _log(rows: Sequence[Mapping[str, str]]) -> AuthorLog:
    def column(name: str) -> Column:
        return np.array([float(row[name]) for row in rows])

    reached = {subgoal: column(subgoal) for subgoal in SUBGOALS}
    return AuthorLog(column("lo_samples"), reached, float(rows[-1]["hi_labels"]))


@cache
def _montezuma() -> Published:
    """Return the medians of the authors' logs."""
    logs = author_logs()
    samples = {subgoal: float(np.median([log.samples(subgoal) for log in logs])) for subgoal in SUBGOALS}
    return Published(samples=samples, hi_labels=float(np.median([log.hi_labels for log in logs])))


def published(group: Group, series: Series) -> Published:
    """Return the published numbers of a series; empty ones if its group counts differently from the authors.

    Of several variants of an algorithm, the first has the numbers.
    """
    algorithm, head_start = series.config.algorithm, series.config.head_start
    variants = [one for one in group.series if (one.config.algorithm, one.config.head_start) == (algorithm, head_start)]
    if series not in variants[:1]:
        return Published()
    if series.config.domain == "montezuma":
        return _montezuma() if algorithm == "hg-dagger-q" else Published()
    if group.labels_only:
        return _IMITATION.get(algorithm, Published())
    if group.hybrid and algorithm == "h-dqn":
        return _H_DQN if head_start is None else _H_DQN_WITH_HEAD_START
    return Published()
