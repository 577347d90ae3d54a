"""Defines which runs each figure needs. `waypost sweep` trains them and `waypost figures` draws them.

The plan contains only configurations, so drawing figures does not import any algorithm.
"""

from collections.abc import Sequence
from itertools import zip_longest

from waypost_learner.experiments.plan.lean import LEAN
from waypost_learner.experiments.plan.maze import MAZE
from waypost_learner.experiments.plan.montezuma import MONTEZUMA
from waypost_learner.experiments.plan.options import OPTIONS
from waypost_learner.experiments.plan.series import Group
from waypost_learner.runs.config import TrainConfig

GROUPS = {group.name: group for group in (*MAZE, *OPTIONS, *LEAN, *MONTEZUMA)}
"""Every group by its name."""

FIGURES = {
    "maze": tuple(group.name for group in (*MAZE, *OPTIONS)),
    "options": tuple(group.name for group in OPTIONS),
    "lean": tuple(group.name for group in LEAN),
    "montezuma": tuple(group.name for group in MONTEZUMA),
    **{name: (name,) for name in GROUPS},
}
"""The groups of every value of `--figure`: `maze` and `montezuma` (the paper), a part of them, or `lean`."""


def find_figure(name: str) -> list[Group]:
    """Return the groups of a figure.

    Raises:
        ValueError: no figure has this name; the message lists the names.
    """
    if name not in FIGURES:
        raise ValueError(f"there is no figure {name!r}; the figures are: {', '.join(FIGURES)}")
    return [GROUPS[group] for group in FIGURES[name]]


def runs_of(groups: Sequence[Group], seeds: Sequence[int]) -> list[TrainConfig]:
    """Return every run of the groups once, ordered by seed: first the runs of all series with the first seed."""
    runs = [each.runs(seeds) for group in groups for each in group.series]
    return list(dict.fromkeys(run for nth in zip_longest(*runs) for run in nth if run is not None))


def name_of(config: TrainConfig) -> str:
    """Return a readable name of a run, which no other run of the plan has."""
    return f"{name_without_seed(config)}, seed {config.seed}"


def name_without_seed(config: TrainConfig) -> str:
    """Return a readable name of a run and of its runs with other seeds."""
    return ", ".join(
        [
            config.algorithm,
            *([] if config.domain == "maze" else [config.domain.rpartition(":")[2]]),
            config.instances,
            *(["redraw"] if config.redraw else []),
            *([] if config.head_start is None else [f"head start {config.head_start:.0%}"]),
            *([] if config.preset == "paper" else [config.preset]),
            *([] if config.warm_start is None else [f"warm start {config.warm_start}"]),
            *([] if config.values is None else [config.values]),
        ]
    )
