"""Spread fields over pixels, with a gradient of its own.

With torch's convolutions and their gradients, the same network's updates took more than twice as long. Fields are
spread by the hundred, so that they stay in the processor's cache: all at once, 1,600 fields took three times as long.
"""

from typing import Any

import torch

Kernel = list[tuple[int, float]]
"""Which of the nine pixels around a pixel, row by row, a field comes from, and its weight."""

_TOGETHER = 128  # fields


def spread(gates: torch.Tensor, source: torch.Tensor, weights: torch.Tensor, steps: int) -> torch.Tensor:
    """Return the field h after some steps of h <- p * (W @ h) + e, which begin with h = e: float64[N, rows, columns].

    Args:
        gates: p, float64[N, rows, columns].
        source: e, float64[N, rows, columns].
        weights: of the nine pixels around a pixel in W @ h, row by row, float[9]. They get no gradient.
        steps: the number of steps.
    """
    kernel: Kernel = [(one, weight) for one, weight in enumerate(weights.tolist()) if weight]
    fields = []
    for some in zip(torch.split(gates, _TOGETHER), torch.split(source, _TOGETHER), strict=True):
        # The fields are the last dimension, so that a shift by a pixel moves long pieces of memory.
        last = [one.movedim(0, 2).contiguous() for one in some]
        field: torch.Tensor = _Spread.apply(*last, kernel, steps)  # type: ignore[no-untyped-call]  # torch has no types here
        fields.append(field.movedim(2, 0))
    return torch.cat(fields)


class _Spread(torch.autograd.Function):
    @staticmethod
    def forward(ctx: Any, gates: torch.Tensor, source: torch.Tensor, kernel: Kernel, steps: int) -> torch.Tensor:
        padded, field = _padded(source)
        field.copy_(source)
        learns, arriving, moved = any(ctx.needs_input_grad), [], torch.empty_like(source)
        for _ in range(steps):
            if learns:
                moved = torch.empty_like(source)
                arriving.append(moved)
            torch.addcmul(source, gates, _moved(padded, kernel, moved), out=field)
        ctx.save_for_backward(gates)
        ctx.kernel, ctx.arriving = kernel, arriving
        return field.contiguous()

    @staticmethod
    def backward(ctx: Any, gradient: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor, None, None]:
        (gates,) = ctx.saved_tensors
        back = [(8 - one, weight) for one, weight in ctx.kernel]
        of_gates, of_source = torch.zeros_like(gates), gradient.clone()
        padded, gated = _padded(gradient)
        before = torch.empty_like(gates)
        for moved in reversed(ctx.arriving):
            of_gates.addcmul_(gradient, moved)
            torch.mul(gradient, gates, out=gated)
            gradient = _moved(padded, back, before)
            of_source += gradient
        return of_gates, of_source, None, None


def _padded(like: torch.Tensor) -> tuple[torch.Tensor, torch.Tensor]:
    """Return memory for fields [rows, columns, N] in a border of zeros: with the border, and without."""
    rows, columns, n = like.shape
    padded = like.new_zeros(rows + 2, columns + 2, n)
    return padded, padded[1:-1, 1:-1]


def _moved(padded: torch.Tensor, kernel: Kernel, out: torch.Tensor) -> torch.Tensor:
    """Write W @ h to `out` [rows, columns, N], for fields h in a border of zeros, and return it."""
    rows, columns, _ = out.shape
    out.zero_()
    for one, weight in kernel:
        row, column = divmod(one, 3)
        out.add_(padded[row : row + rows, column : column + columns], alpha=weight)
    return out
