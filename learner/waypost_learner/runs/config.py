"""Defines the configuration of a run, and its progress.

With the answers to its queries, a configuration determines every query and every weight of a run.
"""

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True)
class TrainConfig:
    """The options of `waypost train` that change what is learned."""

    algorithm: str
    domain: str = "maze"
    instances: str = "random"
    preset: str = "lean"
    seed: int = 0
    episodes: int = 1_000
    in_flight: int = 1  # episodes open at the same time; 1 is the paper's loop
    warm_start: int | None = None  # episodes of demonstrations; the preset's number if None
    redraw: bool = False  # draw instances until the learner fails on one, as the authors count episodes
    head_start: float | None = None  # share of an optimal trajectory that is carried out before the learner begins
    values: str | None = None  # values that replace the preset's: "relabeling=false train_hi.batch=32"


def config_values(config: TrainConfig) -> dict[str, Any]:
    """Return a configuration as a run stores it: its fields by name, except fields that are None."""
    return {key: value for key, value in asdict(config).items() if value is not None}


@dataclass(frozen=True)
class Progress:
    """The progress of a run between two episodes."""

    episodes: int = 0  # the number of applied episodes
    draws: int = 0  # the number of drawn training instances; with `redraw`, more than episodes
    passes: int = 0  # the number of whole-episode inspections that passed in a row


START = Progress()
"""The progress of a new run."""
