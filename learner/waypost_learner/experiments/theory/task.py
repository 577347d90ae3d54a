"""Defines the task of the simulation and its expert: a walk on a ring of positions.

A state is (u, x, t): the position where the segment began, the current position, and the number of steps so far.
Action a at step t leads to x' = shuffle[x + a] + wind[t], modulo the size of the ring. The instance of an episode
consists of its start and its wind, so the task is deterministic, but different in each episode. Every segment has H_LO
steps and every episode H_HI segments, so both learners know the terminations. The state contains u, so mu(u), pi_g(x)
and the flat policy pi_{mu(u)}(x) are functions of the state.

Both inspections check only the last state, as the paper assumes for inspections of O(1). Inspect_FULL passes if the
expert would have ended in the same state from the same start. Inspect_LO passes if pi*_g would have ended in the same
state from the segment's first state. The proofs of Theorems 1 and 2 need that a Fail implies a labeled mistake:

- Flat DAgger: if all actions of tau_FULL are the expert's, then tau_FULL is the expert's trajectory and passes. So
  after a Fail, Label_FULL shows a mistake.
- hg-DAgger: if all subgoals agree with mu* and all segments pass Inspect_LO, then each segment ends where the expert's
  ends, and the episode passes. So after a Fail, either Label_HI shows a mistake of mu, or hg-DAgger reaches a segment
  that fails. In that segment pi_g, with g = mu*(u), made a mistake, and Label_LO shows it.

A wrong trajectory can end in the right state. Then it passes, costs nothing more, and teaches nothing.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from waypost.domains import Horizons
from waypost.trajectory import Action, State, Subgoal
from waypost_learner.experiments.theory.classes import N_ACTIONS, N_POSITIONS, Cell, Classes


class Task:
    """The walk. It has the members of `Domain` that queries and answers need, and it is its own `Oracle`."""

    def __init__(self, cell: Cell, classes: Classes, rng: np.random.Generator) -> None:
        self.horizons = Horizons(lo=cell.h_lo, hi=cell.h_hi, full=cell.h_hi * cell.h_lo)
        self.subgoals = tuple(f"g{g}" for g in range(cell.n_subgoals))
        self.actions = tuple(f"a{a}" for a in range(N_ACTIONS))
        self._mu_star: list[Subgoal] = classes.mu_star.tolist()
        self._pi_star: list[list[Action]] = classes.pi_star.tolist()
        self._shuffle: list[int] = rng.permutation(N_POSITIONS).tolist()

    @property
    def oracle(self) -> "Task":
        """The expert with mu* and pi*_g: the task itself."""
        return self

    def draw_instance(self, rng: np.random.Generator) -> Any:
        """Draw the start and the wind of an episode."""
        wind = rng.integers(N_POSITIONS, size=self.horizons.full)
        return {"start": int(rng.integers(N_POSITIONS)), "wind": wind.tolist()}

    def steered(self, positions: Sequence[int], actions: Sequence[Action]) -> Any:
        """Return the instance in which these actions lead over these positions; both have H_FULL entries."""
        ahead = [*positions[1:], positions[0]]
        steps = zip(positions, actions, ahead, strict=True)
        wind = [(there - self._shuffle[(x + a) % N_POSITIONS]) % N_POSITIONS for x, a, there in steps]
        return {"start": positions[0], "wind": wind}

    def instance_view(self, instance: Any) -> Any:
        """Return the instance, which is JSON already."""
        return instance

    def first_state(self, instance: Any) -> Any:
        """Return the state in which an instance starts."""
        return [instance["start"], instance["start"], 0]

    def successor(self, instance: Any, state: Any, action: Action) -> Any:
        """Return the state after an action; a new segment begins after every H_LO actions."""
        u, x, t = state
        x = (self._shuffle[(x + action) % N_POSITIONS] + instance["wind"][t]) % N_POSITIONS
        return [x if (t + 1) % self.horizons.lo == 0 else u, x, t + 1]

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[Subgoal]:
        """Return mu*(u)."""
        del instance
        return [self._mu_star[state[0]]]

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Sequence[Action]:
        """Return pi*_g(x)."""
        del instance, origin
        return [self._pi_star[subgoal][state[1]]]

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> bool:
        """Return whether pi*_g ends in `state` if it starts in `origin`."""
        return bool(state == self._carried_out(instance, origin, subgoal))

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the expert ends in `state` if it starts in the instance's first state."""
        end = self.first_state(instance)
        for _ in range(self.horizons.hi):
            end = self._carried_out(instance, end, self._mu_star[end[0]])
        return bool(state == end)

    def _carried_out(self, instance: Any, state: Any, subgoal: Subgoal) -> Any:
        for _ in range(self.horizons.lo):
            state = self.successor(instance, state, self._pi_star[subgoal][state[1]])
        return state


def observed(state: Any) -> State:
    """Return the `State` of a JSON view; its observation is float32[2], u and x."""
    return State(np.array(state[:2], np.float32), state)
