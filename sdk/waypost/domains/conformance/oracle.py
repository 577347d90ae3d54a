"""Checks of a domain's oracle: whoever follows it accomplishes the task within the horizons."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from waypost.domains.conformance.episodes import trials
from waypost.domains.contract import Domain
from waypost.domains.parts import Oracle, Predicting, oracle_of


def oracle_solves(domain: Domain) -> Iterator[str]:
    """Following the oracle's first choices accomplishes the task within the horizons. Without an oracle, it passes."""
    oracle = oracle_of(domain)
    if oracle is not None:
        for instance, _ in trials(domain):
            failure = next(_Follower(domain, oracle, instance).failures(), None)
            if failure is not None:
                yield failure
                return


class _Follower:
    """Follows an oracle in the environment, on one instance."""

    def __init__(self, domain: Domain, oracle: Oracle, instance: Any) -> None:
        self._domain, self._oracle, self._view = domain, oracle, domain.instance_view(instance)
        self._env = domain.make_env()
        self._env.reset(options={"instance": instance})
        self._state = domain.state_view(self._env)
        self._steps, self._ended = 0, False

    def failures(self) -> Iterator[str]:
        """Follow the oracle to the end of the task, and yield what is wrong on the way."""
        oracle, horizons, segments = self._oracle, self._domain.horizons, 0
        while not oracle.succeeded(self._view, self._state):
            if self._ended:
                yield f"The episode of the instance {self._view} ends before the oracle has accomplished the task."
                return
            if segments == horizons.hi:
                yield f"The oracle needs more than {segments} segments, which is horizons.hi; raise it."
                return
            yield from self._carry_out()
            segments += 1
            if oracle.succeeded(self._view, self._state) != self._domain.succeeded(self._env):
                yield f"The oracle and the domain disagree about succeeded in the state {self._state}; make them equal."

    def _carry_out(self) -> Iterator[str]:
        """Carry out the oracle's preferred subgoal."""
        oracle, domain, origin, taken = self._oracle, self._domain, self._state, 0
        where = f"in the state {origin} of the instance {self._view}"
        subgoals = list(oracle.good_subgoals(self._view, origin))
        if not subgoals or not set(subgoals) <= set(range(len(domain.subgoals))):
            yield f"good_subgoals returns {subgoals} {where}; return at least one number of a subgoal."
        name = domain.subgoals[subgoals[0]]
        if oracle.reached(self._view, origin, origin, subgoals[0]):
            yield f"good_subgoals returns {name!r} {where}, where it is reached already; return the next one."
        while not self._ended and not oracle.reached(self._view, origin, self._state, subgoals[0]):
            if taken == domain.horizons.lo:
                yield f"The oracle needs more than {taken} actions for {name!r}, which is horizons.lo; raise it."
            actions = list(oracle.good_actions(self._view, origin, self._state, subgoals[0]))
            if not actions or not set(actions) <= set(range(len(domain.actions))):
                where = f"toward {name!r} in the state {self._state} of the instance {self._view}"
                yield f"good_actions returns {actions} {where}; return at least one number of an action."
            yield from self._act(actions[0])
            taken += 1

    def _act(self, action: int) -> Iterator[str]:
        before, oracle = self._state, self._oracle
        _, _, terminated, truncated, _ = self._env.step(np.int64(action))
        self._state, self._ended = self._domain.state_view(self._env), bool(terminated or truncated)
        if isinstance(oracle, Predicting):
            expected = oracle.successor(self._view, before, action)
            if expected != self._state:
                name = self._domain.actions[action]
                yield (
                    f"successor returns {expected} after {name!r} in the state {before}, but the environment is in "
                    f"{self._state}; make them equal."
                )
