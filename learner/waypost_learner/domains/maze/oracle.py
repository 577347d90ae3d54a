"""Implements the maze's expert: it derives subgoals, actions and terminations from shortest paths.

All answers depend only on the JSON views, so the oracle in the learner's process and the oracle bot give the same
answers. If several choices are equally good, the oracle returns all of them in a fixed order, the preferred one first.
Within a room, an action parallel to the subgoal's wall comes before an action toward the wall. This rule is symmetric:
it also holds in rotated and mirrored mazes.
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


class _Paths:
    """The shortest paths of one maze, computed on demand and cached by their end."""

    def __init__(self, maze: Maze) -> None:
        self.maze = maze
        self._distances: dict[Cell, NDArray[np.int16]] = {}

    def distances_to(self, cell: Cell) -> NDArray[np.int16]:
        """Return int16[17, 17], the number of steps from each cell to `cell`. Every move can be reversed."""
        if cell not in self._distances:
            self._distances[cell] = distances_from(self.maze.lava, cell)
        return self._distances[cell]

    def end_cells(self, origin: Cell, subgoal: int) -> list[Cell]:
        """Return the cells where a subgoal chosen at `origin` can end; [] if the subgoal is not valid there.

        For a direction, these are the first cells behind the doors of this wall. Maze files can have several doors
        per wall.
        """
        goal, lava = self.maze.goal, self.maze.lava
        if subgoal == GO_TO_TARGET:
            return [goal] if room_of(origin) == room_of(goal) else []
        doors = [door for door in wall_beside(origin, subgoal) if not lava[door]]
        return [cell for cell in (moved(door, subgoal) for door in doors) if not lava[cell]]

    def distances_through(self, end_cells: list[Cell]) -> NDArray[np.int16]:
        """Return int16[17, 17], the shortest path from each cell to the target through one of `end_cells`, in steps.

        Lava has the distance `FAR`.
        """
        to_goal = self.distances_to(self.maze.goal)
        lengths = [self.distances_to(end) + to_goal[end] for end in end_cells]
        return np.where(self.maze.lava, FAR, np.min(lengths, axis=0))


class MazeOracle:
    """The maze's expert (`waypost.domains.Oracle`)."""

    def __init__(self) -> None:
        self._cached = lru_cache(maxsize=MAZES_CACHED)(
            lambda rows, start, goal: _Paths(Maze.from_json({"rows": rows, "start": start, "goal": goal}))
        )

    def _paths_of(self, instance: Any) -> _Paths:
        return self._cached(tuple(instance["rows"]), tuple(instance["start"]), tuple(instance["goal"]))

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[int]:
        """Return mu*(s): every subgoal on a shortest path to the target."""
        paths, here = self._paths_of(instance), cell_of(state)
        shortest = paths.distances_to(paths.maze.goal)[here]
        good = []
        for subgoal in range(len(SUBGOALS)):
            end_cells = paths.end_cells(here, subgoal)
            if end_cells and paths.distances_through(end_cells)[here] == shortest:
                good.append(subgoal)
        # In the target's room, the only good subgoal is the target.
        return [GO_TO_TARGET] if GO_TO_TARGET in good else good

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Sequence[int]:
        """Return pi*_g(s): every action on a shortest path through an end cell of the subgoal chosen at `origin`."""
        paths, here = self._paths_of(instance), cell_of(state)
        end_cells = paths.end_cells(cell_of(origin), subgoal)
        if not end_cells or paths.maze.lava[here]:
            return []
        distances = paths.distances_through(end_cells)
        good = [action for action in range(len(ACTIONS)) if distances[moved(here, action)] < distances[here]]
        return sorted(good, key=lambda action: action // 2 == subgoal // 2)

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: int) -> bool:
        """Return beta*_g(s): whether the subgoal chosen at `origin` is accomplished in `state`."""
        paths, here = self._paths_of(instance), cell_of(state)
        end_cells = paths.end_cells(cell_of(origin), subgoal)
        if not end_cells:
            return False
        return here == end_cells[0] if subgoal == GO_TO_TARGET else room_of(here) == room_of(end_cells[0])

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the task is accomplished in `state`."""
        return cell_of(state) == self._paths_of(instance).maze.goal

    def successor(self, instance: Any, state: Any, action: int) -> Any:
        """Return the state after an action. Demonstrations use this function."""
        del instance
        return list(moved(cell_of(state), action))
