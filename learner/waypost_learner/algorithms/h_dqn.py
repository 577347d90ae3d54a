"""h-DQN (Kulkarni et al. 2016), a baseline of Le et al. 2018 (appendix): Q-learning on both levels, no expert.

"Similarly enhanced": with double Q-learning and prioritized replay. The subgoals' terminations are given.
"""

from collections.abc import Generator
from typing import Any

from waypost.trajectory import State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import Query
from waypost_learner.policies.datasets import Labels
from waypost_learner.rollout import experience
from waypost_learner.rollout.policy_keys import META


def h_dqn(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode; all of it becomes experience."""
    labels = Labels()
    dqn = learner.preset.dqn
    sigma = learner.roll_out(s)
    for segment in sigma:
        assert segment.subgoal is not None
        labels.append_experience(segment.subgoal, experience.of_subgoal(segment, dqn.pseudo))
    labels.append_experience(META, experience.of_subgoals(sigma, dqn.discount))
    yield from ()  # no questions
    return labels
