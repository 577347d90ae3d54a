"""Takes random actions in an environment. All environments are measured with this loop."""

from collections.abc import Callable

import gymnasium
import numpy as np


def random_steps(env: gymnasium.Env) -> Callable[[int], None]:
    """Return a function that takes a number of random steps and resets the environment after each episode."""

    def loop(steps: int) -> None:
        actions = np.random.default_rng(0).integers(env.action_space.n, size=steps)
        env.reset(seed=0)
        for action in actions:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()

    return loop
