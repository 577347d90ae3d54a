"""Implements the expert of the authors' experiments: it plans for slips, although the maze has none.

It assumes that a move succeeds with probability 0.8, and otherwise goes to one of the two sides. So its ways keep clear
of lava where that costs little. docs/paper.md, deviation 29, says what this changes.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.maze import ACTIONS, GO_TO_TARGET, MOVES, SUBGOALS, Cell, Maze, cell_of
from waypost_learner.domains.maze.oracle import MAZES_CACHED, MazeOracle

_SUCCEEDS, _TO_A_SIDE = 0.8, 0.1
_SIDES = {0: (2, 3), 1: (2, 3), 2: (0, 1), 3: (0, 1)}  # the two actions at right angles to each action
_DISCOUNT = 0.99  # the authors' value is not known; without a discount no way would be too long
_EXACT = 1e-9  # values that differ by less are equal

Field = NDArray[np.float64]


class _Slips:
    """The values of one maze's cells for an agent that slips, computed on demand and cached by where it wants to go."""

    def __init__(self, maze: Maze) -> None:
        self.maze = maze
        self.to_goal = self._solved({maze.goal: 1.0})
        self.through = lru_cache(maxsize=None)(self._through)

    def _through(self, end_cells: tuple[Cell, ...]) -> tuple[Field, Field]:
        """Return what being in each cell is worth on the way to the target through one of `end_cells`.

        Returns:
            values float64[17, 17], and float64[4, 17, 17] for each action in the cell.
        """
        values = self._solved({cell: self.to_goal[cell] for cell in end_cells})
        return values, _of_actions(values)

    def _solved(self, worth: dict[Cell, float]) -> Field:
        """Return float64[17, 17], the best expected discounted worth of where the agent ends; lava is worth 0."""
        values, before = np.zeros(self.maze.lava.shape), np.ones(self.maze.lava.shape)
        while np.abs(values - before).max() > _EXACT:
            before = values
            values = np.where(self.maze.lava, 0.0, _of_actions(values).max(0))
            for cell, one in worth.items():
                values[cell] = one
        return values


def _of_actions(values: Field) -> Field:
    """Return float64[4, 17, 17], the discounted expected value after each action. The outermost cells are lava."""
    after = np.stack([np.roll(values, (-row, -column), (0, 1)) for row, column in MOVES])
    slipped = [_SUCCEEDS * after[a] + _TO_A_SIDE * (after[one] + after[other]) for a, (one, other) in _SIDES.items()]
    return _DISCOUNT * np.stack(slipped)


class SlipOracle(MazeOracle):
    """The maze's expert (`waypost.domains.Oracle`) that plans for slips."""

    def __init__(self) -> None:
        super().__init__()
        self._slips = lru_cache(maxsize=MAZES_CACHED)(_Slips)

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[int]:
        """Return mu*(s): every subgoal through which the target is reached with the highest expected worth."""
        paths, here = self._paths_of(instance), cell_of(state)
        slips, worth = self._slips(paths.maze), dict[int, float]()
        for subgoal in range(len(SUBGOALS)):
            if end_cells := paths.end_cells(here, subgoal):
                worth[subgoal] = slips.through(tuple(end_cells))[0][here]
        best = max(worth.values(), default=0.0)
        good = [subgoal for subgoal, one in worth.items() if best > 0 and one >= best - _EXACT]
        return [GO_TO_TARGET] if GO_TO_TARGET in good else good

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Sequence[int]:
        """Return pi*_g(s): every action with the highest expected worth toward the subgoal chosen at `origin`."""
        paths, here = self._paths_of(instance), cell_of(state)
        end_cells = paths.end_cells(cell_of(origin), subgoal)
        if not end_cells or paths.maze.lava[here]:
            return []
        worth = self._slips(paths.maze).through(tuple(end_cells))[1][:, here[0], here[1]]
        good = [a for a in range(len(ACTIONS)) if worth.max() > 0 and worth[a] >= worth.max() - _EXACT]
        return sorted(good, key=lambda action: action // 2 == subgoal // 2)


class SlipExpertMazeDomain(MazeDomain):
    """The maze, with the expert that plans for slips. Everything else is the same."""

    name = "maze-slip-expert"

    def __init__(self) -> None:
        super().__init__()
        self.oracle = SlipOracle()
