"""An episode without queries, which sampled monitoring runs when the expert does not inspect the episode."""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.policy_keys import pi
from waypost_learner.rollout.simulator import Start


def uninspected(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Roll out one episode. Q-functions learn from all of it, as if every subgoal were right; nothing else learns."""
    labels = Labels()
    for segment in learner.roll_out(s):
        if learner.levels.q_lo and segment.subgoal is not None:
            labels.append_experience(pi(segment.subgoal), (segment,))
    yield from ()  # no queries
    return labels
