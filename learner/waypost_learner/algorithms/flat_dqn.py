"""Flat double Q-learning, which fails "due to a long planning horizon and sparse rewards" (Le et al. 2018, 6.1)."""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.policy_keys import FLAT
from waypost_learner.rollout.simulator import Start


def flat_dqn(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode, and learn from all of its transitions."""
    labels = Labels()
    labels.append_experience(FLAT, learner.roll_out(s))
    yield from ()  # no queries
    return labels
