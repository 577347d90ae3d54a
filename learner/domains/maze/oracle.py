"""The maze's expert: all-pairs shortest paths, and what they say of subgoals, actions and terminations.

Everything is answered from the JSON views, so the oracle in process and the oracle bot at the far end of a queue are
one. Where several choices are as good, all are returned, best first; the order is fixed, and within a room an action
along the wall comes before the one through the door, a rule that turns with the picture.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from learner.domains.maze.maze import (
    ACTIONS,
    GO_TO_TARGET,
    SUBGOALS,
    Cell,
    Maze,
    cell_of,
    distances_from,
    moved,
    room_of,
)

MAZES_CACHED = 64


class _Solved:
    """A maze with the distances to the cells that have been asked about."""

    def __init__(self, maze: Maze) -> None:
        self.maze = maze
        self._distances: dict[Cell, NDArray[np.int16]] = {}

    def distances_to(self, cell: Cell) -> NDArray[np.int16]:
        """Return int16[17, 17]; moves can be undone, so the distance from a cell is the distance to it."""
        if cell not in self._distances:
            self._distances[cell] = distances_from(self.maze.lava, cell)
        return self._distances[cell]

    def entry(self, origin: Cell, subgoal: int) -> Cell | None:
        """Return the first cell beyond the door on the subgoal's side of `origin`, None if there is no such door."""
        if room_of(origin) is None:  # On a door: the rooms on its two sides, and nothing else, can be entered.
            beyond = moved(origin, subgoal)
            return None if self.maze.lava[origin] or self.maze.lava[beyond] else beyond
        row, column = (4 * (line // 4) for line in origin)
        sides = {
            0: [(row, column + k) for k in (1, 2, 3)],
            1: [(row + 4, column + k) for k in (1, 2, 3)],
            2: [(row + k, column) for k in (1, 2, 3)],
            3: [(row + k, column + 4) for k in (1, 2, 3)],
        }
        doors = [cell for cell in sides[subgoal] if not self.maze.lava[cell]]
        if not doors:
            return None
        # Maze files may have two doors in one wall: take the one on the shorter way to the target.
        to_goal = self.distances_to(self.maze.goal)
        door = min(doors, key=lambda cell: int(self.distances_to(cell)[origin] + to_goal[cell]))
        return moved(door, subgoal)

    def aim(self, origin: Cell, subgoal: int) -> Cell | None:
        """Return the cell that a subgoal chosen at `origin` leads to, None where the subgoal is not valid."""
        if subgoal == GO_TO_TARGET:
            goal_room = room_of(self.maze.goal)
            return self.maze.goal if room_of(origin) == goal_room else None
        return self.entry(origin, subgoal)


class MazeOracle:
    """Good subgoals, good actions and terminations in a maze."""

    def __init__(self) -> None:
        self._solved = lru_cache(maxsize=MAZES_CACHED)(
            lambda rows, start, goal: _Solved(Maze.from_json({"rows": rows, "start": start, "goal": goal}))
        )

    def _maze(self, instance: Any) -> _Solved:
        return self._solved(tuple(instance["rows"]), tuple(instance["start"]), tuple(instance["goal"]))

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[int]:
        """Return mu*(s): every subgoal on a shortest path to the target."""
        solved, here = self._maze(instance), cell_of(state)
        to_goal = solved.distances_to(solved.maze.goal)
        good = []
        for subgoal in range(len(SUBGOALS)):
            aim = solved.aim(here, subgoal)
            if aim is not None and solved.distances_to(aim)[here] + to_goal[aim] == to_goal[here]:
                good.append(subgoal)
        # In the target's room only the target itself is left to do.
        return [GO_TO_TARGET] if GO_TO_TARGET in good else good

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Sequence[int]:
        """Return pi*_g(s): every action that brings the aim of the subgoal, chosen at `origin`, nearer."""
        solved, here = self._maze(instance), cell_of(state)
        aim = solved.aim(cell_of(origin), subgoal)
        if aim is None or solved.maze.lava[here]:
            return []
        to_aim = solved.distances_to(aim)
        good = [a for a in range(len(ACTIONS)) if 0 <= to_aim[moved(here, a)] < to_aim[here]]
        return sorted(good, key=lambda action: action // 2 == subgoal // 2)

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: int) -> bool:
        """Return beta*_g(s): is the subgoal, chosen at `origin`, accomplished in `state`?"""
        solved, start, here = self._maze(instance), cell_of(origin), cell_of(state)
        aim = solved.aim(start, subgoal)
        if aim is None:
            return False
        return here == aim if subgoal == GO_TO_TARGET else room_of(here) == room_of(aim)

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the task is accomplished in `state`."""
        return cell_of(state) == self._maze(instance).maze.goal

    def successor(self, instance: Any, state: Any, action: int) -> Any:
        """Return the state after an action; demonstrations are built with it."""
        del instance
        return list(moved(cell_of(state), action))
