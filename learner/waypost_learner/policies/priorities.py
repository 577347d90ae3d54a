"""The priorities of a replay buffer's rows, from which rows are drawn in proportion."""

from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

_BLOCK = 64  # rows


class Priorities:
    """Priorities float64[capacity]. Those of rows that were never set are 0.

    The sum of each block of rows is kept. To draw a row is to draw a block, and then a row of that block; so the time
    grows with the number of blocks.

    Args:
        capacity: the largest number of rows.
    """

    def __init__(self, capacity: int) -> None:
        n_blocks = -(-capacity // _BLOCK)
        self._blocks = np.zeros((n_blocks, _BLOCK))
        self._flat = self._blocks.reshape(-1)  # the same memory
        self._sums, self._lowest = np.zeros(n_blocks), np.full(n_blocks, np.inf)

    def __getitem__(self, rows: Any) -> NDArray[np.float64]:
        found: NDArray[np.float64] = self._flat[rows]
        return found

    def set(self, rows: NDArray[np.int64], values: NDArray[np.float64] | float) -> None:
        """Set the priorities of rows."""
        self._flat[rows] = values
        changed = np.unique(rows // _BLOCK)
        blocks = self._blocks[changed]
        self._sums[changed] = blocks.sum(1)
        self._lowest[changed] = np.where(blocks > 0, blocks, np.inf).min(1)

    @property
    def lowest(self) -> float:
        """The lowest priority that is not 0."""
        return float(self._lowest.min())

    @property
    def highest(self) -> float:
        """The highest priority; 0 if none was set."""
        return float(self._flat.max())

    def draw(self, size: int, rng: torch.Generator) -> NDArray[np.int64]:
        """Draw rows int64[size] in proportion to their priorities, with replacement.

        Sums are rounded, so a draw may point behind the last row with a priority; it then gets this row.
        """
        ends = self._sums.cumsum()
        drawn = torch.rand(size, dtype=torch.float64, generator=rng).numpy() * ends[-1]
        block = np.minimum(np.searchsorted(ends, drawn, side="right"), np.flatnonzero(self._sums)[-1])
        within = drawn - (ends[block] - self._sums[block])
        row = (self._blocks[block].cumsum(1) <= within[:, None]).sum(1)
        last = (self._blocks[block] > 0).cumsum(1).argmax(1)
        found: NDArray[np.int64] = block * _BLOCK + np.minimum(row, last)
        return found
