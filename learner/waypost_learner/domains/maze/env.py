"""Defines the maze as a gymnasium environment (paper, section 6.1).

The actions up, down, left and right move the agent one cell. A step onto lava ends the episode with reward -1, a step
onto the target ends it with reward 1, and every other step has reward 0. After 100 steps the episode is truncated.

The observation is float32[3, 17, 17], a bird's-eye view with the authors' values: channel 0 is 0.4 at the agent;
channel 1 is 1 in lava and -0.5 on the trail of visited cells; channel 2 is -1 at the target.
"""

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.domains.maze.maze import ACTIONS, SIZE, Maze, moved

MAX_STEPS = 100
AGENT, LAVA, TRAIL, TARGET = 0.4, 1.0, -0.5, -1.0

Observation = NDArray[np.float32]


class MazeEnv(gymnasium.Env[Observation, np.int64]):
    """The maze environment. `reset` starts `options["instance"]`, or else a random maze of `mazes`."""

    metadata = {"render_modes": ["ansi"], "render_fps": 4}  # noqa: RUF012 (gymnasium's own form)

    def __init__(self, mazes: Sequence[Maze] | None = None, render_mode: str | None = None) -> None:
        self.mazes = mazes
        self.render_mode = render_mode
        self.action_space = spaces.Discrete(len(ACTIONS))
        self.observation_space = spaces.Box(-1.0, 1.0, (3, SIZE, SIZE), np.float32)
        self.maze: Maze | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Start `options["instance"]`, or a random maze of the set."""
        super().reset(seed=seed)
        mazes = self.mazes or maze_set("random")[0]
        self.maze = (options or {}).get("instance") or mazes[int(self.np_random.integers(len(mazes)))]
        self.cell = self.maze.start
        self.steps = 0
        self._pixels = np.zeros((3, SIZE, SIZE), np.float32)
        self._pixels[1][self.maze.lava] = LAVA
        self._pixels[2][self.maze.goal] = TARGET
        self._enter(self.maze.start)
        return self._pixels.copy(), {}

    def step(self, action: np.int64) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Move the agent one cell.

        Raises:
            RuntimeError: `reset` was never called.
        """
        if self.maze is None:
            raise RuntimeError("call reset() before the first step()")
        self._pixels[0][self.cell] = 0.0
        self.cell = moved(self.cell, int(action))
        self.steps += 1
        burnt, arrived = bool(self.maze.lava[self.cell]), self.cell == self.maze.goal
        self._enter(self.cell)
        reward = 1.0 if arrived else -1.0 if burnt else 0.0
        ended = burnt or arrived
        return self._pixels.copy(), reward, ended, not ended and self.steps >= MAX_STEPS, {}

    def render(self) -> str | None:
        """Return the maze as text: `#` lava, `*` trail, `@` agent, `$` target."""
        if self.render_mode != "ansi" or self.maze is None:
            return None
        cells = np.where(self.maze.lava, "#", ".")
        cells[self._pixels[1] == TRAIL] = "*"
        cells[self.maze.goal] = "$"
        cells[self.cell] = "@"
        return "\n".join("".join(row) for row in cells)

    def _enter(self, cell: tuple[int, int]) -> None:
        assert self.maze is not None
        self._pixels[0][cell] = AGENT
        if not self.maze.lava[cell]:
            self._pixels[1][cell] = TRAIL
