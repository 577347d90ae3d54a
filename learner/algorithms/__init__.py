"""The paper's algorithms, by the name the command line uses."""

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any

from learner.algorithms.h_bc import h_bc
from learner.algorithms.hg_dagger import hg_dagger
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


ALGORITHMS = {
    "h-bc": Algorithm(warm_start=h_bc, episode=h_bc),
    "hg-dagger": Algorithm(warm_start=h_bc, episode=hg_dagger),
}


def find_algorithm(name: str) -> Algorithm:
    """Return an algorithm.

    Raises:
        ValueError: there is none of that name; the message lists those that exist.
    """
    if name not in ALGORITHMS:
        raise ValueError(f"there is no algorithm {name!r}; those that exist are: {', '.join(sorted(ALGORITHMS))}")
    return ALGORITHMS[name]
