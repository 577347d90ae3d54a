"""The paper's algorithms, by the name the command line uses."""

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any

from waypost.trajectory import State
from waypost_learner.algorithms.flat_bc import flat_bc
from waypost_learner.algorithms.flat_dagger import flat_dagger
from waypost_learner.algorithms.flat_dqn import flat_dqn
from waypost_learner.algorithms.h_bc import h_bc
from waypost_learner.algorithms.h_dqn import h_dqn
from waypost_learner.algorithms.hg_dagger import hg_dagger
from waypost_learner.algorithms.hg_dagger_q import hg_dagger_q
from waypost_learner.algorithms.hg_stagger import hg_stagger
from waypost_learner.algorithms.learner import HIERARCHY, Learner, Structure
from waypost_learner.algorithms.naive_h_dagger import naive_h_dagger
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.datasets import Labels

Episode = Callable[[State, Learner], Generator[Query, Any, Labels]]


@dataclass(frozen=True)
class Algorithm:
    """What an episode is, and what a learner consists of."""

    episode: Episode
    warm_start: Episode | None = None  # what the first episodes are instead
    structure: Structure = HIERARCHY
    monitored: bool = False  # whether it asks Inspect_FULL first, and learns nothing of an episode that passed

    @property
    def interactive(self) -> bool:
        """Whether it imitates an expert along rollouts of its own, after demonstrations."""
        return self.warm_start is not None


_FLAT = Structure(flat=True)

ALGORITHMS = {
    "h-bc": Algorithm(h_bc),
    "hg-dagger": Algorithm(hg_dagger, warm_start=h_bc, monitored=True),
    "hg-stagger": Algorithm(hg_stagger, warm_start=h_bc, monitored=True),
    "naive-h-dagger": Algorithm(naive_h_dagger, warm_start=h_bc),
    "flat-bc": Algorithm(flat_bc, structure=_FLAT),
    "flat-dagger": Algorithm(flat_dagger, warm_start=flat_bc, structure=_FLAT, monitored=True),
    "hg-dagger-q": Algorithm(hg_dagger_q, structure=Structure(q_lo=True)),
    "h-dqn": Algorithm(h_dqn, structure=Structure(q_hi=True, q_lo=True)),
    "flat-dqn": Algorithm(flat_dqn, structure=Structure(flat=True, q_lo=True)),
}


def find_algorithm(name: str) -> Algorithm:
    """Return an algorithm.

    Raises:
        ValueError: there is none of that name; the message lists those that exist.
    """
    if name not in ALGORITHMS:
        raise ValueError(f"there is no algorithm {name!r}; those that exist are: {', '.join(sorted(ALGORITHMS))}")
    return ALGORITHMS[name]
