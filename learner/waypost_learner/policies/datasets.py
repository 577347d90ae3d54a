"""Data buffers of rows (observation, choice, termination): the paper's D_HI and D_g, and a flat learner's D.

The choice is a subgoal in D_HI and an action elsewhere. `UNLABELED` marks a label that training ignores. There are
three: a label that the expert did not give, the action in a state where the segment should have ended, and beta_g in a
segment's first state, where it is never evaluated (docs/paper.md, deviation 4).
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import lz4.block
import numpy as np
import torch

from waypost.trajectory import Observation

UNLABELED = -1


@dataclass(frozen=True)
class Row:
    """One labeled state."""

    observation: Observation  # float32 or uint8[observation shape]
    choice: int
    termination: int = UNLABELED
    for_right_subgoal: bool = True  # of pi_g: whether the expert said or showed that g was right there


class Dataset:
    """A growing buffer of rows.

    Observations are stored compressed; decompressing takes no longer than copying. A picture shrinks to a
    thirtieth, so the rows of hundreds of demonstrations, in all symmetries of the maze, fit into a laptop's memory.
    """

    def __init__(self, observation_shape: tuple[int, ...]) -> None:
        self._shape = observation_shape
        self._observations: list[bytes] = []
        self._labels: list[tuple[int, int, bool]] = []  # choice, termination, for_right_subgoal

    def __len__(self) -> int:
        return len(self._labels)

    def __getitem__(self, rows: Sequence[int]) -> tuple[torch.Tensor, torch.Tensor]:
        """Return observations float32[B, observation shape] and labels int64[B, 3] of rows: as in `Row`."""
        observations = np.empty((len(rows), *self._shape), np.float32)
        for one, row in zip(observations, rows, strict=True):
            seen = self._unpacked(row)
            one[...] = seen if seen.dtype == np.float32 else seen / np.float32(255)
        labels = torch.tensor([self._labels[row] for row in rows], dtype=torch.int64).reshape(-1, 3)
        return torch.from_numpy(observations), labels

    def _unpacked(self, row: int) -> Observation:
        """Return an observation as it was appended: uint8 has one byte for each number, float32 has four."""
        raw = lz4.block.decompress(self._observations[row])
        dtype = np.uint8 if len(raw) == math.prod(self._shape) else np.float32
        return np.frombuffer(raw, dtype).reshape(self._shape)

    def counts(self, n_choices: int) -> torch.Tensor:
        """Return how many rows have each choice, int64[n_choices]."""
        choices = torch.tensor([choice for choice, *_ in self._labels if choice != UNLABELED], dtype=torch.int64)
        return torch.bincount(choices, minlength=n_choices)

    def last_counts(self, n_choices: int) -> torch.Tensor:
        """Return how many segments ended after each choice, int64[n_choices]; their rows are in order."""
        ended = ((first, second[1]) for (first, *_), second in pairwise(self._labels))
        choices = [choice for choice, ends in ended if ends == 1 and choice != UNLABELED]
        return torch.bincount(torch.tensor(choices, dtype=torch.int64), minlength=n_choices)

    def append(self, rows: Iterable[Row]) -> None:
        """Append rows."""
        for row in rows:
            self._observations.append(lz4.block.compress(np.ascontiguousarray(row.observation)))
            self._labels.append((row.choice, row.termination, row.for_right_subgoal))

    def tensors(self) -> dict[str, torch.Tensor]:
        """Return all rows as tensors: concatenated compressed observations uint8, their sizes int64[N], the labels."""
        packed = np.frombuffer(b"".join(self._observations), np.uint8)
        sizes = torch.tensor([len(one) for one in self._observations], dtype=torch.int64)
        labels = torch.tensor(self._labels, dtype=torch.int64).reshape(-1, 3)
        return {"observations": torch.from_numpy(packed.copy()), "sizes": sizes, "labels": labels}

    def load(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Replace all rows by the rows that `tensors` returned."""
        packed, ends = tensors["observations"].numpy().tobytes(), tensors["sizes"].cumsum(0).tolist()
        self._observations = [packed[first:end] for first, end in pairwise([0, *ends])]
        self._labels = [(choice, ends, bool(right)) for choice, ends, right in tensors["labels"].tolist()]
