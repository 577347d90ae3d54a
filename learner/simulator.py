"""One environment of a domain, giving `State`s: what networks see together with what experts see."""

from typing import Any

import numpy as np

from learner.domains.base import Domain
from learner.types import Action, State


class Simulator:
    """A domain's environment, one instance at a time."""

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self.instance: Any = None
        self.ended = True
        self.steps = 0
        self._env = domain.make_env()

    def reset(self, instance: Any) -> State:
        """Start an instance."""
        observation, _ = self._env.reset(options={"instance": instance})
        self.instance, self.ended, self.steps = instance, False, 0
        return State(observation, self.domain.state_view(self._env))

    def step(self, action: Action) -> State:
        """Take one action.

        Raises:
            RuntimeError: the episode has ended.
        """
        if self.ended:
            raise RuntimeError("the episode has ended: call reset() before the next step()")
        observation, _, terminated, truncated, _ = self._env.step(np.int64(action))
        self.ended = terminated or truncated
        self.steps += 1
        return State(observation, self.domain.state_view(self._env))

    @property
    def succeeded(self) -> bool:
        """Whether the task is accomplished in the present state."""
        return self.domain.succeeded(self._env)
