"""Prioritized experience replay (Schaul et al. 2016), proportional variant."""

from collections.abc import Sequence
from typing import Any, Protocol

import lz4.block
import numpy as np
import torch
from numpy.typing import NDArray

from waypost.trajectory import Observation
from waypost_learner.policies.device import as_input
from waypost_learner.rollout.experience import Experience, Transition

Tensors = dict[str, torch.Tensor]
Plane = NDArray[Any]
"""One channel of a picture, or a whole vector: float32 or uint8."""


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

    Sampling sums up all priorities. A sum tree would be faster, but with 100,000 rows the sum takes only 0.4 ms of the
    10 ms of an update.

    Args:
        observation_shape: the shape of the observations of both states.
        spec: capacity, discount and exponents.
    """

    def __init__(self, observation_shape: tuple[int, ...], spec: ReplaySpec) -> None:
        self._spec, self._shape = spec, observation_shape
        self._plane_shape = observation_shape[1:] if len(observation_shape) == 3 else observation_shape
        channels = observation_shape[0] if len(observation_shape) == 3 else 1
        # The memory of the columns is used only when rows are filled.
        self._columns: dict[str, NDArray[Any]] = {
            "before": np.zeros((spec.capacity, channels), np.int64),  # numbers of planes
            "after": np.zeros((spec.capacity, channels), np.int64),
            "choice": np.zeros(spec.capacity, np.int64),
            "reward": np.zeros(spec.capacity, np.float32),
            "discount": np.zeros(spec.capacity, np.float32),
            "demonstrated": np.zeros(spec.capacity, bool),
            "priority": np.zeros(spec.capacity, np.float64),
        }
        self._planes: dict[int, Plane] = {}  # by number, in ascending order
        self._n_planes = 0  # that were ever stored: the number of the next one
        self._size = self._next = 0

    def __len__(self) -> int:
        return self._size

    def add(self, experience: Experience) -> None:
        """Append transitions with the highest priority so far, so that they are sampled soon."""
        highest = float(self._columns["priority"][: self._size].max()) if self._size else 1.0
        numbers = self._store(experience.observations)
        for one in experience.transitions:
            self._append(one, numbers, experience.demonstrated, highest)
        self._forget()

    def _store(self, observations: Sequence[Observation]) -> list[list[int]]:
        """Store the planes of observations; return the numbers of each observation's planes."""
        numbers: list[list[int]] = []
        known: list[tuple[int, Plane]] = []  # the planes of the observation before
        for observation in observations:
            found = [
                self._known(plane, known[channel : channel + 2])
                for channel, plane in enumerate(observation.reshape(-1, *self._plane_shape))
            ]
            known = [(number, self._planes[number]) for number in found]
            numbers.append(found)
        return numbers

    def _known(self, plane: Plane, candidates: Sequence[tuple[int, Plane]]) -> int:
        """Return the number of a plane: of an equal one among the candidates, or else a new one."""
        for number, candidate in candidates:
            if np.array_equal(plane, candidate):
                return number
        self._planes[self._n_planes] = plane.copy()
        self._n_planes += 1
        return self._n_planes - 1

    def _append(self, one: Transition, numbers: list[list[int]], demonstrated: bool, priority: float) -> None:
        values = {
            "before": numbers[one.state],
            "after": numbers[one.next_state],
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

    def _forget(self) -> None:
        """Remove the planes that are older than the oldest transition's. No other transition uses them."""
        if self._size:
            oldest = self._next % self._size if self._size == self._spec.capacity else 0
            first = int(self._columns["before"][oldest].min())
            for number in range(next(iter(self._planes), first), first):
                self._planes.pop(number, None)

    def sample(self, size: int, rng: torch.Generator) -> tuple[torch.Tensor, Tensors]:
        """Draw rows in proportion to their priorities; return their indices int64[size] and their columns.

        `before` and `after` are float32[size, observation shape]. The column `weight` float32[size] holds
        importance-sampling weights for beta = 1, scaled to a maximum of 1.
        """
        priorities = torch.from_numpy(self._columns["priority"][: self._size])
        sums = priorities.cumsum(0)
        drawn = torch.rand(size, dtype=torch.float64, generator=rng) * sums[-1]
        rows = torch.searchsorted(sums, drawn, right=True).clamp(max=self._size - 1)
        found = {name: torch.from_numpy(column[rows.numpy()]) for name, column in self._columns.items()}
        found |= {name: self._observations(found[name]) for name in ("before", "after")}
        found["weight"] = (priorities.min() / found["priority"]).float()
        return rows, found

    def _observations(self, numbers: torch.Tensor) -> torch.Tensor:
        """Return the observations with these planes int64[n, channels] as float32[n, observation shape].

        Pictures get the memory layout of `to_device`. To rearrange their bytes, before they become floats, is far
        faster.
        """
        planes = np.stack([self._planes[number] for number in numbers.flatten().tolist()])
        planes = planes.reshape(len(numbers), *self._shape)
        if planes.ndim != 4:
            return as_input(planes)
        interleaved = np.empty((len(numbers), *self._shape[1:], self._shape[0]), planes.dtype)
        for channel in range(self._shape[0]):
            interleaved[..., channel] = planes[:, channel]
        return as_input(interleaved).permute(0, 3, 1, 2)

    def prioritize(self, rows: torch.Tensor, errors: torch.Tensor) -> None:
        """Set the priorities of rows from their temporal-difference errors float32[n]."""
        self._columns["priority"][rows.numpy()] = (errors.double().abs().numpy() + 1e-4) ** self._spec.alpha

    def tensors(self) -> Tensors:
        """Return the whole buffer, for a checkpoint. Planes are compressed, each by itself."""
        columns = {name: torch.from_numpy(column[: self._size].copy()) for name, column in self._columns.items()}
        packed = [lz4.block.compress(np.ascontiguousarray(plane)) for plane in self._planes.values()]
        return {
            **columns,
            "next": torch.tensor([self._next, self._n_planes]),
            "numbers": torch.tensor(list(self._planes), dtype=torch.int64),
            "sizes": torch.tensor([len(one) for one in packed], dtype=torch.int64),
            "planes": torch.frombuffer(bytearray(b"".join(packed)) or bytearray(1), dtype=torch.uint8),
        }

    def load(self, tensors: Tensors) -> None:
        """Replace the buffer by the one that `tensors` returned."""
        self._size = len(tensors["choice"])
        self._next, self._n_planes = tensors["next"].tolist()
        for name, column in self._columns.items():
            column[: self._size] = tensors[name].numpy()
        packed, end = tensors["planes"].numpy().tobytes(), 0
        self._planes = {}
        for number, size in zip(tensors["numbers"].tolist(), tensors["sizes"].tolist(), strict=True):
            raw = lz4.block.decompress(packed[end : end + size])
            dtype = np.uint8 if len(raw) == np.prod(self._plane_shape) else np.float32
            self._planes[number] = np.frombuffer(raw, dtype).reshape(self._plane_shape)
            end += size
