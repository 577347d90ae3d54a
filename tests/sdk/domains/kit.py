"""A small domain written by hand, complete and correct: the tests break one part of it at a time."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from waypost.domains import Horizons, InstanceSets, Symmetry, View

CELLS = 6


class LineEnv(gymnasium.Env[Any, Any]):
    """A line of six cells. The task is to reach the last one."""

    action_space: Any = spaces.Discrete(2)
    observation_space: Any = spaces.Box(0, 1, (CELLS,), np.float32)

    def __init__(self) -> None:
        self.cell = self.steps = 0

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        self.cell, self.steps = (options or {}).get("instance", 0), 0
        return self.observe(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        self.cell = min(max(self.cell + (1 if action == 1 else -1), 0), CELLS - 1)
        self.steps += 1
        done = self.cell == CELLS - 1
        return self.observe(), float(done), done, self.steps >= 12, {}

    def observe(self) -> Any:
        return np.eye(CELLS, dtype=np.float32)[self.cell]


class LineOracle:
    """Its subgoals are the cells 3 and 5."""

    def good_subgoals(self, instance: Any, state: Any) -> Any:
        return [0] if state < 3 else [1]

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Any:
        return [] if self.reached(instance, origin, state, subgoal) else [1]

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: int) -> bool:
        return bool(state == (3, 5)[subgoal])

    def succeeded(self, instance: Any, state: Any) -> bool:
        return bool(state == CELLS - 1)

    def successor(self, instance: Any, state: Any, action: int) -> Any:
        return min(max(state + (1 if action == 1 else -1), 0), CELLS - 1)


def whole(observation: Any) -> Any:
    """A view that shows everything."""
    return observation


class LineDomain:
    """The line, with every optional part."""

    name = "line"
    subgoals: Any = ("middle", "end")
    actions: Any = ("back", "forth")
    horizons: Any = Horizons(lo=6, hi=4, full=12)
    observation_shape: Any = (CELLS,)
    symmetries: Any = (Symmetry(whole, (0, 1), (0, 1)),)
    hi_view: Any = View((CELLS,), whole)
    lo_view: Any = View((CELLS,), whole)
    flat_view: Any = View((CELLS,), whole)
    centered_view: Any = View((CELLS,), whole)
    crop_view: Any = View((CELLS,), whole)

    def __init__(self) -> None:
        self.oracle: Any = LineOracle()

    def make_env(self) -> Any:
        return LineEnv()

    def instances(self, name: str) -> InstanceSets:
        return InstanceSets([0, 1, 2], [0, 1])

    def instance_view(self, instance: Any) -> Any:
        return instance

    def state_view(self, env: Any) -> Any:
        return env.unwrapped.cell

    def succeeded(self, env: Any) -> Any:
        return env.unwrapped.cell == CELLS - 1

    def place(self, state: Any) -> Any:
        return state

    def outcome(self, instance: Any, origin: Any, state: Any, subgoal: int) -> Any:
        return "reached" if self.oracle.reached(instance, origin, state, subgoal) else None

    def frame(self, env: Any) -> Any:
        return np.full((8, 8, 3), 40 * env.unwrapped.cell, np.uint8)
