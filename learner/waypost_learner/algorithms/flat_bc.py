"""Flat behavioral cloning (Le et al. 2018, section 6.1): Algorithm 1 without the hierarchy."""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def flat_bc(s: Start, _: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode: the expert demonstrates, and each of its actions is a label."""
    labels = Labels()
    (tau_star,) = yield HierDemo(s.state, flat=True)
    labels.append_flat((tau_star,), tau_star.actions)
    return labels
