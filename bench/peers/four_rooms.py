"""Runs MiniGrid's FourRooms in four forms, for `bench/environment.py`.

FourRooms is the public environment that is most similar to the maze: 19 x 19 cells and at most 100 steps. But its work
is different. The agent has a direction and must turn. Cells are objects, such as doors or keys. Each step computes the
visible part of a 7 x 7 view; FullyObsWrapper also computes it, before it encodes the whole grid. Each reset builds new
rooms. `gymnasium.make` adds wrappers; MazeEnv is measured without them, so compare it with the form "unwrapped".
"""

from collections.abc import Callable

import gymnasium
from minigrid.wrappers import FullyObsWrapper, ImgObsWrapper
from stepping import random_steps

PACKAGES = ("minigrid", "gymnasium", "numpy")


def start() -> Callable[[str, int], None]:
    """Return a function that takes a number of steps in one of the forms."""

    def made() -> gymnasium.Env:
        return gymnasium.make("MiniGrid-FourRooms-v0")

    loops = {
        "unwrapped": random_steps(made().unwrapped),
        "as made": random_steps(made()),
        "ImgObsWrapper": random_steps(ImgObsWrapper(made())),
        "FullyObsWrapper": random_steps(FullyObsWrapper(made())),
    }
    return lambda form, steps: loops[form](steps)
