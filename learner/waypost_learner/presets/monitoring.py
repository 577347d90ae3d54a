"""Decides which episodes the expert inspects: every episode, as in Algorithm 2, or a sample.

Sampling changes neither the queries within an inspected episode nor their prices. docs/lean.md says how it changes the
bound of Theorem 1.
"""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Monitoring:
    """Sampled monitoring: Dodge's continuous sampling plan CSP-1 (1943). A confidence sets its clearance number.

    Every episode is inspected until `clearance` inspections in a row have passed. Then a random share of the episodes
    is inspected, until one fails. The confidence holds for one streak under one policy; a run has several streaks.
    """

    share: float = 1.0  # of episodes that are inspected after a streak; 1 inspects every episode, as in Algorithm 2
    rate: float = 0.9  # the success rate that a streak shows
    confidence: float = 0.95  # with which a streak shows it

    def __post_init__(self) -> None:
        """Refuse numbers out of their range.

        Raises:
            ValueError: the share is not from 0 to 1, or the rate or confidence is not between 0 and 1.
        """
        if not 0 <= self.share <= 1 or not 0 < self.rate < 1 or not 0 < self.confidence < 1:
            raise ValueError("monitoring needs a share from 0 to 1, and a rate and a confidence between 0 and 1")

    @property
    def clearance(self) -> int:
        """The length of a streak that shows the rate.

        A policy with a lower rate has such a streak with a probability of at most 1 - confidence.
        """
        return math.ceil(math.log(1 - self.confidence) / math.log(self.rate))

    def inspects(self, passes: int, rng: np.random.Generator) -> bool:
        """Return whether to inspect an episode that follows this many passes in a row."""
        return passes < self.clearance or rng.random() < self.share


EVERY_EPISODE = Monitoring()
"""Algorithm 2: every episode is inspected."""
