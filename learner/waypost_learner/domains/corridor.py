"""A corridor with doors: the smallest complete domain, a template for your own, and the tests' domain.

Thirteen cells in a row, doors at cells 0, 4, 8 and 12. The agent starts somewhere and must reach a target cell.
Subgoals: the next door to the west, the next door to the east, the target (valid between the doors around it). Actions:
west, east. The page has no renderer for it: it shows the pictures that `frame` draws.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from waypost.domain import Horizons, InstanceSets, Symmetry
from waypost.trajectory import Outcome

CELLS = 13
DOORS = 4  # cells from door to door
MAX_STEPS = 30
WEST, EAST, TARGET = 0, 1, 2
PIXELS = 40  # of a cell, on a side
FLOOR, DOOR, GOAL, AGENT = (238, 235, 227), (176, 168, 150), (160, 106, 0), (11, 92, 150)


@dataclass(frozen=True)
class Corridor:
    """One instance."""

    start: int
    target: int


class CorridorEnv(gymnasium.Env[NDArray[np.float32], np.int64]):
    """Observation: float32[26], one-hot agent and one-hot target. Reward 1 on the target; walls only stop the agent."""

    metadata = {"render_modes": []}  # noqa: RUF012 (gymnasium's own form)

    def __init__(self) -> None:
        self.action_space = spaces.Discrete(2)
        self.observation_space = spaces.Box(0.0, 1.0, (2 * CELLS,), np.float32)
        self.corridor = Corridor(0, CELLS - 1)
        self.cell = self.steps = 0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Start an instance: the one in `options`, else a random one."""
        super().reset(seed=seed)
        start, target = self.np_random.choice(CELLS, 2, replace=False)
        self.corridor = (options or {}).get("instance") or Corridor(int(start), int(target))
        self.cell, self.steps = self.corridor.start, 0
        return self._observe(), {}

    def step(self, action: np.int64) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Move one cell."""
        self.cell = moved(self.cell, int(action))
        self.steps += 1
        arrived = self.cell == self.corridor.target
        return self._observe(), float(arrived), arrived, not arrived and self.steps >= MAX_STEPS, {}

    def _observe(self) -> NDArray[np.float32]:
        pixels = np.zeros(2 * CELLS, np.float32)
        pixels[self.cell] = pixels[CELLS + self.corridor.target] = 1
        return pixels


def moved(cell: int, action: int) -> int:
    """Return the cell after an action."""
    return min(max(cell + (1 if action == EAST else -1), 0), CELLS - 1)


class CorridorOracle:
    """Good subgoals, good actions and terminations; a state's JSON view is the cell."""

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[int]:
        """Go for the target once no door lies between."""
        target = instance["target"]
        low, high = _stretch(state, target)
        if low <= target <= high:
            return [TARGET]
        return [EAST if target > state else WEST]

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Sequence[int]:
        """Walk toward the aim."""
        aim = _aim(instance, origin, subgoal)
        return [] if state == aim else [EAST if aim > state else WEST]

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: int) -> bool:
        """Return whether the agent stands on the aim."""
        return bool(state == _aim(instance, origin, subgoal))

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the agent stands on the target."""
        return bool(state == instance["target"])

    def successor(self, instance: Any, state: Any, action: int) -> Any:
        """Return the next cell."""
        del instance
        return moved(state, action)


def _stretch(cell: int, target: int) -> tuple[int, int]:
    """Return the doors around a cell; from a door, those on the side of the target."""
    west = cell - 1 if target < cell else cell
    low = max(west, 0) // DOORS * DOORS
    return low, low + DOORS


def _aim(instance: Any, origin: int, subgoal: int) -> int:
    if subgoal == TARGET:
        return int(instance["target"])
    next_east, next_west = (origin // DOORS + 1) * DOORS, (origin - 1) // DOORS * DOORS
    return min(next_east, CELLS - 1) if subgoal == EAST else max(next_west, 0)


class CorridorDomain:
    """Everything Waypost needs to know of the corridor."""

    name = "corridor"
    subgoals = ("west", "east", "target")
    actions = ("west", "east")
    renderer = "corridor"
    horizons = Horizons(lo=6, hi=MAX_STEPS, full=MAX_STEPS)
    observation_shape = (2 * CELLS,)
    symmetries = (
        Symmetry(
            # Mirror both one-hot halves: west and east change places.
            observe=lambda observation: np.concatenate([observation[CELLS - 1 :: -1], observation[: CELLS - 1 : -1]]),
            subgoals=(EAST, WEST, TARGET),
            actions=(EAST, WEST),
        ),
    )

    def __init__(self) -> None:
        self.oracle = CorridorOracle()

    def make_env(self) -> CorridorEnv:
        """Return a new corridor."""
        return CorridorEnv()

    def instances(self, name: str) -> InstanceSets:
        """Return all pairs of start and target, every third one kept for the test; the one set is `random`."""
        if name != "random":
            raise ValueError(f"the corridor has no instances {name!r}; those that exist are: random")
        pairs = [Corridor(s, t) for s in range(CELLS) for t in range(CELLS) if s != t]
        order = np.random.default_rng(0).permutation(len(pairs))
        test = {int(i) for i in order[: len(pairs) // 3]}
        return InstanceSets(
            train=[pair for i, pair in enumerate(pairs) if i not in test],
            test=[pair for i, pair in enumerate(pairs) if i in test],
        )

    def instance_view(self, instance: Corridor) -> Any:
        """Return start and target."""
        return {"cells": CELLS, "start": instance.start, "target": instance.target}

    def state_view(self, env: Any) -> Any:
        """Return the agent's cell."""
        return env.unwrapped.cell

    def frame(self, env: Any) -> NDArray[np.uint8]:
        """Return a picture: the cells in a row, doors darker, the target as a frame, the agent as a square in it."""
        cells = np.full((PIXELS, CELLS, PIXELS, 3), FLOOR, np.uint8)
        cells[:, ::DOORS] = DOOR
        cells[:, :, 0] = cells[0] = cells[-1] = 255  # the lines between
        cells[4:-4, env.unwrapped.corridor.target, 4:-4] = GOAL
        cells[9:-9, env.unwrapped.corridor.target, 9:-9] = FLOOR
        cells[13:-13, env.unwrapped.cell, 13:-13] = AGENT
        return cells.reshape(PIXELS, CELLS * PIXELS, 3)

    def succeeded(self, env: Any) -> bool:
        """Return whether the agent is on the target."""
        return bool(env.unwrapped.cell == env.unwrapped.corridor.target)

    def outcome(self, instance: Corridor, origin: Any, state: Any, subgoal: int) -> Outcome | None:
        """Return "reached" on the aim; nothing can go wrong in a corridor."""
        return "reached" if state == _aim(self.instance_view(instance), origin, subgoal) else None
