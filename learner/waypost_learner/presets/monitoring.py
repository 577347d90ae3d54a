"""Which episodes the expert is asked about: each, as Algorithm 2 has it, or those of a sampling plan.

It changes neither what is asked within an episode nor what that costs. What it does to Theorem 1: docs/lean.md.
"""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Monitoring:
    """Sampled monitoring: Dodge's continuous sampling plan CSP-1 (1943), with its clearance number from a confidence.

    Every episode is inspected until so many passed in a row that success counts as known; then a share of them, drawn
    at random, until one fails. The confidence is of one such row under one policy, not of a whole run.
    """

    share: float = 1.0  # of the episodes, once success is known; 1: every one, as Algorithm 2 has it
    rate: float = 0.9  # the success rate that is then known,
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
