"""Spread fields over pixels, with a gradient of its own.

With torch's convolutions and their gradients, the same network's updates took more than twice as long.
"""

from typing import Any

import torch

Kernel = list[tuple[int, float]]
"""Which of the nine pixels around a pixel, row by row, a field comes from, and its weight."""


def spread(gates: torch.Tensor, source: torch.Tensor, weights: torch.Tensor, steps: int) -> torch.Tensor:
    """Return the field h after some steps of h <- p * (W @ h) + e, which begin with h = e: float64[N, rows, columns].

    Args:
        gates: p, float64[N, rows, columns].
        source: e, float64[N, rows, columns].
        weights: of the nine pixels around a pixel in W @ h, row by row, float[9]. They get no gradient.
        steps: the number of steps.
    """
    # The fields are the last dimension, so that a shift by a pixel moves long pieces of memory.
    last = [one.movedim(0, 2).contiguous() for one in (gates, source)]
    field: torch.Tensor = _Spread.apply(*last, weights, steps)  # type: ignore[no-untyped-call]  # torch has no types here
    return field.movedim(2, 0)


class _Spread(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, gates: torch.Tensor, source: torch.Tensor, weights: torch.Tensor, steps: int) -> torch.Tensor:
        kernel: Kernel = [(one, weight) for one, weight in enumerate(weights.tolist()) if weight]
        field, arriving = source, []
        for _ in range(steps):
            arriving.append(_moved(field, kernel))
            field = torch.addcmul(source, gates, arriving[-1])
        ctx.save_for_backward(gates)
        ctx.kernel, ctx.arriving = kernel, arriving
        return field

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor, None, None]:
        (gates,) = ctx.saved_tensors
        back = [(8 - one, weight) for one, weight in ctx.kernel]
        of_gates, of_source = torch.zeros_like(gates), gradient.clone()
        for moved in reversed(ctx.arriving):
            of_gates.addcmul_(gradient, moved)
            gradient = _moved(gradient * gates, back)
            of_source += gradient
        return of_gates, of_source, None, None


def _moved(field: torch.Tensor, kernel: Kernel) -> torch.Tensor:
    """Return W @ h for fields h [rows, columns, N]."""
    rows, columns, n = field.shape
    padded = field.new_zeros(rows + 2, columns + 2, n)
    padded[1:-1, 1:-1] = field
    moved = torch.zeros_like(field)
    for one, weight in kernel:
        row, column = divmod(one, 3)
        moved.add_(padded[row : row + rows, column : column + columns], alpha=weight)
    return moved
