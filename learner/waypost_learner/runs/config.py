"""Defines the configuration of a run, and its progress.

With the answers to its queries, a configuration determines every query and every weight of a run.
"""

from collections.abc import Mapping
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
    environments: int | None = None  # that step together in training rollouts; 1 if None
    test_every: int | None = None  # episodes from one test to the next; the number that the domain declares if None
    told: str | None = None  # the level of what the learner is told of the domain; what the preset uses if None
    values: str | None = None  # values that replace the preset's: "relabeling=false train_hi.batch=32"


def config_values(config: TrainConfig) -> dict[str, Any]:
    """Return a configuration as a run stores it: its fields by name, except fields that are None."""
    return {key: value for key, value in asdict(config).items() if value is not None}


NOT_PROVIDED = "not_provided"
"""The name in a run's configuration under which it keeps what was used instead of missing parts of the domain."""


def settings_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the part of a run's configuration that `config_values` wrote: without what was used instead of parts."""
    return {name: value for name, value in values.items() if name != NOT_PROVIDED}


def config_of(values: Mapping[str, Any]) -> TrainConfig:
    """Return the configuration that a run stores.

    Raises:
        TypeError: the values are no configuration of `waypost train`.
    """
    return TrainConfig(**settings_of(values))


@dataclass(frozen=True)
class Progress:
    """The progress of a run between two episodes."""

    episodes: int = 0  # the number of applied episodes
    draws: int = 0  # the number of drawn training instances; with `redraw`, more than episodes
    passes: int = 0  # the number of whole-episode inspections that passed in a row


START = Progress()
"""The progress of a new run."""
