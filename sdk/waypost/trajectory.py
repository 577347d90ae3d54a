"""Defines states, segments and trajectories (paper, section 3) as immutable values.

A hierarchical trajectory sigma is a tuple of segments (s_h, g_h, tau_h). A flat trajectory is a tuple of one segment
without a subgoal. Subgoals and actions are numbers in the order of the domain's lists; only wire messages use names.
"""

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

Subgoal = int
Action = int

Observation = NDArray[Any]
"""An observation: float32, or uint8, which networks see divided by 255."""

Outcome = Literal["reached", "failed"]
"""How a subgoal ended if its termination is given (Algorithm 3): "reached" is success(s; g), "failed" is terminal(s; g)
without success."""


@dataclass(frozen=True, eq=False)
class State:
    """One environment state s: the observation for networks, and the JSON view for experts."""

    observation: Observation
    view: Any
    snapshot: Any = None  # of the environment, where trajectories are replayed by snapshots
    picture: NDArray[np.uint8] | None = None  # uint8[rows, columns, 3], where trajectories are recorded


@dataclass(frozen=True, eq=False)
class Segment:
    """(s_h, g_h, tau_h): a subgoal and the LO-level trajectory that carried it out."""

    subgoal: Subgoal | None
    states: tuple[State, ...]  # s_1 .. s_{H+1}
    actions: tuple[Action, ...]  # a_1 .. a_H
    terminated: bool  # whether beta_g or terminal(s; g) ended it, not the horizon or the episode
    rewards: tuple[float, ...] = ()  # r_1 .. r_H of the environment
    outcome: Outcome | None = None  # how the subgoal ended if terminations are given; None if it was cut off
    final: bool = False  # whether the environment terminated in the last state (a time limit does not count)
    led: bool = False  # whether it began with given actions, so that it is no attempt of the policy alone

    @property
    def start(self) -> State:
        """s_h, the state in which the subgoal was chosen."""
        return self.states[0]


Trajectory = tuple[Segment, ...]


def n_steps(trajectory: Trajectory) -> int:
    """Return the number of actions in all segments, the length of tau_FULL."""
    return sum(len(segment.actions) for segment in trajectory)
