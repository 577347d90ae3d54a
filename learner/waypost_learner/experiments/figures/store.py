"""Runs out of a store or from a server, found by what fixes them."""

from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from typing import Protocol

from waypost import wire
from waypost.client import Client
from waypost_learner.experiments.figures.data import RunCurves
from waypost_learner.runs.config import TrainConfig


class Source(Protocol):
    """Where runs and their curves are."""

    def runs(self) -> list[wire.Run]:
        """Return the runs, newest first."""

    def curves(self, run: str) -> wire.Curves:
        """Return success and cost of a run, by episode."""


@contextmanager
def served(server: str, token: str) -> Iterator[Source]:
    """Connect to a server."""
    with closing(Client(server, token)) as client:
        yield client


def read(source: Source, wanted: Sequence[TrainConfig]) -> dict[TrainConfig, RunCurves]:
    """Return the runs of these configurations; of several of one, the newest of those that got furthest."""
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
    """Return what fixes a run, or None if that is nothing this version knows."""
    try:
        return TrainConfig(**run.config)  # type: ignore[arg-type]  # what is no configuration equals none that is wanted
    except TypeError:
        return None
