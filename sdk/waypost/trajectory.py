"""The nouns of the paper (section 3), as values that never change.

A hierarchical trajectory sigma is a tuple of segments (s_h, g_h, tau_h); a flat trajectory is one segment without a
subgoal. Subgoals and actions are numbers here, in the order of the domain's own lists; names only exist on the wire.
"""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Subgoal = int
Action = int

Outcome = Literal["reached", "failed"]
"""How a subgoal ended, where its termination is given (Algorithm 3): success(s; g), or terminal(s; g) without it."""


@dataclass(frozen=True, eq=False)
class State:
    """One environment state s: what the networks see, and the JSON view that experts see."""

    observation: NDArray[np.float32]
    view: Any


@dataclass(frozen=True, eq=False)
class Segment:
    """(s_h, g_h, tau_h): a subgoal and the LO-level trajectory that carried it out."""

    subgoal: Subgoal | None
    states: tuple[State, ...]  # s_1 .. s_{H+1}
    actions: tuple[Action, ...]  # a_1 .. a_H
    terminated: bool  # whether beta_g or terminal(s; g) ended it, rather than the horizon or the episode
    rewards: tuple[float, ...] = ()  # r_1 .. r_H, the environment's
    outcome: Outcome | None = None  # how the subgoal ended, where that is given; None if it was cut off
    final: bool = False  # whether the environment ended in the last state, for another reason than its time limit

    @property
    def start(self) -> State:
        """s_h, where the subgoal was chosen."""
        return self.states[0]


Trajectory = tuple[Segment, ...]


def n_steps(trajectory: Trajectory) -> int:
    """Return the number of actions in the full trajectory tau_FULL."""
    return sum(len(segment.actions) for segment in trajectory)
