"""A network that plans over the places of a view with soft value iteration."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import torch
from torch import nn
from torch.autograd.function import once_differentiable
from torch.nn import functional

from waypost.domains import Grid
from waypost_learner.policies.device import draw_weights

_FLOAT32_STEPS = 32
"""The longest horizon that float32 is precise enough for: exp(V) is between about exp(-2.5) and 4 per step."""


@dataclass(frozen=True)
class PlanningSpec:
    """Sizes of a network that plans over the places of a view."""

    grid: Grid
    horizon: int  # how many choices ahead it plans
    features: int  # of each place


class PlanningNet(nn.Module):
    """Maps views float32[B, C, rows, columns] to values float32[B, outputs] of the choices at the agent's place.

    A value iteration network (Tamar et al. 2016): the domain gives the moves, and a convolution over each place's patch
    gives the cost of each move and of ending there. Soft value iteration turns the costs into values.

    Ending has a cost at every place, even if the grid has no move for it. If `outputs` is one more than the number of
    the grid's moves, the last output is the logit of beta_g: of ending instead of continuing.
    """

    def __init__(self, channels: int, outputs: int, spec: PlanningSpec, rng: torch.Generator) -> None:
        super().__init__()
        self.grid = spec.grid
        self.moves = [move for move in spec.grid.moves if move is not None]  # None, for ending, is the last
        self.outputs, self.terminates, self.horizon = outputs, outputs > len(spec.grid.moves), spec.horizon
        self.places = nn.Conv2d(channels, spec.features, spec.grid.patch, spec.grid.stride)
        self.costs = nn.Conv2d(spec.features, len(self.moves) + 1, 1)
        for layer in (self.places, self.costs):
            draw_weights(layer, rng)

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Run soft value iteration and return the values at the agent's place."""
        costs = self.costs(functional.relu(self.places(x)))
        passable = torch.sigmoid(-(costs.double() if self.horizon > _FLOAT32_STEPS else costs))  # exp(-softplus(cost))
        passable = functional.pad(passable, (1, 1, 1, 1))  # outside the picture nothing is passable, and nothing ends
        moving, ending = passable[:, :-1], passable[:, -1]
        columns = ending.shape[2]
        ahead = [down * columns + right for down, right in self.moves]  # in the flat pictures
        reached = iterate(moving, ending, ahead, self.horizon - 1)
        at = self._agent(x, *ending.shape[1:])
        moving_here = moving.flatten(2).gather(2, at[:, None, None].expand(-1, len(ahead), 1)).squeeze(2)
        ending_here = ending.flatten(1).gather(1, at[:, None])
        moving_here = moving_here * reached.flatten(1).gather(1, at[:, None] + torch.tensor(ahead, device=at.device))
        if self.terminates:
            continuing = moving_here.sum(1, keepdim=True)
            return torch.cat([_log(moving_here), _log(ending_here) - _log(continuing)], 1).float()
        return _log(torch.cat([moving_here, ending_here], 1))[:, : self.outputs].float()

    def _agent(self, x: torch.Tensor, rows: int, columns: int) -> torch.Tensor:
        """Return the index int64[B] of the agent's place in the flat pictures of rows x columns places."""
        if self.grid.agent is None:
            return torch.full((len(x),), rows // 2 * columns + columns // 2, device=x.device)
        pixel = x[:, self.grid.agent].flatten(1).argmax(1)
        stride, middle = self.grid.stride, self.grid.patch // 2
        row, column = (
            ((pixels - middle + stride // 2) // stride).clamp(0, size - 3) + 1
            for pixels, size in ((pixel // x.shape[3], rows), (pixel % x.shape[3], columns))
        )
        return row * columns + column


def iterate(moving: torch.Tensor, ending: torch.Tensor, ahead: Sequence[int], steps: int) -> torch.Tensor:
    """Return exp(V) after steps of soft value iteration, [B, rows, columns].

    V begins as that of ending at once. Each step is exp(V) <- ending + sum over moves of moving * exp(V) at the next
    place.

    Args:
        moving: [B, moves, rows, columns], exp(-cost) of each move at each place; 0 in the frame, the outermost places.
        ending: [B, rows, columns], exp(-cost) of ending there; 0 in the frame.
        ahead: for each move, the next place's distance in the flat picture: down * columns + right.
        steps: how many.
    """
    flat: torch.Tensor = _Iteration.apply(  # type: ignore[no-untyped-call]  # torch has no types here
        moving.transpose(0, 1).flatten(1), ending.flatten(), ahead, steps
    )
    return flat.view_as(ending)


class _Iteration(torch.autograd.Function):
    """`iterate` over all pictures as one flat array, which is three times as fast as autograd's own way through it.

    A move is then a shift of the array. No shift goes from one picture to another, since the frames are 0. Outside the
    array there is a margin of zeros.
    """

    @staticmethod
    def forward(ctx: Any, moving: torch.Tensor, ending: torch.Tensor, ahead: Sequence[int], steps: int) -> torch.Tensor:
        n, margin = len(ending), max(map(abs, ahead))
        # All steps are kept only if their gradients will be wanted.
        reached = ending.new_zeros(steps + 1 if any(ctx.needs_input_grad) else 2, margin + n + margin)
        inside = reached[:, margin : margin + n]
        inside[0] = ending
        for step in range(steps):
            before, after = reached[step % len(reached)], inside[(step + 1) % len(reached)]
            after.copy_(ending)
            for move, distance in zip(moving, ahead, strict=True):
                after.addcmul_(move, before[margin + distance :][:n])
        ctx.save_for_backward(moving, reached)
        ctx.ahead, ctx.margin = ahead, margin
        return inside[steps % len(reached)].clone()

    @staticmethod
    @once_differentiable
    def backward(ctx: Any, grad: torch.Tensor) -> tuple[torch.Tensor | None, ...]:
        moving, reached = ctx.saved_tensors
        n, margin = len(grad), ctx.margin
        of_moving, of_ending = torch.zeros_like(moving), torch.zeros_like(grad)
        for step in reversed(range(len(reached) - 1)):
            of_ending += grad
            before, padded = reached[step], torch.zeros_like(reached[step])
            for move, of_move, distance in zip(moving, of_moving, ctx.ahead, strict=True):
                shifted = slice(margin + distance, margin + distance + n)
                of_move.addcmul_(grad, before[shifted])
                padded[shifted].addcmul_(grad, move)
            grad = padded[margin : margin + n]
        return of_moving, of_ending + grad, None, None


def _log(x: torch.Tensor) -> torch.Tensor:
    """Return the logarithm, but at least that of the smallest number that the type represents well."""
    return torch.log(x.clamp(min=1e-35 if x.dtype == torch.float32 else 1e-300))
