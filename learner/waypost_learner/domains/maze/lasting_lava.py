"""Defines the maze of the authors' experiments, in which lava does not end an episode.

A step into lava costs 0.01. From there the agent can only step back onto a cell that it has visited; every other move
leaves it where it is. docs/paper.md, deviation 30, says what this changes.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost.trajectory import Outcome, Subgoal
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import MAX_STEPS, TRAIL, MazeEnv, Observation
from waypost_learner.domains.maze.maze import ACTIONS, Cell, Maze, cell_of, distances_from, moved
from waypost_learner.domains.maze.oracle import MazeOracle

LAVA_COST = 0.01


class LastingLavaMazeEnv(MazeEnv):
    """The maze environment, but lava holds the agent instead of ending the episode."""

    def step(self, action: np.int64) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Move the agent one cell, unless it is in lava and has not visited that cell.

        Raises:
            RuntimeError: `reset` was never called.
        """
        if self.maze is not None and self.maze.lava[self.cell] and moved(self.cell, int(action)) not in self.exits:
            self.steps += 1
        else:
            super().step(action)
        assert self.maze is not None
        arrived, burnt = self.cell == self.maze.goal, bool(self.maze.lava[self.cell])
        reward = 1.0 if arrived else -LAVA_COST if burnt else 0.0
        return self._pixels.copy(), reward, arrived, not arrived and self.steps >= MAX_STEPS, {}

    @property
    def exits(self) -> list[Cell]:
        """The visited cells beside the agent, onto which it can step out of lava."""
        trail = {(int(row), int(column)) for row, column in np.argwhere(self._pixels[1] == TRAIL)}
        return [cell for cell in (moved(self.cell, action) for action in range(len(ACTIONS))) if cell in trail]


class LastingLavaOracle(MazeOracle):
    """The maze's expert (`waypost.domains.Oracle`), which also says how to leave lava.

    In lava it says what is right in the exit from which the way is shortest, and how to step there.
    """

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[int]:
        """Return mu*(s): every subgoal on a shortest path to the target."""
        return super().good_subgoals(instance, self._standing(instance, state))

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Sequence[int]:
        """Return pi*_g(s): every action on a shortest path through an end cell of the subgoal chosen at `origin`."""
        paths, origin = self._paths_of(instance), self._standing(instance, origin)
        if not paths.maze.lava[cell_of(state)]:
            return super().good_actions(instance, origin, state, subgoal)
        end_cells = paths.end_cells(origin, subgoal)
        if not end_cells:
            return []
        distances, here = paths.distances_through(end_cells), cell_of(state)
        exits = {cell_of(one) for one in state[2]}
        return [
            action
            for action in range(len(ACTIONS))
            if moved(here, action) in exits and distances[moved(here, action)] == min(map(distances.item, exits))
        ]

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: int) -> bool:
        """Return beta*_g(s): whether the subgoal chosen at `origin` is accomplished in `state`."""
        return super().reached(instance, self._standing(instance, origin), state, subgoal)

    def _standing(self, instance: Any, state: Any) -> Cell:
        paths = self._paths_of(instance)
        return _standing(paths.maze, paths.distances_to(paths.maze.goal), state)


class LastingLavaMazeDomain(MazeDomain):
    """The maze in which lava does not end an episode. In lava, a state's view also has the cells that can be reached.

    A Q-function's subgoal still fails in lava.
    """

    name = "maze-lasting-lava"

    def __init__(self) -> None:
        self.oracle = LastingLavaOracle()

    def make_env(self) -> LastingLavaMazeEnv:
        """Return a new maze environment."""
        return LastingLavaMazeEnv()

    def state_view(self, env: Any) -> Any:
        """Return the agent's cell, [row, column]; in lava, [row, column, [exit, ...]]."""
        env, cell = env.unwrapped, super().state_view(env)
        return [*cell, [list(one) for one in env.exits]] if env.maze.lava[env.cell] else cell

    def outcome(self, instance: Maze, origin: Any, state: Any, subgoal: Subgoal) -> Outcome | None:
        """Return "reached" in the subgoal's room or on its target, "failed" in lava or in another room, else None."""
        began = _standing(instance, distances_from(instance.lava, instance.goal), origin)
        return super().outcome(instance, began, state, subgoal)


def _standing(maze: Maze, to_goal: NDArray[np.int16], state: Any) -> Cell:
    """Return a state's cell; in lava, the exit from which the way to the target is shortest."""
    return min(map(cell_of, state[2]), key=to_goal.item) if maze.lava[cell_of(state)] else cell_of(state)
