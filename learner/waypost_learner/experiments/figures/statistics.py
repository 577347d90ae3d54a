"""Computes medians and ranges over runs, and values of runs as step functions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from waypost_learner.experiments.figures.data import Column

TRAILING = 100  # tests in a success rate
POINTS = 201  # points of a drawn curve


@dataclass(frozen=True)
class Spread:
    """The median, minimum and maximum of a value over runs. A run that never reached it counts as infinite."""

    median: float
    low: float
    high: float
    runs: int


@dataclass(frozen=True, eq=False)
class Track:
    """One run's values as a step function: y equals `y[i]` from `x[i]` on. Both are float64[n]; x does not decrease.

    If the run is `over`, it keeps its last value forever, because it spends nothing more. If not, its values after the
    last row are unknown.
    """

    x: Column
    y: Column
    over: bool

    def at(self, grid: Column) -> Column:
        """Return the values at the grid points; nan where they are unknown."""
        place = np.searchsorted(self.x, grid, side="right") - 1
        known = (place >= 0) & (self.over | (grid <= self.x[-1]))
        return np.where(known, self.y[place], np.nan)


@dataclass(frozen=True, eq=False)
class Band:
    """The median, quartiles and range over runs at grid points; every array is float64[points]."""

    x: Column
    low: Column
    lower_quartile: Column
    median: Column
    upper_quartile: Column
    high: Column


def spread(values: Sequence[float]) -> Spread | None:
    """Return the spread of the known (not nan) values, or None if no value is known."""
    known = [value for value in values if not np.isnan(value)]
    if not known:
        return None
    return Spread(float(np.median(known)), min(known), max(known), len(known))


def band(tracks: Sequence[Track], points: int = POINTS) -> Band | None:
    """Return the median, quartiles and range of runs as functions of x, or None if no run has values.

    Runs have different values of x, so each run is evaluated as a step function on a common grid. The grid starts where
    all runs have values, and ends at the median of the runs' last x. It has more points where the runs have more rows,
    so a steep rise is drawn exactly. A complete run keeps its last value; an unfinished run is excluded after its end.
    """
    begun = [Track(t.x[known], t.y[known], t.over) for t in tracks if (known := ~np.isnan(t.y)).any()]
    if not begun:
        return None
    start = max(track.x[0] for track in begun)
    end = max(start, np.median([track.x[-1] for track in begun]))
    rows = np.concatenate([track.x for track in begun]).clip(start, end)
    grid = np.unique([start, *np.quantile(rows, np.linspace(0, 1, points), method="nearest"), end])
    values = np.array([track.at(grid) for track in begun])  # [runs, points]
    grid, values = grid[known := ~np.isnan(values).all(axis=0)], values[:, known]
    return Band(grid, *np.nanquantile(values, (0, 0.25, 0.5, 0.75, 1), axis=0))


def first_at(level: float, test_success: Column, success_rate: Column) -> int | None:
    """Return the first row where the success rate over a full 100 tests is at least `level`, or None."""
    full = np.cumsum(~np.isnan(test_success)) >= TRAILING
    reached = np.flatnonzero(full & (success_rate >= level))
    return int(reached[0]) if len(reached) else None
