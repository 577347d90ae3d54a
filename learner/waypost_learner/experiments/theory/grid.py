"""Simulates both learners in a grid of cells with several seeds, and compares their costs with the bounds."""

import csv
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, get_args

from waypost import wire
from waypost_learner.experiments.theory.bounds import operation_costs, proportion, ratio_of_bounds
from waypost_learner.experiments.theory.classes import Cell
from waypost_learner.experiments.theory.simulation import Episodes, Result, simulate

_HORIZONS = ((2, 2), (2, 8), (8, 2), (4, 4), (8, 8), (16, 16))  # H_HI, H_LO
_CLASSES = ((16, 16, 4), (256, 4, 4), (256, 16, 2), (256, 16, 4))  # |M|, |Pi_LO|, |G|

GRID = tuple(Cell(*horizons, *sizes) for horizons in _HORIZONS for sizes in _CLASSES)
EPISODES: tuple[Episodes, ...] = get_args(Episodes)


@dataclass(frozen=True)
class Side:
    """The result of one learner in one cell: means over seeds in units, except `worst`."""

    cost: float  # after T rounds
    bound: float
    learning: float  # the cost without T C_I^full
    learning_bound: float  # the bound without T C_I^full
    worst: float  # the maximum over seeds of learning cost / learning bound


@dataclass(frozen=True)
class Row:
    """The results of both learners in one cell with one kind of episodes."""

    cell: Cell
    episodes: Episodes
    hg: Side
    flat: Side
    ratio: float | None  # learning cost of hg-DAgger / of flat DAgger; None if that of flat DAgger is 0
    ratio_of_bounds: float
    proportion: float  # (H_HI + H_LO) / (H_HI H_LO)

    def values(self) -> dict[str, Any]:
        """Return all values as a flat dictionary, for CSV and JSON."""
        sides = {
            f"{name}_{key}": value for name in ("hg", "flat") for key, value in asdict(getattr(self, name)).items()
        }
        rest = {"ratio": self.ratio, "ratio_of_bounds": self.ratio_of_bounds, "proportion": self.proportion}
        return {**asdict(self.cell), "episodes": self.episodes, **sides, **rest}


def measure(cells: Sequence[Cell], seeds: int, rounds: int, done: Callable[[], None] = lambda: None) -> list[Row]:
    """Simulate every cell with both kinds of episodes and the seeds 0, 1, ...; call `done` after each row."""
    rows = []
    for episodes in EPISODES:
        for cell in cells:
            hg, flat = (
                _side([simulate(cell, seed, rounds, is_flat, episodes) for seed in range(seeds)])
                for is_flat in (False, True)
            )
            ratio = hg.learning / flat.learning if flat.learning else None
            of_bounds = ratio_of_bounds(cell, operation_costs(cell, wire.Prices()))
            rows.append(Row(cell, episodes, hg, flat, ratio, of_bounds, proportion(cell)))
            done()
    return rows


def write_csv(rows: Sequence[Row], path: Path) -> None:
    """Write a CSV file with one line per row."""
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0].values()), lineterminator="\n")
        writer.writeheader()
        writer.writerows(row.values() for row in rows)


def worst(rows: Sequence[Row]) -> dict[str, float]:
    """Return the maximum of learning cost / learning bound over all rows and seeds, for "hg" and "flat"."""
    return {"hg": max(row.hg.worst for row in rows), "flat": max(row.flat.worst for row in rows)}


def _side(results: Sequence[Result]) -> Side:
    def mean(values: Sequence[float]) -> float:
        return sum(values) / len(values)

    return Side(
        cost=mean([result.spent.total for result in results]),
        bound=mean([result.bound.total for result in results]),
        learning=mean([result.spent.learning for result in results]),
        learning_bound=mean([result.bound.learning for result in results]),
        worst=max(result.spent.learning / result.bound.learning for result in results),
    )
