"""What a gate sees of a segment: what the policies said in its states, not the states themselves.

The papers' gates see states. With the few dozen answers of a run, a network that sees pictures would learn nothing;
what the policies said is a small vector that means the same in every domain.
"""

from collections.abc import Callable
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from waypost.trajectory import Observation, Trajectory
from waypost_learner.rollout.policy_keys import META, PolicyKey, pi
from waypost_learner.rollout.rollout import Policies

Level = Literal["hi", "lo"]
Seen = dict[Level, NDArray[np.float32]]
"""For each level, float32[n, N_FEATURES] of the n segments of a rollout."""

N_FEATURES = 6
DISAGREEMENT = 5
"""The place of the largest disagreement among the features."""

_LEAST = -10.0  # the least logarithm of a probability


def seen_in(
    sigma: Trajectory, policies: Policies, disagreement: Callable[[PolicyKey, Observation], NDArray[np.float32]]
) -> Seen:
    """Return what a gate sees of each segment of a rollout.

    These are: the least and the mean log-probability of what was chosen, the largest entropy, beta_g's probability in
    the last state, the logarithm of the number of choices, and the largest disagreement.

    Args:
        sigma: the rollout; in each of its segments, somebody chose a subgoal.
        policies: mu and each pi_g.
        disagreement: how much the views of a state disagree about a policy's choices, float32[B] of B states.
    """
    seen: dict[Level, list[list[float]]] = {"hi": [], "lo": []}
    for segment in sigma:
        assert segment.subgoal is not None
        states = np.stack([state.observation for state in segment.states])
        for key, choices in ((META, (segment.subgoal,)), (pi(segment.subgoal), segment.actions)):
            outputs, n = policies[key](states), len(choices)
            logits = outputs.logits[:n] - outputs.logits[:n].max(1, keepdims=True)
            logs = np.maximum(logits - np.log(np.exp(logits).sum(1, keepdims=True)), _LEAST)
            chosen = logs[range(n), choices]
            entropy = -(np.exp(logs) * logs).sum(1)
            views = disagreement(key, states[:n])
            ending = float(outputs.termination[-1])
            found = [chosen.min(), chosen.mean(), entropy.max(), ending, np.log1p(n), views.max()]
            seen["hi" if key == META else "lo"].append(found)
    return {level: np.array(rows, np.float32).reshape(-1, N_FEATURES) for level, rows in seen.items()}
