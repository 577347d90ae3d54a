"""What all gates share: what they see of a rollout, what they remember, and the threshold above which they doubt."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
import torch
from numpy.typing import NDArray

from waypost_learner.gates.value import Value
from waypost_learner.gates.views import N_FEATURES, Level, Seen
from waypost_learner.policies.datasets import UNLABELED, Dataset, Row

_FIRST = 20  # segments, of which every one is doubted; before, no quantile means anything
_RECENT = 200  # segments, whose doubts set the threshold
_MOST = 1_000  # segments that a network learns from: the latest ones

_RIGHT, _WRONG = 0, 1  # what an answer said of a choice


@dataclass(frozen=True)
class GateSpec:
    """Which gate decides what hg-gated asks."""

    kind: Literal["aim", "lazy", "thrifty"] = "lazy"
    share: float = 0.2  # of the recent segments that each level's threshold would have doubted

    def __post_init__(self) -> None:
        """Refuse a share out of its range.

        Raises:
            ValueError: the share is not between 0 and 1.
        """
        if not 0 < self.share < 1:
            raise ValueError(
                f"gate.share is the share of segments to ask about, between 0 and 1, and not {self.share:g}"
            )


LAZY = GateSpec()
"""The gate that needs least of a learner."""


@dataclass(frozen=True)
class Doubts:
    """What a gate doubts in a rollout, by segment: mu's choice of the subgoal, and what pi_g did."""

    hi: Sequence[bool]
    lo: Sequence[bool]
    seen: Seen

    def judged(self, said: Mapping[Level, Mapping[int, bool]]) -> dict[Level, list[Row]]:
        """Return the rollout as rows for the gate: what it saw of each segment, and what an answer said of it.

        Args:
            said: for each level, whether the choices of a segment were right, by the segment's place; segments that
                were not asked about are left out.
        """
        answers = {level: {h: _RIGHT if right else _WRONG for h, right in said[level].items()} for level in said}
        return {
            level: [Row(one, answers[level].get(h, UNLABELED), int(h == len(seen) - 1)) for h, one in enumerate(seen)]
            for level, seen in self.seen.items()
        }


class Gate(ABC):
    """Doubts choices. Its memory is all of its state: its networks are fitted to it again when it has grown.

    Args:
        share: the share of the recent segments that a threshold is to lie below.
        seed: fixes the networks' initial weights.
    """

    wrong: ClassVar[float]  # the value of choices that an answer found wrong
    right: ClassVar[float]  # of choices that an answer found right; NaN if the answer alone gives no value
    right_at_last: ClassVar[float]  # of the same in the last segment of a rollout
    discount: ClassVar[float | None] = None  # per segment, of a value that no answer gave; None ignores such segments

    def __init__(self, share: float, seed: int) -> None:
        self._share, self._seed = share, seed
        self.memory: dict[Level, Dataset] = {level: Dataset((N_FEATURES,)) for level in ("hi", "lo")}
        self._values: dict[Level, Value] = {}

    def learn(self, judged: Mapping[Level, Sequence[Row]]) -> None:
        """Remember a rollout, as `Doubts.judged` returns it."""
        for level, rows in judged.items():
            self.memory[level].append(rows)
            self._values.pop(level, None)

    def doubts(self, seen: Seen) -> Doubts:
        """Return what the gate doubts in a rollout."""
        return Doubts(self._doubted("hi", seen["hi"]), self._doubted("lo", seen["lo"]), seen)

    def _doubted(self, level: Level, features: NDArray[np.float32]) -> list[bool]:
        n = len(self.memory[level])
        if n < _FIRST:
            return [True] * len(features)
        recent, _ = self.memory[level][range(max(0, n - _RECENT), n)]
        value = self._value(level)
        before, now = (self.measures(one, value).numpy() for one in (recent, torch.from_numpy(features)))
        return self.above(now, np.quantile(before, 1 - self._share / len(now), axis=1))

    def _value(self, level: Level) -> Value:
        if level not in self._values:
            n = len(self.memory[level])
            features, labels = self.memory[level][range(max(0, n - _MOST), n)]
            answers, last = labels[:, 0], labels[:, 1] == 1
            known = torch.full(answers.shape, torch.nan)
            known[answers == _WRONG] = self.wrong
            known[answers == _RIGHT] = self.right
            known[(answers == _RIGHT) & last] = self.right_at_last
            self._values[level] = Value(
                features, known, last, (self.wrong, self.right_at_last), self.discount, self._seed
            )
        return self._values[level]

    @abstractmethod
    def measures(self, features: torch.Tensor, value: Value) -> torch.Tensor:
        """Return measures of doubt float32[m, n] of n segments, given their features float32[n, N_FEATURES].

        A segment is doubted where any of the m measures is above its threshold. The share is divided among them.
        """

    def above(self, measures: NDArray[np.float32], thresholds: NDArray[np.float32]) -> list[bool]:
        """Return which segments of one rollout are doubted, given measures float32[m, n] and thresholds float32[m]."""
        return [bool(np.any(each > thresholds)) for each in measures.T]
