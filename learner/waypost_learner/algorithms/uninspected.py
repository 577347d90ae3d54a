"""An episode without queries, which sampled monitoring runs when the expert does not inspect the episode."""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def uninspected(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Roll out one episode and return no labels."""
    learner.roll_out(s)
    yield from ()  # no queries
    return Labels()
