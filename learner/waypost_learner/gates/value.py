"""A small network that learns a value of segments from answers, and, if it is told to, by temporal differences."""

import torch
from torch import nn

_HIDDEN = 16
_UPDATES = 200
_LEARNING_RATE = 0.02
_FARTHEST = 3.0  # standard deviations: what is farther away than all that was seen is seen as that far


class Value:
    """A function of features, fitted once.

    A segment whose value an answer gave learns this value. If there is a discount, any other segment learns the value
    of the segment after it in its rollout, discounted; the last one of a rollout then teaches nothing.

    Args:
        features: float32[n, F], of segments in the order in which they were rolled out.
        known: float32[n], the values that answers gave; NaN where there is none.
        last: bool[n], whether a segment is the last one of its rollout.
        ends: of the range of the values.
        discount: of the next segment's value; None if only values that answers gave are learned.
        seed: fixes the initial weights.
    """

    def __init__(
        self,
        features: torch.Tensor,
        known: torch.Tensor,
        last: torch.Tensor,
        ends: tuple[float, float],
        discount: float | None,
        seed: int,
    ) -> None:
        self._mean, self._scale = features.mean(0), features.std(0, correction=0) + 1e-3
        self._low, self._high = min(ends), max(ends)
        rng = torch.Generator().manual_seed(seed)
        self._network = nn.Sequential(nn.Linear(features.shape[1], _HIDDEN), nn.Tanh(), nn.Linear(_HIDDEN, 1))
        for parameter in self._network.parameters():
            nn.init.normal_(parameter, std=0.3, generator=rng)
        given = ~known.isnan()
        follows = torch.zeros_like(given) if discount is None else ~given & ~last
        follows[-1] = False
        taught = (given | follows).nonzero().squeeze(1)
        if not len(taught):
            return
        optimizer = torch.optim.Adam(self._network.parameters(), lr=_LEARNING_RATE)
        for _ in range(_UPDATES):
            values = self._of(features)
            later = (discount or 0.0) * values.detach().roll(-1)
            target = torch.where(given, known, later)
            loss = (values - target)[taught].square().mean()
            optimizer.zero_grad()
            torch.autograd.backward(loss)
            optimizer.step()

    @torch.no_grad()
    def __call__(self, features: torch.Tensor) -> torch.Tensor:
        """Return the values float32[n] of segments with these features float32[n, F]."""
        return self._of(features)

    def _of(self, features: torch.Tensor) -> torch.Tensor:
        out: torch.Tensor = self._network(((features - self._mean) / self._scale).clamp(-_FARTHEST, _FARTHEST))
        return self._low + (self._high - self._low) * torch.sigmoid(out.squeeze(1))
