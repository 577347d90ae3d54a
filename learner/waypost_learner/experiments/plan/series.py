"""Defines what a plan is made of: series of runs, and groups of series that are compared."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from waypost_learner.runs.config import TrainConfig

HONEST = "Episodes: every rollout. Costs: every label and every inspection."
"""How episodes and costs are counted where nothing is left out."""


@dataclass(frozen=True)
class Series:
    """The runs of one curve: one configuration with several seeds."""

    config: TrainConfig  # with any seed: `runs` replaces it
    label: str
    beside: bool = False  # whether it is the reference of its group, drawn in black
    most: int | None = None  # use at most this many of the requested seeds

    def runs(self, seeds: Sequence[int]) -> list[TrainConfig]:
        """Return one configuration per seed."""
        return [replace(self.config, seed=seed) for seed in seeds[: self.most]]


@dataclass(frozen=True)
class Group:
    """Several series that one part of the report compares.

    Args:
        name: the name for `--figure`.
        title: the heading in the report: the mazes and the compared runs.
        counting: how episodes and costs are counted; shown on every figure.
        figures: the figures to draw, by their names in `FIGURES` of `figures/draw.py`.
        series: the curves.
        labels_only: whether costs exclude inspections. The authors' costs do, so only such groups are compared with
            the published numbers.
        hybrid: whether actions are learned by reinforcement. Success is then shown over LO samples instead of cost.
        lean: whether the group compares variants of the preset `lean`. Its tables use fewer episodes, and its cost
            axis is logarithmic.
        tests: the instances of the test episodes.
    """

    name: str
    title: str
    counting: str
    figures: tuple[str, ...]
    series: tuple[Series, ...]
    labels_only: bool = False
    hybrid: bool = False
    lean: bool = False
    tests: str = "unseen mazes"
