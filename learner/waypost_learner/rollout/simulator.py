"""A domain's environment that returns `State`s: observations for networks, and JSON views for experts."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from waypost.domains import Domain, DomainFailed, Ending, Pictured, Restorable, replay_of
from waypost.domains.failures import explained
from waypost.trajectory import Action, Outcome, State, Subgoal, Trajectory

ADVICE = 'remove what is random, or let replay = "snapshots" return to states, or use another algorithm'

HeadStart = Callable[[Any], Sequence[Action]]
"""Returns the actions that are carried out on an instance before the learner begins."""


class Simulator:
    """A domain's environment, one instance at a time.

    Args:
        domain: the domain; its environment runs.
        head_start: returns the actions to carry out after each reset; no actions if None.
        pictures: whether to keep a picture of each state, if the domain cannot replay trajectories.

    Raises:
        ValueError: the domain declares a way to replay trajectories that it does not provide.
    """

    def __init__(self, domain: Domain, head_start: HeadStart | None = None, pictures: bool = False) -> None:
        self.domain = domain
        self._head_start = head_start
        replay = replay_of(domain)
        self._restorable = domain if isinstance(domain, Restorable) and replay == "snapshots" else None
        self._pictured = domain if isinstance(domain, Pictured) and pictures and replay == "recorded" else None
        self.instance: Any = None
        self.ended = True
        self.steps = 0  # since the reset, without the head start
        self.reward = 0.0  # of the last step
        self.total_reward = 0.0  # since the reset, without the head start
        self.final = False  # whether the episode ended for another reason than the time limit
        self._env = domain.make_env()

    def reset(self, instance: Any) -> State:
        """Start an instance, carry out the head start without counting its steps, and return the start state."""
        try:
            observation, _ = self._env.reset(options={"instance": instance})
        except Exception as error:
            raise self._failed("reset", error) from error
        self.instance, self.ended, self.final, self.steps = instance, False, False, 0
        state = self._state(observation)
        for action in self._head_start(instance) if self._head_start else ():
            state = self.step(action)
        self.steps, self.total_reward = 0, 0.0
        return state

    def step(self, action: Action) -> State:
        """Take one action and return the next state.

        Raises:
            RuntimeError: the episode has ended.
            DomainFailed: the domain's code failed; the message says where.
        """
        if self.ended:
            raise RuntimeError("the episode has ended: call reset() before the next step()")
        try:
            observation, reward, terminated, truncated, _ = self._env.step(np.int64(action))
        except Exception as error:
            raise self._failed("step", error) from error
        self.reward, self.final, self.ended = float(reward), terminated, terminated or truncated
        self.steps += 1
        self.total_reward += self.reward
        return self._state(observation)

    def restore(self, state: State) -> None:
        """Return to an earlier state of this instance, which was not the last of its episode.

        Raises:
            RuntimeError: the domain's trajectories are not replayed by snapshots.
        """
        if self._restorable is None:
            raise RuntimeError("only domains with snapshots can return to a state")
        self._env.reset(options={"instance": self.instance})  # begins the time limit again
        self._restorable.restore(self._env, state.snapshot)
        self.ended = self.final = False

    def go_to_end(self, instance: Any, before: Trajectory) -> State:
        """Start an instance, carry out the segments `before` again, and return the state in which they end.

        Raises:
            DomainFailed: they do not lead to the same state again.
        """
        state = self.reset(instance)
        if not before:
            return state
        last = before[-1].states[-1]
        if self._restorable is not None:
            self.restore(last)
            return last
        for action in (action for segment in before for action in segment.actions):
            if self.ended:
                break
            state = self.step(action)
        if self.ended or state.view != last.view or not np.array_equal(state.observation, last.observation):
            raise DomainFailed(
                f"the domain {self.domain.name!r} does not come back to a state when its actions are carried out "
                f"again, so nobody can play on from there; {ADVICE}"
            )
        return state

    def outcome(self, origin: State, subgoal: Subgoal) -> Outcome | None:
        """Return how a subgoal that was chosen at `origin` has ended; None if it has not ended yet.

        Raises:
            ValueError: the domain does not say how subgoals end.
        """
        if not isinstance(self.domain, Ending):
            raise ValueError(f"the domain {self.domain.name!r} does not say how subgoals end (`outcome`)")
        return self.domain.outcome(self.instance, origin.view, self.domain.state_view(self._env), subgoal)

    @property
    def succeeded(self) -> bool:
        """Whether the task is accomplished in the current state."""
        return self.domain.succeeded(self._env)

    def _state(self, observation: Any) -> State:
        if np.shape(observation) != self.domain.observation_shape:
            raise DomainFailed(
                f"the domain {self.domain.name!r} returned an observation of the shape {np.shape(observation)}; "
                f"its observation_shape is {self.domain.observation_shape}; make them equal"
            )
        try:
            return State(
                observation if observation.dtype == np.uint8 else np.asarray(observation, np.float32),
                self.domain.state_view(self._env),
                self._restorable.snapshot(self._env) if self._restorable else None,
                self._pictured.frame(self._env) if self._pictured else None,
            )
        except Exception as error:
            raise self._failed("state_view, snapshot or frame", error) from error

    def _failed(self, what: str, error: Exception) -> DomainFailed:
        return DomainFailed(f"the domain {self.domain.name!r} failed: {explained(what, error)}")


@dataclass(frozen=True, eq=False)
class Start:
    """The start state s of an episode. Together with the policies, it determines the rollout.

    Args:
        state: the start state.
        instance: the environment instance that starts there.
        draw: the episode's number among the run's draws of training instances; it seeds the choices.
        simulator: the environment of the rollout; after the rollout, it is in the last state.
    """

    state: State
    instance: Any
    draw: int
    simulator: Simulator
