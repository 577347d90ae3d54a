"""Defines the maze navigation domain of the paper (section 6.1)."""

from pathlib import Path
from typing import Any

from waypost.domains import Horizons, InstanceSets
from waypost.trajectory import Outcome, Subgoal
from waypost_learner.domains.maze.env import MAX_STEPS, MazeEnv
from waypost_learner.domains.maze.files import load_mazes
from waypost_learner.domains.maze.generator import KINDS, maze_set, with_doors_redrawn
from waypost_learner.domains.maze.maze import (
    ACTIONS,
    GO_TO_TARGET,
    ROOMS,
    SIZE,
    SUBGOALS,
    Maze,
    cell_of,
    room_beside,
    room_of,
)
from waypost_learner.domains.maze.oracle import MazeOracle
from waypost_learner.domains.maze.relabeling import relabeled, relabeled_actions, retraced
from waypost_learner.domains.maze.symmetries import symmetries
from waypost_learner.domains.maze.views import CENTERED_VIEW, CROP_VIEW, FLAT_GRID, FLAT_VIEW, HI_VIEW, LO_VIEW


class MazeDomain:
    """The maze as a `waypost.domains.Domain` with every optional part except pictures (`waypost.domains.parts`).

    A subgoal leads to the next room in a direction, or to the target.
    """

    name = "maze"
    subgoals = SUBGOALS
    actions = ACTIONS
    renderer = "maze"
    horizons = Horizons(lo=10, hi=ROOMS**2, full=MAX_STEPS)  # a shortest path enters every room at most once
    observation_shape = (3, SIZE, SIZE)
    symmetries = symmetries()
    hi_view, lo_view, flat_view = HI_VIEW, LO_VIEW, FLAT_VIEW
    centered_view, crop_view, flat_grid = CENTERED_VIEW, CROP_VIEW, FLAT_GRID
    relabeled = staticmethod(relabeled)
    relabeled_actions = staticmethod(relabeled_actions)
    retraced = staticmethod(retraced)

    def __init__(self) -> None:
        self.oracle = MazeOracle()

    def make_env(self) -> MazeEnv:
        """Return a new maze environment."""
        return MazeEnv()

    def instances(self, name: str) -> InstanceSets:
        """Return a set of mazes: `random`, `corners` (1,000 training and 1,000 test mazes each), or an `.npz` file.

        `random:1` has mazes of the same kind, drawn with seed 1 instead of 0; so has every other number. The mazes of
        a file are used for training and for testing.

        Raises:
            ValueError: the name is unknown, or the file is not a valid maze set.
        """
        kind, _, seed = name.partition(":")
        if kind in KINDS and (seed.isdecimal() or name == kind):
            return InstanceSets(*maze_set(kind, int(seed or 0)), vary=with_doors_redrawn if kind == "corners" else None)
        if not name.endswith(".npz"):
            raise ValueError(
                f"the maze has no instances {name!r}; use {', '.join(KINDS)}, one of them with the seed of the draw, "
                "such as random:1, or an .npz file"
            )
        mazes = load_mazes(Path(name))
        return InstanceSets(train=mazes, test=mazes)

    def instance_view(self, instance: Maze) -> Any:
        """Return the rows as text, the start and the goal."""
        return instance.to_json()

    def state_view(self, env: Any) -> Any:
        """Return the agent's cell, [row, column]."""
        return list(env.unwrapped.cell)

    def place(self, state: Any) -> Any:
        """Return the agent's room; if the agent is in a door, the cell of the door."""
        cell = cell_of(state)
        return room_of(cell) or cell

    def succeeded(self, env: Any) -> bool:
        """Return whether the agent is on the target."""
        return bool(env.unwrapped.cell == env.unwrapped.maze.goal)

    def outcome(self, instance: Maze, origin: Any, state: Any, subgoal: Subgoal) -> Outcome | None:
        """Return "reached" in the subgoal's room or on its target, "failed" in lava or in another room, else None.

        "A pseudo-reward of 1 for [...] stepping through the correct door and negative reward for stepping into lava
        or through other doors" (section 6.1). As in a demonstration, a step through a door is complete only in the
        room behind the door.
        """
        here, began = cell_of(state), room_of(cell_of(origin))
        if instance.lava[here]:
            return "failed"
        if subgoal == GO_TO_TARGET and here == instance.goal and began == room_of(here):
            return "reached"
        if room_of(here) in (None, began):
            return None
        wanted = None if subgoal == GO_TO_TARGET else room_beside(cell_of(origin), subgoal)
        return "reached" if room_of(here) == wanted else "failed"
