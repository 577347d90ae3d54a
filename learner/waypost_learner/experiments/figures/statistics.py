"""Medians and ranges over runs, and runs as step functions."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from waypost_learner.experiments.figures.data import Column

TRAILING = 100  # tests a success rate is taken over
POINTS = 201  # of a drawn curve


@dataclass(frozen=True)
class Spread:
    """The median of some runs' values and their range; infinite where a run never got there."""

    median: float
    low: float
    high: float
    runs: int


@dataclass(frozen=True, eq=False)
class Track:
    """One run's values as a step function: `y[i]` holds from `x[i]` on, float64[n] each, x not decreasing.

    Of a run that is `over`, the last value holds for good: with more to spend it would have spent no more. Of one
    that is not, nothing is known beyond its last row.
    """

    x: Column
    y: Column
    over: bool

    def at(self, grid: Column) -> Column:
        """Return the values on a grid, nan where there is none."""
        place = np.searchsorted(self.x, grid, side="right") - 1
        known = (place >= 0) & (self.over | (grid <= self.x[-1]))
        return np.where(known, self.y[place], np.nan)


@dataclass(frozen=True, eq=False)
class Band:
    """Median and range over runs, on a grid; float64[points] each."""

    x: Column
    median: Column
    low: Column
    high: Column


def spread(values: Sequence[float]) -> Spread | None:
    """Return the spread of the values that are known (not nan), or None if there is none."""
    known = [value for value in values if not np.isnan(value)]
    if not known:
        return None
    return Spread(float(np.median(known)), min(known), max(known), len(known))


def band(tracks: Sequence[Track], points: int = POINTS) -> Band | None:
    """Return the median and range of runs against x, or None if they have no values.

    Each run is sampled as a step function on one grid, because runs do not spend the same amounts at the same time.
    The grid begins where all runs have begun and ends at the median of their ends: as far as half of the runs went.
    Its points are as dense as the runs' rows are, so that a success that rises at nearly no cost has them too. A
    complete run that ended before keeps its last value, an unfinished one is left out from its end on.
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
    return Band(grid, np.nanmedian(values, axis=0), np.nanmin(values, axis=0), np.nanmax(values, axis=0))


def first_at(level: float, test_success: Column, success_rate: Column) -> int | None:
    """Return the row at which the success rate over a full hundred of tests first reached a level."""
    full = np.cumsum(~np.isnan(test_success)) >= TRAILING
    reached = np.flatnonzero(full & (success_rate >= level))
    return int(reached[0]) if len(reached) else None
