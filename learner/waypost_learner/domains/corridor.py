"""Defines the corridor: the smallest complete domain, a template for new domains, and the domain of many tests.

It has thirteen cells in a row, with doors at cells 0, 4, 8 and 12. The agent starts in one cell and must reach a target
cell. The subgoals are the next door to the west, the next door to the east, and the target; the target is valid only
between the two doors around it. The actions are west and east. The web app has no renderer for the corridor, so it
shows the pictures of `frame`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from waypost.domains import Box, Horizons, InstanceSets, Symmetry
from waypost.trajectory import Action, Outcome, Subgoal

CELLS = 13
OBSERVED = CELLS + 2 * CELLS - 1  # numbers in an observation
DOOR_SPACING = 4  # cells from one door to the next
MAX_STEPS = 30
WEST, EAST, TARGET = 0, 1, 2
PIXELS = 40  # pixels per side of a cell
FLOOR, DOOR, GOAL, AGENT = (238, 235, 227), (176, 168, 150), (160, 106, 0), (11, 92, 150)


@dataclass(frozen=True)
class Corridor:
    """One instance: the agent's first cell and the target cell."""

    start: int
    target: int


class CorridorEnv(gymnasium.Env[NDArray[np.float32], np.int64]):
    """The corridor as a gymnasium environment.

    The observation is float32[38]: the agent's cell, and how far the target is to the east of it, from -12 to 12; both
    one-hot. (With the target's cell instead, what is learned about one pair of cells says little about other pairs.)
    The reward is 1 on the target, which ends the episode, and 0 elsewhere. At the ends of the corridor the agent stays
    where it is.
    """

    def __init__(self) -> None:
        self.action_space = spaces.Discrete(2)
        self.observation_space = spaces.Box(0.0, 1.0, (OBSERVED,), np.float32)
        self.corridor = Corridor(0, CELLS - 1)
        self.cell = self.steps = 0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Start `options["instance"]`, or a random instance."""
        super().reset(seed=seed)
        start, target = self.np_random.choice(CELLS, 2, replace=False)
        self.corridor = (options or {}).get("instance") or Corridor(int(start), int(target))
        self.cell, self.steps = self.corridor.start, 0
        return self._observe(), {}

    def step(self, action: np.int64) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Move the agent one cell, and truncate the episode after `MAX_STEPS` steps."""
        self.cell = moved(self.cell, int(action))
        self.steps += 1
        arrived = self.cell == self.corridor.target
        return self._observe(), float(arrived), arrived, not arrived and self.steps >= MAX_STEPS, {}

    def _observe(self) -> NDArray[np.float32]:
        observation = np.zeros(OBSERVED, np.float32)
        observation[self.cell] = observation[OBSERVED - CELLS - self.cell + self.corridor.target] = 1
        return observation


def moved(cell: int, action: int) -> int:
    """Return the cell after an action."""
    return min(max(cell + (1 if action == EAST else -1), 0), CELLS - 1)


