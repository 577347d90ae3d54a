"""The data buffers of the paper: D_HI, one D_g per subgoal, and a flat learner's D.

A buffer holds rows (observation, choice, termination). The choice is a subgoal in D_HI and an action elsewhere;
`UNLABELED` marks what an expert did not label, and what must not be learned from: the action in a state where the
segment should have ended, and beta_g at a segment's first state, where it is never asked (docs/paper.md, deviation 4).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import lz4.block
import numpy as np
import torch

from waypost.domain import Structured, Symmetry
from waypost.trajectory import Action, Segment, Subgoal, Trajectory
from waypost_learner.rollout.experience import Transition
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey

UNLABELED = -1


@dataclass(frozen=True)
class Row:
    """One labeled state."""

    observation: np.ndarray  # float32[observation shape]
    choice: int
    termination: int = UNLABELED


class Dataset:
    """A growing buffer of rows.

    Observations are kept compressed, and unpacked as fast as they could be copied. Pictures shrink to a thirtieth, so
    hundreds of demonstrations, turned and mirrored, fit a laptop.
    """

    def __init__(self, observation_shape: tuple[int, ...]) -> None:
        self._shape = observation_shape
        self._observations: list[bytes] = []
        self._labels: list[tuple[int, int]] = []  # choice, termination

    def __len__(self) -> int:
        return len(self._labels)

    def __getitem__(self, rows: Sequence[int]) -> tuple[torch.Tensor, torch.Tensor]:
        """Return observations float32[B, observation shape] and labels int64[B, 2]: choice, termination."""
        observations = np.empty((len(rows), *self._shape), np.float32)
        for one, row in zip(observations, rows, strict=True):
            one[...] = np.frombuffer(lz4.block.decompress(self._observations[row]), np.float32).reshape(self._shape)
        labels = torch.tensor([self._labels[row] for row in rows], dtype=torch.int64).reshape(-1, 2)
        return torch.from_numpy(observations), labels

    def append(self, rows: Iterable[Row]) -> None:
        """Add rows at the end."""
        for row in rows:
            self._observations.append(lz4.block.compress(np.ascontiguousarray(row.observation, np.float32)))
            self._labels.append((row.choice, row.termination))

    def tensors(self) -> dict[str, torch.Tensor]:
        """Return all rows: the compressed observations uint8 one after the other, their sizes int64[N], the labels."""
        packed = np.frombuffer(b"".join(self._observations), np.uint8)
        sizes = torch.tensor([len(one) for one in self._observations], dtype=torch.int64)
        labels = torch.tensor(self._labels, dtype=torch.int64).reshape(-1, 2)
        return {"observations": torch.from_numpy(packed.copy()), "sizes": sizes, "labels": labels}

    def load(self, tensors: Mapping[str, torch.Tensor]) -> None:
        """Replace all rows by those of `tensors`."""
        packed, ends = tensors["observations"].numpy().tobytes(), tensors["sizes"].cumsum(0).tolist()
        self._observations = [packed[first:end] for first, end in pairwise([0, *ends])]
        self._labels = [(choice, termination) for choice, termination in tensors["labels"].tolist()]


@dataclass(frozen=True)
class LoLabels:
    """a*_1 .. a*_H (None where the segment should have ended) and omega*_1 .. omega*_{H+1}."""

    actions: tuple[Action | None, ...]
    terminations: tuple[bool, ...]


@dataclass
class Labels:
    """What one episode taught: new rows and transitions for the buffers, by policy."""

    rows: dict[PolicyKey, list[Row]] = field(default_factory=dict)
    transitions: dict[PolicyKey, list[Transition]] = field(default_factory=dict)
    labeled: list[tuple[Trajectory, tuple[Subgoal, ...]]] = field(default_factory=list)  # on the HI level
    demonstrated: list[Trajectory] = field(default_factory=list)

    def append_hi(self, trajectory: Trajectory, good_subgoals: Sequence[Subgoal]) -> None:
        """D_HI <- D_HI + {(s_h, g*_h)}."""
        self.labeled.append((trajectory, tuple(good_subgoals)))
        rows = self.rows.setdefault(META, [])
        rows += [Row(s.start.observation, g) for s, g in zip(trajectory, good_subgoals, strict=True)]

    def relabel(self, domain: Structured) -> None:
        """D <- D + what the labels of D_HI, and the demonstrations, say of other tasks, as the domain has it."""
        rows = self.rows.setdefault(META, [])
        rows += [Row(o, g) for sigma, good in self.labeled for o, g in domain.relabeled(sigma, good)]
        for demonstration in self.demonstrated:
            for segment in domain.retraced(demonstration):
                self._append_demonstrated(segment)

    def append_lo(self, segment: Segment, labels: LoLabels) -> None:
        """D_g <- D_g + {(s, a*, omega*)}, up to the state where the segment should have ended."""
        assert segment.subgoal is not None
        rows = self.rows.setdefault(segment.subgoal, [])
        steps = zip(segment.states, (*labels.actions, None), labels.terminations, strict=True)
        for step, (state, action, ends) in enumerate(steps):
            choice = UNLABELED if ends or action is None else action
            termination = UNLABELED if step == 0 else int(ends)
            if choice != UNLABELED or termination != UNLABELED:
                rows.append(Row(state.observation, choice, termination))
            if ends:
                break

    def append_demonstration(self, demonstration: Trajectory) -> None:
        """Lines 5-7 of Algorithm 1: each segment's labels are what the expert did."""
        self.demonstrated.append(demonstration)
        for segment in demonstration:
            self._append_demonstrated(segment)
        self.append_hi(demonstration, [s.subgoal for s in demonstration if s.subgoal is not None])

    def _append_demonstrated(self, segment: Segment) -> None:
        terminations = (*(False for _ in segment.actions), True)
        self.append_lo(segment, LoLabels(segment.actions, terminations))

    def append_experience(self, key: PolicyKey, transitions: Iterable[Transition]) -> None:
        """D_g <- D_g + tau_h (Algorithm 3, lines 20 and 22): what Q_g, or another Q-function, learns from."""
        self.transitions.setdefault(key, []).extend(transitions)

    def seen_through(self, symmetry: Symmetry) -> "Labels":
        """Return what the same labels say of the changed picture."""

        def changed(key: PolicyKey, row: Row) -> Row:
            names = symmetry.subgoals if key == META else symmetry.actions
            choice = UNLABELED if row.choice == UNLABELED else names[row.choice]
            return Row(symmetry.observe(row.observation), choice, row.termination)

        def experienced(key: PolicyKey, transition: Transition) -> Transition:
            names = symmetry.subgoals if key == META else symmetry.actions
            return replace(
                transition,
                observation=symmetry.observe(transition.observation),
                choice=names[transition.choice],
                next_observation=symmetry.observe(transition.next_observation),
            )

        def renamed(key: PolicyKey) -> PolicyKey:
            return symmetry.subgoals[key] if key >= 0 else key

        return Labels(
            {renamed(key): [changed(key, row) for row in rows] for key, rows in self.rows.items()},
            {renamed(key): [experienced(key, one) for one in found] for key, found in self.transitions.items()},
        )

    def append_flat(self, trajectory: Trajectory, good_actions: Sequence[Action]) -> None:
        """D <- D + {(s, a*)} over the full trajectory, each pair once: a learner that goes in circles repeats them."""
        states = [state for segment in trajectory for state in segment.states[:-1]]
        pairs = zip((state.observation for state in states), good_actions, strict=True)
        once = {(observation.tobytes(), a): Row(observation, a) for observation, a in pairs}
        self.rows.setdefault(FLAT, []).extend(once.values())
