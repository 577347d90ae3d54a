"""Prioritized experience replay (Schaul et al. 2016), proportional variant."""

from collections.abc import Sequence
from typing import Any, Protocol

import lz4.block
import numpy as np
import torch
from numpy.typing import NDArray

from waypost.trajectory import Observation
from waypost_learner.policies.device import DEVICE, as_input, to_device
from waypost_learner.rollout.experience import Experience, Transition

Tensors = dict[str, torch.Tensor]
Plane = bytes
"""The bytes of one channel of a picture, or of a whole vector: float32 or uint8."""

BLOCK = 64  # rows whose priorities are summed up together


class ReplaySpec(Protocol):
    """The values of a replay buffer; `DqnSpec` has them."""

    @property
    def capacity(self) -> int:
        """The largest number of transitions in the buffer."""

    @property
    def discount(self) -> float:
        """Gamma."""

    @property
    def alpha(self) -> float:
        """The exponent of priorities."""


class Replay:
    """A replay buffer with proportional priorities. When it is full, new transitions replace the oldest.

    Observations are stored as planes. A plane that the observation before has too, as in a stack of the last pictures,
    is stored once, so 500,000 transitions of four 84x84 pictures take 3.5 GiB.

    Args:
        observation_shape: the shape of the observations of both states.
        spec: capacity, discount and exponents.
    """

    def __init__(self, observation_shape: tuple[int, ...], spec: ReplaySpec) -> None:
        self._spec, self._shape = spec, observation_shape
        self._plane_shape = observation_shape[1:] if len(observation_shape) == 3 else observation_shape
        channels = observation_shape[0] if len(observation_shape) == 3 else 1
        rows = -(-spec.capacity // BLOCK) * BLOCK  # whole blocks
        # The memory of the columns is used only when rows are filled. A plane exists while a row refers to it.
        self._planes = {name: np.empty((rows, channels), object) for name in ("before", "after")}
        self._dtype: np.dtype[Any] = np.dtype(np.float32)  # of planes
        self._columns: dict[str, NDArray[Any]] = {
            "choice": np.zeros(rows, np.int64),
            "reward": np.zeros(rows, np.float32),
            "discount": np.zeros(rows, np.float32),
            "demonstrated": np.zeros(rows, bool),
            "priority": np.zeros(rows, np.float64),
        }
        self._size = self._next = 0

    def __len__(self) -> int:
        return self._size

    def add(self, experience: Experience) -> None:
        """Append transitions with the highest priority so far, so that they are sampled soon."""
        highest = float(self._columns["priority"][: self._size].max()) if self._size else 1.0
        planes = self._split(experience.observations)
        for one in experience.transitions:
            self._append(one, planes, one.state in experience.demonstrated, highest)

    def _split(self, observations: Sequence[Observation]) -> list[list[Plane]]:
        """Return the planes of observations; equal planes of neighbors are one object."""
        planes: list[list[Plane]] = []
        known: list[Plane] = []  # the planes of the observation before
        for observation in observations:
            self._dtype = observation.dtype
            channels = (plane.tobytes() for plane in observation.reshape(-1, *self._plane_shape))
            known = [_known(plane, known[channel : channel + 2]) for channel, plane in enumerate(channels)]
            planes.append(known)
        return planes

    def _append(self, one: Transition, planes: list[list[Plane]], demonstrated: bool, priority: float) -> None:
        self._planes["before"][self._next] = planes[one.state]
        self._planes["after"][self._next] = planes[one.next_state]
        values = {
            "choice": one.choice,
            "reward": one.reward,
            "discount": self._spec.discount**one.steps if one.steps else 0.0,
            "demonstrated": demonstrated,
            "priority": priority,
        }
        for name, value in values.items():
            self._columns[name][self._next] = value
        self._size = max(self._size, self._next + 1)
        self._next = (self._next + 1) % self._spec.capacity

    def sample(self, size: int, rng: torch.Generator) -> tuple[torch.Tensor, Tensors]:
        """Draw rows in proportion to their priorities; return their indices int64[size] and their columns.

        `before` and `after` are float32[size, observation shape], on the device. The column `weight` float32[size]
        holds importance-sampling weights for beta = 1, scaled to a maximum of 1.
        """
        rows = self._draw(size, rng)
        found = {name: torch.from_numpy(column[rows]) for name, column in self._columns.items()}
        found |= {name: self._observations(planes[rows]) for name, planes in self._planes.items()}
        priorities = self._columns["priority"]
        found["weight"] = torch.from_numpy((priorities[: self._size].min() / priorities[rows]).astype(np.float32))
        return torch.from_numpy(rows), found

    def _draw(self, size: int, rng: torch.Generator) -> NDArray[np.int64]:
        """Return rows int64[size]: of each drawn number, the block and then the row in it where the sum exceeds it.

        Sums of blocks take a third of the time of cumulative sums of all rows, in which each sum waits for the last.
        """
        blocks = self._columns["priority"].reshape(-1, BLOCK)[: -(-self._size // BLOCK)]
        sums = torch.from_numpy(blocks).sum(1).numpy()  # NumPy is slow at short rows
        ends = sums.cumsum()
        drawn = torch.rand(size, dtype=torch.float64, generator=rng).numpy() * ends[-1]
        block = np.searchsorted(ends[:-1], drawn, side="right")
        ends_inside = blocks[block].cumsum(1) + (ends - sums)[block, None]  # [size, BLOCK]
        # Where rounding lets no sum exceed the number, this is the first row of the block.
        return np.asarray(block * BLOCK + (ends_inside > drawn[:, None]).argmax(1))

    def _observations(self, planes: NDArray[Any]) -> torch.Tensor:
        """Return the observations with these planes object[n, channels] on the device, float32[n, observation shape].

        Pictures get the memory layout of `to_device`. To rearrange their bytes, before they become floats, is far
        faster on a CPU.
        """
        joined = np.frombuffer(bytearray().join(planes.ravel().tolist()), self._dtype)
        stacks = joined.reshape(len(planes), *self._shape)
        if stacks.ndim != 4 or DEVICE.type == "cuda":
            return to_device(as_input(stacks))
        interleaved = np.empty((len(planes), *self._shape[1:], self._shape[0]), self._dtype)
        for channel in range(self._shape[0]):
            interleaved[..., channel] = stacks[:, channel]
        return as_input(interleaved).permute(0, 3, 1, 2)

    def prioritize(self, rows: torch.Tensor, errors: torch.Tensor) -> None:
        """Set the priorities of rows from their temporal-difference errors float32[n]."""
        self._columns["priority"][rows.numpy()] = (np.abs(errors.double().numpy()) + 1e-4) ** self._spec.alpha

    def tensors(self) -> Tensors:
        """Return the whole buffer, for a checkpoint. Planes are compressed, each by itself, and get numbers."""
        columns = {name: torch.from_numpy(column[: self._size].copy()) for name, column in self._columns.items()}
        planes = {id(plane): plane for column in self._planes.values() for plane in column[: self._size].flat}
        numbers = {address: number for number, address in enumerate(planes)}
        for name, column in self._planes.items():
            numbered = [numbers[id(plane)] for plane in column[: self._size].flat]
            columns[name] = torch.tensor(numbered, dtype=torch.int64).reshape(self._size, column.shape[1])
        packed = [lz4.block.compress(plane) for plane in planes.values()]
        return {
            **columns,
            "next": torch.tensor([self._next]),
            "sizes": torch.tensor([len(one) for one in packed], dtype=torch.int64),
            "planes": torch.frombuffer(bytearray(b"".join(packed)) or bytearray(1), dtype=torch.uint8),
        }

    def load(self, tensors: Tensors) -> None:
        """Replace the buffer by the one that `tensors` returned."""
        self._size, self._next = len(tensors["choice"]), int(tensors["next"][0])
        for name, column in self._columns.items():
            column[: self._size], column[self._size :] = tensors[name].numpy(), 0
        packed, end = tensors["planes"].numpy().tobytes(), 0
        planes = list[Plane]()
        for size in tensors["sizes"].tolist():
            planes.append(lz4.block.decompress(packed[end : end + size]))
            end += size
        for name, column in self._planes.items():
            column[:] = None
            for row, numbers in enumerate(tensors[name].tolist()):
                column[row] = [planes[number] for number in numbers]
        if planes:
            is_byte = len(planes[0]) == np.prod(self._plane_shape)
            self._dtype = np.dtype(np.uint8 if is_byte else np.float32)


def _known(plane: Plane, candidates: Sequence[Plane]) -> Plane:
    """Return an equal plane among the candidates, or else the plane."""
    return next((candidate for candidate in candidates if candidate == plane), plane)
