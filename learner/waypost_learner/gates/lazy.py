"""The gate of LazyDAgger (Hoque et al. 2021, arXiv 2104.00053).

The paper: a classifier tells in which states the expert would act otherwise than the policy. The expert takes over
where it says so, and gives back control when the policy's action differs by less than a tenth of the first threshold
from the expert's. This hysteresis makes changes of control rare.

Here: the classifier sees what the policies said of a segment, and learns from the answers about segments that were
asked about (Label_HI, Inspect_LO) by least squares. The papers' threshold is on a distance between actions; here it is
a quantile of the classifier's probability, so that gates can be compared at the same share. The expert does not act, so
nothing tells how far it was from the policy where it agreed: questions go on over the following segments until the
probability is below a tenth of the threshold. In the paper, actions are executed by the expert meanwhile.
"""

import numpy as np
import torch
from numpy.typing import NDArray

from waypost_learner.gates.gate import Gate
from waypost_learner.gates.value import Value

_RELEASE = 0.1  # of the threshold, below which doubts end


class Lazy(Gate):
    """Doubts from where the expert would probably disagree, to where it would almost surely agree."""

    wrong, right, right_at_last = 1.0, 0.0, 0.0

    def measures(self, features: torch.Tensor, value: Value) -> torch.Tensor:
        """Return the probability that the expert disagrees."""
        return value(features).unsqueeze(0)

    def above(self, measures: NDArray[np.float32], thresholds: NDArray[np.float32]) -> list[bool]:
        """Return where doubts have begun and not ended yet."""
        doubted, doubting = list[bool](), False
        for probability in measures[0]:
            doubting = bool(probability > thresholds[0] * (_RELEASE if doubting else 1))
            doubted.append(doubting)
        return doubted
