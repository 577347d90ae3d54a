"""Which episodes the expert is asked about: all of them, as Algorithm 2 has it, or fewer, by these options.

Neither changes what is asked within an episode, nor what it costs. What each does to Theorem 1: docs/lean.md.
"""

import math
from dataclasses import dataclass

import numpy as np
import torch

from learner.rollout import Policies
from learner.types import FLAT, META, Trajectory


@dataclass(frozen=True)
class Monitoring:
    """Sampled monitoring: Dodge's continuous sampling plan CSP-1 (1943), with its clearance number from a confidence.

    Every episode is inspected until so many passed in a row that success is known; then a share of them, drawn at
    random, until one fails.
    """

    share: float = 1.0  # of the episodes, once success is known; 1: every one, as Algorithm 2 has it
    rate: float = 0.95  # the success rate that is then known,
    confidence: float = 0.95  # with this confidence

    def __post_init__(self) -> None:
        """Refuse what is no share, or a rate that no number of passes could show.

        Raises:
            ValueError: with what to write instead.
        """
        if not 0 <= self.share <= 1 or not 0 < self.rate < 1 or not 0 < self.confidence < 1:
            raise ValueError("monitoring takes a share from 0 to 1, a rate and a confidence between 0 and 1")

    @property
    def clearance(self) -> int:
        """So many passes in a row show the rate: a policy below it has them with at most 1 - confidence."""
        return math.ceil(math.log(1 - self.confidence) / math.log(self.rate))

    def inspects(self, passes: int, rng: np.random.Generator) -> bool:
        """Return whether to inspect an episode after so many passes in a row."""
        return passes < self.clearance or rng.random() < self.share


EVERY_EPISODE = Monitoring()
"""Algorithm 2's: each is inspected."""


def doubt(policies: Policies, sigma: Trajectory) -> float:
    """Return how much mu, or a flat policy, doubted along a rollout: the entropies of its choices in nats, summed."""
    key, states = META, [segment.start for segment in sigma]
    if FLAT in policies:
        key, states = FLAT, [state for segment in sigma for state in segment.states[:-1]]
    logits = policies[key](np.stack([state.observation for state in states])).logits
    log_p = torch.log_softmax(torch.from_numpy(logits), dim=1)
    return float(-(log_p.exp() * log_p).sum())
