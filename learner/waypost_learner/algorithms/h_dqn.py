"""h-DQN (Kulkarni et al. 2016), a baseline of Le et al. 2018 (appendix): Q-learning on both levels, no expert.

It is "similarly enhanced" with double Q-learning and prioritized replay. The domain gives the subgoals' terminations.
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.policy_keys import META, pi
from waypost_learner.rollout.simulator import Start


def h_dqn(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode, and learn from all of its transitions."""
    labels = Labels()
    sigma = learner.roll_out(s)
    for segment in sigma:
        assert segment.subgoal is not None
        labels.append_experience(pi(segment.subgoal), (segment,))
    labels.append_experience(META, sigma)
    yield from ()  # no queries
    return labels
