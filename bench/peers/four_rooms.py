"""MiniGrid's FourRooms in four forms, as `bench/environment.py` asks for them.

The nearest public environment to the maze: 19 x 19 cells, 100 steps at most. It does other work, though. The agent
has a direction and turns; cells are objects, which could be doors or keys; each step works out what is seen of a
7 x 7 view behind walls, which FullyObsWrapper computes too before it encodes the whole grid; each reset builds new
rooms. `gymnasium.make` adds wrappers, which MazeEnv is measured without: "unwrapped" is the one without them.
"""

from collections.abc import Callable

import gymnasium
from minigrid.wrappers import FullyObsWrapper, ImgObsWrapper
from stepping import random_steps

PACKAGES = ("minigrid", "gymnasium", "numpy")


def start() -> Callable[[str, int], None]:
    """Return what takes a number of steps in one of the forms."""

    def made() -> gymnasium.Env:
        return gymnasium.make("MiniGrid-FourRooms-v0")

    loops = {
        "unwrapped": random_steps(made().unwrapped),
        "as made": random_steps(made()),
        "ImgObsWrapper": random_steps(ImgObsWrapper(made())),
        "FullyObsWrapper": random_steps(FullyObsWrapper(made())),
    }
    return lambda form, steps: loops[form](steps)
