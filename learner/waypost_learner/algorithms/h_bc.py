"""Hierarchical behavioral cloning, h-BC (Le et al. 2018, Algorithm 1)."""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def h_bc(s: Start, _: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode, lines 3-7, from the start state s. `Learner.learn` does Train (lines 8-9)."""
    labels = Labels()
    sigma_star = yield HierDemo(s.state)  # line 4
    labels.append_demonstration(sigma_star)  # lines 5-7
    return labels
