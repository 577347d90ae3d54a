"""The task on which the policies of the analysis act: a walk on a ring, and its expert.

A state is (u, x, t): the position where the segment began, the present position, the steps taken. Action a at step t
leads to x' = shuffle[x + a] + wind[t], modulo the ring. Start and wind are the episode's instance, so the task is
deterministic, and new in each episode. Every segment has H_LO steps and every episode H_HI segments: both learners know
the terminations, and the state tells u. So mu(u), pi_g(x) and the flat policy pi_{mu(u)}(x) are functions of the state.

Both inspections look at the last state alone, which is what makes them O(1) in the paper: Inspect_FULL passes where
the expert would have ended from the same start, Inspect_LO where pi*_g would have ended from the segment's first state.
What the proofs of Theorems 1 and 2 need is that a Fail implies a labeled mistake:

- If no action of tau_FULL differs from the expert's in its state, tau_FULL is the expert's own and passes. So after a
  Fail, Label_FULL shows flat DAgger a mistake.
- If no subgoal differs from mu* in its state and every segment passes Inspect_LO, the segments end one after the other
  where the expert's end, and the episode passes. So after a Fail, Label_HI shows a mistake of mu, or hg-DAgger reaches
  a segment that fails; and there pi_g, with g = mu*(u), made a mistake that Label_LO shows, for the first reason.

A trajectory may also be wrong and end in the right state. It passes, and neither costs nor teaches anything more.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from waypost.domain import Horizons
from waypost.trajectory import Action, State, Subgoal
from waypost_learner.experiments.theory.classes import N_ACTIONS, N_POSITIONS, Cell, Classes


class Task:
    """The walk: of a `Domain` what questions and answers need, and its `Oracle`."""

    def __init__(self, cell: Cell, classes: Classes, rng: np.random.Generator) -> None:
        self.horizons = Horizons(lo=cell.h_lo, hi=cell.h_hi, full=cell.h_hi * cell.h_lo)
        self.subgoals = tuple(f"g{g}" for g in range(cell.n_subgoals))
        self.actions = tuple(f"a{a}" for a in range(N_ACTIONS))
        self._mu_star: list[Subgoal] = classes.mu_star.tolist()
        self._pi_star: list[list[Action]] = classes.pi_star.tolist()
        self._shuffle: list[int] = rng.permutation(N_POSITIONS).tolist()

    @property
    def oracle(self) -> "Task":
        """mu* and pi*_g."""
        return self

    def draw_instance(self, rng: np.random.Generator) -> Any:
        """Draw the start and the wind of an episode."""
        wind = rng.integers(N_POSITIONS, size=self.horizons.full)
        return {"start": int(rng.integers(N_POSITIONS)), "wind": wind.tolist()}

    def steered(self, positions: Sequence[int], actions: Sequence[Action]) -> Any:
        """Return the instance in which who acts like this walks over these positions, [H_FULL] each."""
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
        """Return the state after an action; after every H_LO of them a new segment begins."""
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
        """Return whether pi*_g, begun in `origin`, would have ended in `state`."""
        return bool(state == self._carried_out(instance, origin, subgoal))

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the expert would have ended in `state`."""
        end = self.first_state(instance)
        for _ in range(self.horizons.hi):
            end = self._carried_out(instance, end, self._mu_star[end[0]])
        return bool(state == end)

    def _carried_out(self, instance: Any, state: Any, subgoal: Subgoal) -> Any:
        for _ in range(self.horizons.lo):
            state = self.successor(instance, state, self._pi_star[subgoal][state[1]])
        return state


def observed(state: Any) -> State:
    """Return a state as policies see it, float32[2]: u and x."""
    return State(np.array(state[:2], np.float32), state)
