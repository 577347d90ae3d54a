"""Hierarchical behavioral cloning, h-BC (Le et al. 2018, Algorithm 1)."""

from collections.abc import Generator
from typing import Any

from waypost.trajectory import State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo, Query
from waypost_learner.policies.datasets import Labels


def h_bc(s: State, learner: Learner) -> Generator[Query, Any, Labels]:  # noqa: ARG001 (algorithms share a signature)
    """Run one episode, lines 3-7, from the start state s; Train (lines 8-9) follows in `Learner.learn`."""
    labels = Labels()
    sigma_star = yield HierDemo(s)  # line 4
    labels.append_demonstration(sigma_star)  # lines 5-7
    return labels
