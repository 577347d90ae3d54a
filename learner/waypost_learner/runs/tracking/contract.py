"""Defines what a logger is, and what it records: the run, one row per episode, and the summary at the end."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from waypost import wire

TRAILING = 100  # tests of the success rate, or fewer at the start of a run


@dataclass(frozen=True)
class TrackedRun:
    """The run that a logger records."""

    id: str  # of the Waypost run
    name: str
    config: Mapping[str, Any]
    folder: Path  # of its checkpoints; loggers write local files here
    first: int = 0  # the first episode of this process
    reported: int = 0  # the number of episodes that earlier processes reported; at least `first`
    page: str | None = None  # the run's address in the web app, if a server has it


@dataclass(frozen=True)
class Row:
    """The values of one episode, by name. `expert/total_units` is the cost of the run up to and including it."""

    episode: int
    values: Mapping[str, float]


class Logger(Protocol):
    """Records one run. A logger that is opened for a resumed run continues its record, and repeats no episode."""

    url: str | None
    """Where a person can see the record; None if it has no address."""

    def write(self, rows: Sequence[Row]) -> None:
        """Record the values of episodes, in order. A row that is on record already changes nothing."""
        ...

    def close(self, summary: Mapping[str, Any] | None) -> None:
        """Record the summary of a run that is finished, None for one that was interrupted; then close the record."""
        ...


class Rows:
    """Makes the row of each episode. It keeps the sums of the run.

    Args:
        tests: the results of the test rollouts before the first episode.
        units: the cost of the run before the first episode.
    """

    def __init__(self, tests: Sequence[bool] = (), units: float = 0.0) -> None:
        self._tests = list(tests)[-TRAILING:]
        self._units = units

    def row(self, result: wire.EpisodeResult, units: float) -> Row:
        """Return the row of an episode whose answers cost `units`."""
        if result.test_success is not None:
            self._tests = [*self._tests, result.test_success][-TRAILING:]
        self._units += units
        values = {
            "expert/units": units,
            "expert/total_units": self._units,
            "labels/hi": result.hi_labels,
            "labels/lo": result.lo_labels,
            "steps/train": result.train_steps,
            "steps/test": result.test_steps,
            "seconds": result.seconds,
        }
        if self._tests:
            values["success/test"] = sum(self._tests) / len(self._tests)
        if result.train_success is not None:
            values["success/train"] = float(result.train_success)
        return Row(result.episode, values)


def rows_after(curves: wire.Curves, first: int) -> Rows:
    """Return the `Rows` of a run that continues at its episode `first`.

    Args:
        curves: the curves of the run. They can include episodes after `first`, which the run repeats.
        first: the first episode of this process.
    """
    before = [place for place, episode in enumerate(curves.episode) if episode < first]
    tests = [curves.test_success[place] for place in before]
    return Rows([passed for passed in tests if passed is not None], curves.cost[before[-1]] if before else 0.0)
