"""An episode that the expert is not asked about: its success is known well enough (`learner/monitoring.py`)."""

from collections.abc import Generator
from typing import Any

from learner.datasets import Labels
from learner.learner import Learner
from learner.queries import Query
from learner.types import State


def unasked(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode; nothing is learned from it."""
    learner.roll_out(s)
    yield from ()  # no questions
    return Labels()
