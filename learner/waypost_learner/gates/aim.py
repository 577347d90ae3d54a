"""The gate of AIM, the Adaptive Intervention Mechanism (Cai et al., ICML 2025).

The paper: a proxy Q-function is +1 for the policy's action where the expert acted otherwise, and -1 for the expert's
action. Temporal differences without a reward spread it to states in which nobody was asked. The expert is called
where it is above a threshold: a quantile over recent states, so that fewer calls follow as the policy improves.

Here: the proxy is a function of what the policies said of a segment's choices. It is +1 for choices that the expert
found wrong and -1 for choices that it found right. The expert's own choice instead of a wrong one is not learned as a
second sample. The threshold follows the latest segments, so that the share that is asked about stays about the same.
"""

import torch

from waypost_learner.gates.gate import Gate
from waypost_learner.gates.value import Value


class Aim(Gate):
    """Doubts what is like choices that were wrong, or leads to them."""

    wrong, right, right_at_last = 1.0, -1.0, -1.0
    discount = 0.95

    def measures(self, features: torch.Tensor, value: Value) -> torch.Tensor:
        """Return the proxy Q-function."""
        return value(features).unsqueeze(0)
