"""Hierarchically guided DAgger / Q-learning, hg-DAgger/Q (Le et al. 2018, Algorithm 3)."""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, LabelHi, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.policy_keys import pi
from waypost_learner.rollout.simulator import Start


def hg_dagger_q(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode, lines 5-22. `Learner.learn` does Train (line 23)."""
    labels = Labels()
    sigma = learner.roll_out(s)  # lines 5-15
    good = sigma
    if not (yield InspectFull(sigma)):  # line 17
        d_star = yield LabelHi(sigma)  # line 18
        agrees = [segment.subgoal == g_star for segment, g_star in zip(sigma, d_star, strict=True)]
        good = sigma[: [*agrees, False].index(False)]  # line 19
        labels.append_hi(sigma, d_star)  # line 21
    for segment in good:  # lines 20 and 22
        assert segment.subgoal is not None
        labels.append_experience(pi(segment.subgoal), (segment,))
    return labels
