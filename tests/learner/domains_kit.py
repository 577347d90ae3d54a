"""Domains that lack parts, fail, or cannot repeat an episode, made from a Gymnasium environment."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

import waypost

FORTH = 1


class Walk(gymnasium.Env[Any, Any]):
    """A walk of six cells, in which wind may carry the walker one cell further. Observations are pictures, uint8.

    Args:
        wind: says whether there is wind now; None for no wind.
    """

    metadata = {"render_modes": []}  # noqa: RUF012
    action_space = spaces.Discrete(2)
    observation_space = spaces.Box(0, 255, (3, 12, 12), np.uint8)

    def __init__(self, wind: Any = None) -> None:
        self.wind = wind

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        super().reset(seed=seed)
        self.cell = int(self.np_random.integers(2))
        return self.picture(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        self.cell = max(self.cell + (1 if action == FORTH else -1), 0)
        if self.wind is not None and self.wind():
            self.cell += 1
        self.cell = min(self.cell, 5)
        return self.picture(), float(self.cell == 5), self.cell == 5, False, {}

    def picture(self) -> Any:
        picture = np.zeros((3, 12, 12), np.uint8)
        picture[:, :, 2 * self.cell : 2 * self.cell + 2] = 255
        return picture


def walk(**given: Any) -> Any:
    """The walk as a domain whose instances are seeds. Its oracle goes to the third cell, then to the last."""
    common: dict[str, Any] = {
        "name": "walk",
        "subgoals": ["third", "last"],
        "actions": ["back", "forth"],
        "horizons": (6, 4, 16),
        "state": lambda env: {"cell": env.unwrapped.cell},
        "succeeded": lambda state: state["cell"] == 5,
        "reached": lambda origin, state, subgoal: state["cell"] >= (5 if subgoal == "last" else 3),
        "good_subgoals": lambda state: ["third" if state["cell"] < 3 else "last"],
        "good_actions": lambda origin, state, subgoal: ["forth"],
        "picture": lambda env: np.moveaxis(env.unwrapped.picture(), 0, -1),
    }
    return waypost.domain(**{"environment": Walk} | common | given)


plain = walk()
"""A domain without any structure, which is found as `tests.learner.domains_kit:plain`."""

rarely_tested = walk(test_every=5)


class Weather:
    """Wind that no seed of an episode fixes; a test can change its share."""

    def __init__(self) -> None:
        self.share, self._rng = 0.3, np.random.default_rng()

    def __call__(self) -> bool:
        return bool(self._rng.random() < self.share)


weather = Weather()


def windy(**given: Any) -> Any:
    """The walk with wind."""
    return walk(environment=lambda: Walk(weather), **given)


recorded = windy(replay="recorded")
restorable = windy(replay="snapshots", restore=lambda env, state: setattr(env.unwrapped, "cell", state["cell"]))


class Falls(Walk):
    """A walk that fails at the fourth cell."""

    def step(self, action: Any) -> Any:
        if self.cell == 3:
            raise RuntimeError("the motor is off")
        return super().step(action)


bare = waypost.domain(Walk, ["third", "last"], name="bare", actions=["back", "forth"], horizons=(6, 4, 16))
"""Nothing but an environment and names: people must answer."""

falling = walk(environment=Falls)
stuck = walk(good_subgoals=lambda state: [])
