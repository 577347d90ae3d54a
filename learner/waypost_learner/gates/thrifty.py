"""The gate of ThriftyDAgger (Hoque et al. 2021, arXiv 2109.08273).

The paper: the expert is called where a state is novel or risky. Novelty is the variance of an ensemble's actions. Risk
is one minus a Q-function of the policy's success, learned by temporal differences from rollouts whose success is known.
Both thresholds are quantiles over the states so far.

Here: novelty is the variance of the probabilities that one network gives under the symmetric views whose average acts;
an ensemble would multiply the cost of training. Nobody tells whether an uninspected rollout succeeded, so the
Q-function knows only what was bought: a choice that the expert found wrong is a failure, a last choice that it found
right is a success, and other choices learn from the next ones of the same rollout. Each of the two measures gets half
of the share.
"""

import math

import torch

from waypost_learner.gates.gate import Gate
from waypost_learner.gates.value import Value
from waypost_learner.gates.views import DISAGREEMENT


class Thrifty(Gate):
    """Doubts what is novel, and what is risky."""

    wrong, right, right_at_last = 0.0, math.nan, 1.0
    discount = 0.95

    def measures(self, features: torch.Tensor, value: Value) -> torch.Tensor:
        """Return the novelty and the risk."""
        return torch.stack([features[:, DISAGREEMENT], 1 - value(features)])
