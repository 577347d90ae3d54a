"""The paper's algorithms by name, and what a learner needs to run each of them."""

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any

from waypost_learner.algorithms.flat_bc import flat_bc
from waypost_learner.algorithms.flat_dagger import flat_dagger
from waypost_learner.algorithms.flat_dqn import flat_dqn
from waypost_learner.algorithms.h_bc import h_bc
from waypost_learner.algorithms.h_dqn import h_dqn
from waypost_learner.algorithms.hg_dagger import hg_dagger
from waypost_learner.algorithms.hg_dagger_by_place import hg_dagger_by_place
from waypost_learner.algorithms.hg_dagger_q import hg_dagger_q
from waypost_learner.algorithms.hg_gated import hg_gated
from waypost_learner.algorithms.hg_stagger import hg_stagger
from waypost_learner.algorithms.hg_takeover import hg_takeover
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.naive_h_dagger import naive_h_dagger
from waypost_learner.algorithms.plain_dagger import plain_dagger
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.labels import Labels
from waypost_learner.policies.levels import HIERARCHY, Levels
from waypost_learner.presets.base import Preset
from waypost_learner.rollout.simulator import Start

Episode = Callable[[Start, Learner], Generator[Query, Any, Labels]]
"""One episode of an algorithm: yields queries, receives their answers, and returns the episode's labels."""


@dataclass(frozen=True)
class Algorithm:
    """One algorithm: the functions that run its episodes, and the policies of its learner."""

    episode: Episode
    warm_start: Episode | None = None  # replaces `episode` in the first episodes; no warm start if None
    levels: Levels = HIERARCHY
    monitored: bool = False  # whether episodes begin with Inspect_FULL, so that monitoring may skip them
    by_place: bool = False  # whether what is asked depends on the places that the domain declares
    gated: bool = False  # whether a gate decides what is asked
    takes_over: bool = False  # whether the expert plays on from states of the learner

    @property
    def interactive(self) -> bool:
        """Whether the expert labels the learner's own rollouts after a warm start of demonstrations."""
        return self.warm_start is not None

    def warm_episodes(self, preset: Preset) -> int:
        """Return the number of episodes in the warm start."""
        if self.warm_start is None:
            return 0
        return preset.warm_start_hybrid if self.levels.q_lo else preset.warm_start


_FLAT = Levels(flat=True)

ALGORITHMS = {
    "h-bc": Algorithm(h_bc),
    "hg-dagger": Algorithm(hg_dagger, warm_start=h_bc, monitored=True),
    "hg-dagger-by-place": Algorithm(hg_dagger_by_place, warm_start=h_bc, monitored=True, by_place=True),
    "hg-gated": Algorithm(hg_gated, warm_start=h_bc, gated=True),
    "hg-stagger": Algorithm(hg_stagger, warm_start=h_bc, monitored=True),
    "hg-takeover": Algorithm(hg_takeover, warm_start=h_bc, monitored=True, takes_over=True),
    "naive-h-dagger": Algorithm(naive_h_dagger, warm_start=h_bc),
    "flat-bc": Algorithm(flat_bc, levels=_FLAT),
    "flat-dagger": Algorithm(flat_dagger, warm_start=flat_bc, levels=_FLAT, monitored=True),
    "plain-dagger": Algorithm(plain_dagger, warm_start=flat_bc, levels=_FLAT),
    "hg-dagger-q": Algorithm(hg_dagger_q, warm_start=h_bc, levels=Levels(q_lo=True), monitored=True),
    "h-dqn": Algorithm(h_dqn, levels=Levels(q_hi=True, q_lo=True)),
    "flat-dqn": Algorithm(flat_dqn, levels=Levels(flat=True, q_lo=True)),
}


def find_algorithm(name: str) -> Algorithm:
    """Return the algorithm called `name`.

    Raises:
        ValueError: no algorithm has this name; the message lists the names.
    """
    if name not in ALGORITHMS:
        raise ValueError(f"there is no algorithm {name!r}; the algorithms are: {', '.join(sorted(ALGORITHMS))}")
    return ALGORITHMS[name]
