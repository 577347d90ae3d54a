"""An episode that the expert is not asked about: its success is known well enough (`learner/monitoring.py`)."""

from collections.abc import Generator
from typing import Any

from waypost.trajectory import State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.datasets import Labels


def unasked(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode; nothing is learned from it."""
    learner.roll_out(s)
    yield from ()  # no questions
    return Labels()
