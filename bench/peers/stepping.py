"""Random actions in an environment: the loop that every environment is measured with."""

from collections.abc import Callable

import gymnasium
import numpy as np


def random_steps(env: gymnasium.Env) -> Callable[[int], None]:
    """Return what takes a number of steps, with a reset where an episode ends."""

    def loop(steps: int) -> None:
        actions = np.random.default_rng(0).integers(env.action_space.n, size=steps)
        env.reset(seed=0)
        for action in actions:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()

    return loop
