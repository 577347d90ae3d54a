"""Prioritized experience replay (Schaul et al. 2016), proportional variant."""

from collections.abc import Sequence
from typing import Any, Protocol

import lz4.block
import numpy as np
import torch
from numpy.typing import NDArray

from waypost.trajectory import Observation
from waypost_learner.policies.device import as_input
from waypost_learner.policies.priorities import Priorities
from waypost_learner.rollout.experience import Experience, Transition

Tensors = dict[str, torch.Tensor]
Plane = NDArray[Any]
"""One channel of a picture, or a whole vector: float32 or uint8."""

_FEWEST_PLANES = 1_024


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
        # The memory of the columns is used only when rows are filled.
        self._columns: dict[str, NDArray[Any]] = {
            "before": np.zeros((spec.capacity, channels), np.int64),  # numbers of planes
            "after": np.zeros((spec.capacity, channels), np.int64),
            "choice": np.zeros(spec.capacity, np.int64),
            "reward": np.zeros(spec.capacity, np.float32),
            "discount": np.zeros(spec.capacity, np.float32),
            "demonstrated": np.zeros(spec.capacity, bool),
        }
        self._priorities = Priorities(spec.capacity)
        self._planes = _Planes(self._plane_shape)
        self._size = self._next = 0

    def __len__(self) -> int:
        return self._size

    def add(self, experience: Experience) -> None:
        """Append transitions with the highest priority so far, so that they are sampled soon."""
        highest = self._priorities.highest if self._size else 1.0
        numbers = self._store(experience.observations)
        rows = np.array([self._append(one, numbers, experience.demonstrated) for one in experience.transitions])
        if len(rows):
            self._priorities.set(rows, highest)
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
            known = list(zip(found, observation.reshape(-1, *self._plane_shape), strict=True))
            numbers.append(found)
        return numbers

    def _known(self, plane: Plane, candidates: Sequence[tuple[int, Plane]]) -> int:
        """Return the number of a plane: of an equal one among the candidates, or else a new one."""
        for number, candidate in candidates:
            if np.array_equal(plane, candidate):
                return number
        return self._planes.append(plane)

    def _append(self, one: Transition, numbers: list[list[int]], demonstrated: bool) -> int:
        """Append a transition without its priority; return its row."""
        values = {
            "before": numbers[one.state],
            "after": numbers[one.next_state],
            "choice": one.choice,
            "reward": one.reward,
            "discount": self._spec.discount**one.steps if one.steps else 0.0,
            "demonstrated": demonstrated,
        }
        for name, value in values.items():
            self._columns[name][self._next] = value
        self._size = max(self._size, self._next + 1)
        row, self._next = self._next, (self._next + 1) % self._spec.capacity
        return row

    def _forget(self) -> None:
        """Remove the planes that are older than the oldest transition's. No other transition uses them."""
        if self._size:
            oldest = self._next % self._size if self._size == self._spec.capacity else 0
            self._planes.forget(int(self._columns["before"][oldest].min()))

    def sample(self, size: int, rng: torch.Generator) -> tuple[torch.Tensor, Tensors]:
        """Draw rows in proportion to their priorities; return their indices int64[size] and their columns.

        `before` and `after` are float32[size, observation shape]. The column `weight` float32[size] holds
        importance-sampling weights for beta = 1, scaled to a maximum of 1.
        """
        rows = self._priorities.draw(size, rng)
        found = {name: torch.from_numpy(column[rows]) for name, column in self._columns.items()}
        found |= {name: self._observations(found[name]) for name in ("before", "after")}
        found["weight"] = torch.from_numpy(self._priorities.lowest / self._priorities[rows]).float()
        return torch.from_numpy(rows), found

    def _observations(self, numbers: torch.Tensor) -> torch.Tensor:
        """Return the observations with these planes int64[n, channels] as float32[n, observation shape]."""
        return as_input(self._planes[numbers.numpy()].reshape(len(numbers), *self._shape))

    def prioritize(self, rows: torch.Tensor, errors: torch.Tensor) -> None:
        """Set the priorities of rows from their temporal-difference errors float32[n]."""
        self._priorities.set(rows.numpy(), (errors.double().abs().numpy() + 1e-4) ** self._spec.alpha)

    def tensors(self) -> Tensors:
        """Return the whole buffer, for a checkpoint. Planes are compressed, each by itself."""
        columns = {name: torch.from_numpy(column[: self._size].copy()) for name, column in self._columns.items()}
        numbers = np.arange(self._planes.first, self._planes.end)
        packed = [lz4.block.compress(self._planes[number]) for number in numbers]
        return {
            **columns,
            "priority": torch.from_numpy(self._priorities[: self._size].copy()),
            "next": torch.tensor([self._next, self._planes.end]),
            "sizes": torch.tensor([len(one) for one in packed], dtype=torch.int64),
            "planes": torch.frombuffer(bytearray(b"".join(packed)) or bytearray(1), dtype=torch.uint8),
        }

    def load(self, tensors: Tensors) -> None:
        """Replace the buffer by the one that `tensors` returned."""
        self._size = len(tensors["choice"])
        self._next, end_of_planes = tensors["next"].tolist()
        for name, column in self._columns.items():
            column[: self._size] = tensors[name].numpy()
        self._priorities = Priorities(self._spec.capacity)
        self._priorities.set(np.arange(self._size), tensors["priority"].numpy())
        packed, end = tensors["planes"].numpy().tobytes(), 0
        sizes = tensors["sizes"].tolist()
        self._planes = _Planes(self._plane_shape, end_of_planes - len(sizes))
        for size in sizes:
            raw = lz4.block.decompress(packed[end : end + size])
            dtype = np.uint8 if len(raw) == np.prod(self._plane_shape) else np.float32
            self._planes.append(np.frombuffer(raw, dtype).reshape(self._plane_shape))
            end += size


class _Planes:
    """Planes by their numbers, in a ring that grows when it is full.

    Args:
        shape: the shape of a plane.
        first: the number of the first plane.
    """

    def __init__(self, shape: tuple[int, ...], first: int = 0) -> None:
        self.first = self.end = first  # planes from `first` on, and before `end`, are there
        self._shape = shape
        self._ring: Plane | None = None  # with the planes' dtype, from the first plane on

    def __getitem__(self, numbers: Any) -> Plane:
        assert self._ring is not None, "there are no planes"
        found: Plane = self._ring[numbers % len(self._ring)]
        return found

    def append(self, plane: Plane) -> int:
        """Store a plane; return its number."""
        if self._ring is None:
            self._ring = np.empty((_FEWEST_PLANES, *self._shape), plane.dtype)
        if self.end - self.first == len(self._ring):
            numbers = np.arange(self.first, self.end)
            larger = np.empty((2 * len(self._ring), *self._shape), plane.dtype)
            for one in numbers:  # one by one, because a copy of all of them would take as much memory again
                larger[one % len(larger)] = self._ring[one % len(self._ring)]
            self._ring = larger
        self._ring[self.end % len(self._ring)] = plane
        self.end += 1
        return self.end - 1

    def forget(self, before: int) -> None:
        """Remove the planes with lower numbers."""
        self.first = max(self.first, before)
