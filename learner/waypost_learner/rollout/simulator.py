"""One environment of a domain, giving `State`s: what networks see together with what experts see."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from waypost.domain import Domain
from waypost.trajectory import Action, Outcome, State, Subgoal

HeadStart = Callable[[Any], Sequence[Action]]
"""Returns, for an instance, actions that are carried out before the learner begins."""


class Simulator:
    """A domain's environment, one instance at a time."""

    def __init__(self, domain: Domain, head_start: HeadStart | None = None) -> None:
        self.domain = domain
        self._head_start = head_start
        self.instance: Any = None
        self.ended = True
        self.steps = 0
        self.reward = 0.0  # of the last step
        self.final = False  # whether the episode ended for another reason than the time limit
        self._env = domain.make_env()

    def reset(self, instance: Any) -> State:
        """Start an instance; the steps of a head start are not counted."""
        observation, _ = self._env.reset(options={"instance": instance})
        self.instance, self.ended, self.final, self.steps = instance, False, False, 0
        state = State(observation, self.domain.state_view(self._env))
        for action in self._head_start(instance) if self._head_start else ():
            state = self.step(action)
        self.steps = 0
        return state

    def step(self, action: Action) -> State:
        """Take one action.

        Raises:
            RuntimeError: the episode has ended.
        """
        if self.ended:
            raise RuntimeError("the episode has ended: call reset() before the next step()")
        observation, reward, terminated, truncated, _ = self._env.step(np.int64(action))
        self.reward, self.final, self.ended = float(reward), terminated, terminated or truncated
        self.steps += 1
        return State(observation, self.domain.state_view(self._env))

    def outcome(self, origin: State, subgoal: Subgoal) -> Outcome | None:
        """Return how a subgoal, chosen at `origin`, has ended by now; None while it is under way."""
        return self.domain.outcome(self.instance, origin.view, self.domain.state_view(self._env), subgoal)

    @property
    def succeeded(self) -> bool:
        """Whether the task is accomplished in the present state."""
        return self.domain.succeeded(self._env)
