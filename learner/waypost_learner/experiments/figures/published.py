"""The published numbers of the maze experiments, as data.

Read off the plots of Le et al. 2018 (figure "Maze navigation: hierarchical versus flat imitation learning") and of the
authors' own experiments: medians of five runs on corner mazes, to about one percentage point and 500 units. Their
costs are labels alone, and their episodes leave out training rollouts that succeeded at once.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from waypost_learner.experiments.plan import Group, Series

NEVER = float("inf")
EPISODES = (270, 500, 600, 1_000)  # after which success is compared
LEVELS = (0.8, 0.95)  # of success, whose cost is compared


@dataclass(frozen=True)
class Published:
    """What was published of one algorithm.

    Args:
        success: the success rate after a number of episodes.
        cost: units after 1,000 episodes.
        cost_at: units when a success rate was first reached.
        lo_only: whether every one of its labels is a LO-level one, so that its LO cost is its cost.
        final: the success rate it ended with, where no more than that is known.
    """

    success: Mapping[int, float] = field(default_factory=dict)
    cost: float | None = None
    cost_at: Mapping[float, float] = field(default_factory=dict)
    lo_only: bool = False
    final: float | None = None


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


def published(group: Group, series: Series) -> Published:
    """Return what was published of a series; nothing where its group counts otherwise than the authors."""
    algorithm = series.config.algorithm
    if group.labels_only:
        return _IMITATION.get(algorithm, Published())
    if group.hybrid and algorithm == "h-dqn":
        return _H_DQN if series.config.head_start is None else _H_DQN_WITH_HEAD_START
    return Published()
