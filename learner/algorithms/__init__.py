"""The paper's algorithms, by the name the command line uses."""

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any

from learner.algorithms.flat_bc import flat_bc
from learner.algorithms.flat_dagger import flat_dagger
from learner.algorithms.h_bc import h_bc
from learner.algorithms.hg_dagger import hg_dagger
from learner.algorithms.naive_h_dagger import naive_h_dagger
from learner.datasets import Labels
from learner.learner import Learner
from learner.queries import Query
from learner.types import State

Episode = Callable[[State, Learner], Generator[Query, Any, Labels]]


@dataclass(frozen=True)
class Algorithm:
    """What an episode is, during the warm start and after it."""

    warm_start: Episode
    episode: Episode
    flat: bool = False  # whether the learner has one flat policy

    @property
    def interactive(self) -> bool:
        """Whether the learner rolls its policies out after the warm start."""
        return self.episode is not self.warm_start


ALGORITHMS = {
    "h-bc": Algorithm(warm_start=h_bc, episode=h_bc),
    "hg-dagger": Algorithm(warm_start=h_bc, episode=hg_dagger),
    "naive-h-dagger": Algorithm(warm_start=h_bc, episode=naive_h_dagger),
    "flat-bc": Algorithm(warm_start=flat_bc, episode=flat_bc, flat=True),
    "flat-dagger": Algorithm(warm_start=flat_bc, episode=flat_dagger, flat=True),
}


def find_algorithm(name: str) -> Algorithm:
    """Return an algorithm.

    Raises:
        ValueError: there is none of that name; the message lists those that exist.
    """
    if name not in ALGORITHMS:
        raise ValueError(f"there is no algorithm {name!r}; those that exist are: {', '.join(sorted(ALGORITHMS))}")
    return ALGORITHMS[name]
