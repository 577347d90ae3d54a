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

from waypost_learner.domains.maze.maze import (
    ACTIONS,
    GO_TO_TARGET,
    SUBGOALS,
    Cell,
    Maze,
    cell_of,
    distances_from,
    moved,
    room_of,
    wall_beside,
)

MAZES_CACHED = 64
FAR = np.int16(10_000)


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

    def aims(self, origin: Cell, subgoal: int) -> list[Cell]:
        """Return the cells where a subgoal chosen at `origin` can end; none if it is not valid there.

        They are the first cells beyond the doors on its side; maze files may have several doors in one wall.
        """
        goal, lava = self.maze.goal, self.maze.lava
        if subgoal == GO_TO_TARGET:
            return [goal] if room_of(origin) == room_of(goal) else []
        doors = [door for door in wall_beside(origin, subgoal) if not lava[door]]
        return [cell for cell in (moved(door, subgoal) for door in doors) if not lava[cell]]

    def distances_by_way_of(self, aims: list[Cell]) -> NDArray[np.int16]:
        """Return int16[17, 17], the steps from each cell to the target through the best of the aims; lava is far."""
        to_goal = self.distances_to(self.maze.goal)
        ways = [self.distances_to(aim) + to_goal[aim] for aim in aims]
        return np.where(self.maze.lava, FAR, np.min(ways, axis=0))


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
        shortest = solved.distances_to(solved.maze.goal)[here]
        good = []
        for subgoal in range(len(SUBGOALS)):
            aims = solved.aims(here, subgoal)
            if aims and solved.distances_by_way_of(aims)[here] == shortest:
                good.append(subgoal)
        # In the target's room only the target itself is left to do.
        return [GO_TO_TARGET] if GO_TO_TARGET in good else good

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Sequence[int]:
        """Return pi*_g(s): every action that brings the aim of the subgoal, chosen at `origin`, nearer."""
        solved, here = self._maze(instance), cell_of(state)
        aims = solved.aims(cell_of(origin), subgoal)
        if not aims or solved.maze.lava[here]:
            return []
        distances = solved.distances_by_way_of(aims)
        good = [action for action in range(len(ACTIONS)) if distances[moved(here, action)] < distances[here]]
        return sorted(good, key=lambda action: action // 2 == subgoal // 2)

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: int) -> bool:
        """Return beta*_g(s): is the subgoal, chosen at `origin`, accomplished in `state`?"""
        solved, here = self._maze(instance), cell_of(state)
        aims = solved.aims(cell_of(origin), subgoal)
        if not aims:
            return False
        return here == aims[0] if subgoal == GO_TO_TARGET else room_of(here) == room_of(aims[0])

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the task is accomplished in `state`."""
        return cell_of(state) == self._maze(instance).maze.goal

    def successor(self, instance: Any, state: Any, action: int) -> Any:
        """Return the state after an action; demonstrations are built with it."""
        del instance
        return list(moved(cell_of(state), action))
