"""Flat double Q-learning, which fails "due to a long planning horizon and sparse rewards" (Le et al. 2018, 6.1)."""

from collections.abc import Generator
from typing import Any

from learner import experience
from learner.datasets import Labels
from learner.learner import Learner
from learner.queries import Query
from learner.types import FLAT, State


def flat_dqn(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode; all of it becomes experience."""
    labels = Labels()
    (tau,) = learner.roll_out(s)
    labels.append_experience(FLAT, experience.of_actions(tau))
    yield from ()  # no questions
    return labels
