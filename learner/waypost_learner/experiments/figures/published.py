"""Contains the published numbers of the maze experiments.

They are medians of five runs on corner mazes. We read them from the plots of Le et al. 2018 (figure "Maze navigation:
hierarchical versus flat imitation learning") and of the authors' own experiments, with an accuracy of about one
percentage point and 500 units. Their costs include only labels. Their episodes exclude training rollouts that
succeeded at once.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from waypost_learner.experiments.plan import Group, Series

NEVER = float("inf")
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
    """Return the published numbers of a series; empty ones if its group counts differently from the authors."""
    algorithm = series.config.algorithm
    if group.labels_only:
        return _IMITATION.get(algorithm, Published())
    if group.hybrid and algorithm == "h-dqn":
        return _H_DQN if series.config.head_start is None else _H_DQN_WITH_HEAD_START
    return Published()
