"""Reads the curves of runs from a store or from a server, and finds runs by their configuration."""

from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from typing import Protocol

from waypost import wire
from waypost.client import Client
from waypost_learner.experiments.figures.data import RunCurves
from waypost_learner.runs.config import TrainConfig, config_of


class Source(Protocol):
    """A source of runs and their curves."""

    def runs(self) -> list[wire.Run]:
        """Return the runs, newest first."""

    def curves(self, run: str) -> wire.Curves:
        """Return the success and the cost of a run by episode."""


@contextmanager
def served(server: str, token: str) -> Iterator[Source]:
    """Open a client of a server."""
    with closing(Client(server, token)) as client:
        yield client


def read(source: Source, wanted: Sequence[TrainConfig]) -> dict[TrainConfig, RunCurves]:
    """Return the runs with these configurations.

    If several runs have the same configuration, take the one with most episodes; among these, the newest.
    """
    furthest: dict[TrainConfig, wire.Run] = {}
    for run in source.runs():
        config = _config(run)
        if config is None or config not in wanted:
            continue
        if config not in furthest or run.episodes_done > furthest[config].episodes_done:
            furthest[config] = run
    return {
        config: RunCurves.of(config, source.curves(run.id)) for config, run in furthest.items() if run.episodes_done
    }


def _config(run: wire.Run) -> TrainConfig | None:
    """Return the configuration of a run, or None if this version does not know one of its fields."""
    try:
        return config_of(run.config)  # values of wrong types equal no needed configuration
    except TypeError:
        return None
