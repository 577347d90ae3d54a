"""Defines the domain `montezuma`: the first room of Montezuma's Revenge (paper, section 6.2 and appendix)."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost.domains import Box, Horizons, InstanceSets, View
from waypost.trajectory import Outcome, Subgoal
from waypost_learner.domains.montezuma.env import FRAMES, MAX_NOOPS, MAX_STEPS, Instance, MontezumaEnv
from waypost_learner.domains.montezuma.game import ACTIONS
from waypost_learner.domains.montezuma.landmarks import SIZE
from waypost_learner.domains.montezuma.oracle import RoomOracle
from waypost_learner.domains.montezuma.subgoals import LANDMARKS, SUBGOALS, reached
from waypost_learner.domains.montezuma.views import CENTERED_VIEW, SMALL_VIEW

SLIPS, STICKY = 0.05, 0.25
_DISTURBED = {"slips": {"slips": SLIPS}, "sticky": {"sticky": STICKY}}


class MontezumaDomain:
    """The first room as a `waypost.domains.Domain`, with an oracle that the package contains.

    The task is accomplished when the door is open: the key's 100 points and the door's 300.
    """

    name = "montezuma"
    subgoals = SUBGOALS
    actions = ACTIONS
    horizons = Horizons(lo=500, hi=20, full=MAX_STEPS)
    observation_shape = (FRAMES, SIZE, SIZE)
    hi_view: View = SMALL_VIEW
    lo_view: View = SMALL_VIEW
    flat_view: View = SMALL_VIEW
    centered_view: View = CENTERED_VIEW

    def __init__(self) -> None:
        self.oracle = RoomOracle()

    def make_env(self) -> MontezumaEnv:
        """Return a new environment."""
        return MontezumaEnv()

    def instances(self, name: str) -> InstanceSets:
        """Return the 20 starts `random`, from which `slips` and `sticky` also start, each 50 times.

        In `slips`, an action is a random one with the probability 0.05. In `sticky`, the emulator repeats the action of
        the frame before with the probability 0.25.

        Raises:
            ValueError: the name is unknown.
        """
        if name == "random":
            starts = [Instance(noops) for noops in range(MAX_NOOPS + 1)]
            return InstanceSets(starts, starts)
        if name not in _DISTURBED:
            raise ValueError(f"montezuma has no instances {name!r}; use random, slips or sticky")
        disturbed = [Instance(n % (MAX_NOOPS + 1), **_DISTURBED[name], seed=n) for n in range(2_000)]
        return InstanceSets(disturbed[:1_000], disturbed[1_000:])

    def instance_view(self, instance: Instance) -> Any:
        """Return the number of no-ops, and what disturbs the actions."""
        return vars(instance)

    def instance_from(self, view: Any) -> Instance:
        """Return the instance of a view."""
        return Instance(**view)

    def state_view(self, env: Any) -> Any:
        """Return what the game's memory says, and which landmarks are reached."""
        inner: MontezumaEnv = env.unwrapped
        assert inner.memory is not None
        return {
            "x": inner.memory.x,
            "y": inner.memory.y,
            "motion": list(inner.memory.motion),
            "skull": list(inner.memory.skull),
            "key": inner.memory.key,
            "at_stair": inner.at_stair(),
            "door_open": inner.door_open,
            "dying": inner.memory.dying,
        }

    def place(self, state: Any) -> tuple[int, int]:
        """Return the square of eight by eight pixels in which the figure is."""
        return state["x"] // 8, state["y"] // 8

    def succeeded(self, env: Any) -> bool:
        """Return whether the door is open."""
        return bool(env.unwrapped.door_open)

    def outcome(self, instance: Instance, origin: Any, state: Any, subgoal: Subgoal) -> Outcome | None:
        """Return "reached" at the subgoal's landmark, "failed" if the figure dies, else None."""
        del instance, origin
        return "reached" if reached(state, subgoal) else "failed" if state["dying"] else None

    def build(self, file: Path, progress: Callable[[str, int, int], None]) -> None:
        """Compute the oracle's table from the emulator, in some minutes."""
        from waypost_learner.domains.montezuma.expert.build import build  # only this command needs it

        build(file, progress)

    def frame(self, env: Any) -> NDArray[np.uint8]:
        """Return the screen uint8[210, 320, 3] in its usual shape: the game's pixels are twice as wide as high."""
        return np.repeat(env.unwrapped.picture(), 2, axis=1)

    def landmarks(self, instance: Any, state: Any) -> dict[Subgoal, Box]:
        """Return the boxes of the paper's detectors. They are the same in each state."""
        del instance, state
        return {subgoal: landmark.shares for subgoal, landmark in LANDMARKS.items()}
