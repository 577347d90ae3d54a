"""Defines the first room of Montezuma's Revenge as a gymnasium environment (paper, appendix).

An action is held for four frames. The observation is uint8[4, 84, 84]: the last four grey pictures, the newest last.
The reward is the game's: 100 for the key, 300 for the door. The episode ends when the figure dies (it has one life) or
opens the door. After 2,000 steps it is truncated.
"""

import atexit
import weakref
from collections import deque
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from waypost_learner.domains.montezuma.game import ACTIONS, DOOR_REWARD, FRAME_SKIP, Game, Memory, Picture
from waypost_learner.domains.montezuma.landmarks import SIZE, STAIR, small

FRAMES = 4
MAX_STEPS = 2_000
MAX_NOOPS = 19

Observation = NDArray[np.uint8]

# Emulators, by frame skip, of environments that are gone. To start one takes as long as a hundred steps, and `reset`
# returns it to the start completely.
_IDLE: dict[int, list[Game]] = {1: [], FRAME_SKIP: []}
atexit.register(_IDLE.clear)  # ale-py complains about emulators that outlive the interpreter


@dataclass(frozen=True)
class Instance:
    """A start of the game, and what disturbs the actions."""

    noops: int  # steps without an action before the episode begins; they decide where the skull is
    slips: float = 0.0  # the probability of a random action instead of the chosen one
    sticky: float = 0.0  # the probability, in each frame, that the emulator repeats the action of the frame before
    seed: int = 0  # of slips and sticky actions


class MontezumaEnv(gymnasium.Env[Observation, np.int64]):
    """The environment. `reset` starts `options["instance"]`, or else a random number of no-ops from 0 to 19."""

    def __init__(self) -> None:
        self.action_space = spaces.Discrete(len(ACTIONS))
        self.observation_space = spaces.Box(0, 255, (FRAMES, SIZE, SIZE), np.uint8)
        self._games: dict[int, Game] = {}  # by frame skip
        self.memory: Memory | None = None  # None before the first reset

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Start `options["instance"]`, or a random number of no-ops."""
        super().reset(seed=seed)
        given = (options or {}).get("instance")
        self._instance: Instance = given or Instance(int(self.np_random.integers(MAX_NOOPS + 1)))
        self._rng = np.random.default_rng(self._instance.seed)
        self._held = 0  # the action of the last frame
        self.door_open, self.steps = False, 0
        self._game.reset()
        self._before = small(self._game.grey())  # the room as it is at first, for the detectors
        self._frames = deque([self._before] * FRAMES, FRAMES)
        for _ in range(self._instance.noops):
            self._act(0)
        self.memory = self._game.memory()
        return np.stack(self._frames), {}

    def step(self, action: np.int64) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Hold an action for four frames.

        Raises:
            RuntimeError: `reset` was never called.
        """
        if self.memory is None:
            raise RuntimeError("call reset() before the first step()")
        chosen = int(action)
        if self._instance.slips and self._rng.random() < self._instance.slips:
            chosen = int(self._rng.integers(len(ACTIONS)))
        reward = self._act(chosen)
        self.steps += 1
        self.memory = self._game.memory()
        self.door_open = self.door_open or reward == DOOR_REWARD
        ended = self.door_open or self.memory.dying
        return np.stack(self._frames), float(reward), ended, not ended and self.steps >= MAX_STEPS, {}

    def at_stair(self) -> bool:
        """Return whether the paper's detector sees the figure at the bottom of the right stair."""
        return STAIR.changed(self._frames[-1], self._before)

    def picture(self) -> Picture:
        """Return the screen in colors."""
        return self._game.picture()

    @property
    def _game(self) -> Game:
        skip = 1 if self._instance.sticky else FRAME_SKIP
        if skip not in self._games:
            idle = _IDLE[skip]
            self._games[skip] = idle.pop() if idle else Game(skip)
            weakref.finalize(self, idle.append, self._games[skip]).atexit = False
        return self._games[skip]

    def _act(self, action: int) -> int:
        """Hold an action for four frames, each of which may repeat the action before; return the rewards' sum."""
        if not self._instance.sticky:
            reward = self._game.act(action)
        else:
            reward = 0
            for _ in range(FRAME_SKIP):
                self._held = self._held if self._rng.random() < self._instance.sticky else action
                reward += self._game.act(self._held)
        self._frames.append(small(self._game.grey()))
        return reward