class CorridorOracle:
    """The corridor's expert. The JSON view of a state is the agent's cell."""

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[int]:
        """Return the target if no door is between it and the agent, else the door toward it."""
        target = instance["target"]
        low, high = _doors_around(state, target)
        if low <= target <= high:
            return [TARGET]
        return [EAST if target > state else WEST]

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Sequence[int]:
        """Return the step toward the subgoal's end cell; nothing if the agent is on it."""
        end = _end_cell(instance, origin, subgoal)
        return [] if state == end else [EAST if end > state else WEST]

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: int) -> bool:
        """Return whether the agent is on the subgoal's end cell."""
        return bool(state == _end_cell(instance, origin, subgoal))

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the agent is on the target."""
        return bool(state == instance["target"])

    def successor(self, instance: Any, state: Any, action: int) -> Any:
        """Return the next cell."""
        del instance
        return moved(state, action)


def _doors_around(cell: int, target: int) -> tuple[int, int]:
    """Return the two doors around a cell; for a door itself, this door and the next one toward the target."""
    west = cell - 1 if target < cell else cell
    low = max(west, 0) // DOOR_SPACING * DOOR_SPACING
    return low, low + DOOR_SPACING


def _end_cell(instance: Any, origin: int, subgoal: int) -> int:
    """Return the cell where a subgoal chosen in `origin` ends."""
    if subgoal == TARGET:
        return int(instance["target"])
    next_east, next_west = (origin // DOOR_SPACING + 1) * DOOR_SPACING, (origin - 1) // DOOR_SPACING * DOOR_SPACING
    return min(next_east, CELLS - 1) if subgoal == EAST else max(next_west, 0)


class CorridorDomain:
    """The corridor as a `waypost.domains.Domain`."""

    name = "corridor"
    subgoals = ("west", "east", "target")
    actions = ("west", "east")
    renderer = "corridor"
    horizons = Horizons(lo=6, hi=MAX_STEPS, full=MAX_STEPS)
    observation_shape = (OBSERVED,)
    symmetries = (
        Symmetry(
            # Mirror both one-hot parts, so that west and east change places.
            observe=lambda observation: np.concatenate([observation[CELLS - 1 :: -1], observation[: CELLS - 1 : -1]]),
            subgoals=(EAST, WEST, TARGET),
            actions=(EAST, WEST),
        ),
    )

    def __init__(self) -> None:
        self.oracle = CorridorOracle()

    def make_env(self) -> CorridorEnv:
        """Return a new environment."""
        return CorridorEnv()

    def instances(self, name: str) -> InstanceSets:
        """Return all pairs of start and target, a random third of them for testing. The only set is `random`.

        Raises:
            ValueError: `name` is not "random".
        """
        if name != "random":
            raise ValueError(f"the corridor has no instances {name!r}; the only set is: random")
        pairs = [Corridor(s, t) for s in range(CELLS) for t in range(CELLS) if s != t]
        order = np.random.default_rng(0).permutation(len(pairs))
        test = {int(i) for i in order[: len(pairs) // 3]}
        return InstanceSets(
            train=[pair for i, pair in enumerate(pairs) if i not in test],
            test=[pair for i, pair in enumerate(pairs) if i in test],
        )

    def instance_view(self, instance: Corridor) -> Any:
        """Return the number of cells, the start and the target."""
        return {"cells": CELLS, "start": instance.start, "target": instance.target}

    def state_view(self, env: Any) -> Any:
        """Return the agent's cell."""
        return env.unwrapped.cell

    def frame(self, env: Any) -> NDArray[np.uint8]:
        """Return a picture, uint8[40, 520, 3]: doors are darker cells, the target is a frame, the agent is a square."""
        cells = np.full((PIXELS, CELLS, PIXELS, 3), FLOOR, np.uint8)
        cells[:, ::DOOR_SPACING] = DOOR
        cells[:, :, 0] = cells[0] = cells[-1] = 255  # the lines between the cells
        cells[4:-4, env.unwrapped.corridor.target, 4:-4] = GOAL
        cells[9:-9, env.unwrapped.corridor.target, 9:-9] = FLOOR
        cells[13:-13, env.unwrapped.cell, 13:-13] = AGENT
        return cells.reshape(PIXELS, CELLS * PIXELS, 3)

    def landmarks(self, instance: Any, state: Any) -> dict[Subgoal, Box]:
        """Return the boxes of the next doors and of the target in the picture; there is no door beyond the ends."""
        doors = range(0, CELLS, DOOR_SPACING)
        cells = {
            WEST: max((door for door in doors if door < state), default=None),
            EAST: min((door for door in doors if door > state), default=None),
            TARGET: instance["target"],
        }
        return {g: (cell / CELLS, 0, (cell + 1) / CELLS, 1) for g, cell in cells.items() if cell is not None}

    def action_landmarks(self, instance: Any, state: Any) -> dict[Action, Box]:
        """Return the boxes of the cells to which the actions lead; there is none beyond the ends."""
        del instance
        cells = {WEST: state - 1, EAST: state + 1}
        return {a: (cell / CELLS, 0, (cell + 1) / CELLS, 1) for a, cell in cells.items() if 0 <= cell < CELLS}

    def succeeded(self, env: Any) -> bool:
        """Return whether the agent is on the target."""
        return bool(env.unwrapped.cell == env.unwrapped.corridor.target)

    def outcome(self, instance: Corridor, origin: Any, state: Any, subgoal: int) -> Outcome | None:
        """Return "reached" on the subgoal's end cell, else None. In the corridor a subgoal cannot fail."""
        return "reached" if state == _end_cell(self.instance_view(instance), origin, subgoal) else None
