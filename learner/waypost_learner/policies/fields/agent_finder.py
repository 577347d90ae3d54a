"""Find the agent in a picture without being told where it is, from pairs of pictures and the action between them."""

from collections.abc import Sequence

import torch
from torch import nn
from torch.nn import functional

from waypost_learner.policies.device import draw_weights

_FEATURES = 16
_UPDATES, _BATCH, _LEARNING_RATE = 200, 64, 3e-2
# The weight of the attention's entropy at the end: attention to a whole trail would tell the action too. At the start
# it is 0, or else the attention soon stays at a pixel that never moves.
_PEAKED = 0.1
_TRIES = 20  # from other initial weights, if ...
_ENOUGH = 0.98  # ... the pixel with the most attention tells less than this share of the actions
_RARE = 0.1  # moves to a pixel that are rarer are taken for mistakes of the attention
_ALL = 0.999  # with this share, nothing is fitted again

Transitions = tuple[torch.Tensor, torch.Tensor, torch.Tensor]
"""Pictures float32[N, C, rows, columns], the actions taken in them int64[N], the pictures after them."""


class AgentFinder(nn.Module):
    """Attention to one pixel, fitted by inverse dynamics: the attended pixel's displacement tells the action.

    Args:
        channels: of the pictures.
        n_actions: the number of actions.
    """

    def __init__(self, channels: int, n_actions: int) -> None:
        super().__init__()
        self.features = nn.Conv2d(channels, _FEATURES, 1)
        self.attention = nn.Conv2d(_FEATURES, 1, 1)
        self.action = nn.Linear(2, n_actions)

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Return the attention's logits float32[B, rows, columns] of pictures float32[B, C, rows, columns]."""
        logits: torch.Tensor = self.attention(functional.relu(self.features(x)))
        return logits.squeeze(1)

    @torch.no_grad()
    def find(self, x: torch.Tensor) -> torch.Tensor:
        """Return the agent's row and column, int64[B, 2], in pictures float32[B, C, rows, columns]."""
        best = self(x).flatten(1).argmax(1)
        return torch.stack([best // x.shape[3], best % x.shape[3]], 1)

    def fit(self, transitions: Transitions, rng: torch.Generator) -> None:
        """Fit the attention to transitions, from new weights, unless it tells all their actions already."""
        best, found = self._told(transitions), {name: tensor.clone() for name, tensor in self.state_dict().items()}
        for _ in range(_TRIES if best < _ALL else 0):
            self._fit_once(transitions, rng)
            told = self._told(transitions)
            if told > best:
                best, found = told, {name: tensor.clone() for name, tensor in self.state_dict().items()}
            if best >= _ENOUGH:
                break
        self.load_state_dict(found)

    def displacements(self, transitions: Transitions) -> torch.Tensor:
        """Return how often each action moved the agent to each pixel around it, as shares float32[actions, 9].

        The nine pixels are those of a square with the agent in the middle, row by row. Longer moves count as moves to
        its border. Shares below a tenth count as 0. An action that was never taken moves to each with the same share.
        """
        actions, pixels = transitions[1], self._pixels(transitions)
        every = range(self.action.out_features)
        counts = torch.stack([torch.bincount(pixels[actions == one], minlength=9) for one in every]) + 1e-3
        shares = counts / counts.sum(1, keepdim=True)
        shares[shares < _RARE] = 0
        return shares / shares.sum(1, keepdim=True)

    def _fit_once(self, transitions: Transitions, rng: torch.Generator) -> None:
        for layer in (self.features, self.attention, self.action):
            draw_weights(layer, rng)
        optimizer = torch.optim.Adam(self.parameters(), lr=_LEARNING_RATE)
        n = len(transitions[1])
        for update in range(_UPDATES):
            rows = torch.randint(n, (_BATCH,), generator=rng)
            loss = self._loss([one[rows] for one in transitions], _PEAKED * update / _UPDATES)
            optimizer.zero_grad()
            torch.autograd.backward(loss)
            optimizer.step()

    def _told(self, transitions: Transitions) -> float:
        """Return the share of actions that the displacement of the pixel with the most attention tells."""
        _, actions, _ = transitions
        shares = self.displacements(transitions)
        return float((shares[:, self._pixels(transitions)].argmax(0) == actions).float().mean())

    def _pixels(self, transitions: Transitions) -> torch.Tensor:
        """Return to which of the nine pixels around it the agent moved in each transition."""
        before, _, after = transitions
        step = (self.find(after) - self.find(before)).clamp(-1, 1)
        return 3 * step[:, 0] + step[:, 1] + 4

    def _loss(self, transitions: Sequence[torch.Tensor], peaked: float) -> torch.Tensor:
        before, actions, after = transitions
        first, second = self(before), self(after)
        moved = functional.cross_entropy(self.action(_place(second) - _place(first)), actions)
        return moved + peaked * (_entropy(first) + _entropy(second))


def _place(attention: torch.Tensor) -> torch.Tensor:
    """Return the mean row and column under attention logits float32[B, rows, columns], float32[B, 2]."""
    shares = torch.softmax(attention.flatten(1), 1).view_as(attention)
    rows, columns = (torch.arange(size, dtype=shares.dtype, device=shares.device) for size in shares.shape[1:])
    return torch.stack([shares.sum(2) @ rows, shares.sum(1) @ columns], 1)


def _entropy(attention: torch.Tensor) -> torch.Tensor:
    """Return the mean entropy of attention logits float32[B, rows, columns], in nats."""
    logs = torch.log_softmax(attention.flatten(1), 1)
    return -(logs.exp() * logs).sum(1).mean()
