"""Make a domain from a Gymnasium environment: `waypost.domain("Taxi-v3", subgoals=["fetch", "deliver"])`.

The functions that an author gives use names of subgoals and actions, not their numbers.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np

from waypost.domains.adapter import AdaptedEnv, Env, action_table, observer
from waypost.domains.contract import Horizons, InstanceSets
from waypost.domains.named import NamedOracle, Rules, number_of
from waypost.domains.parts import Box, Replay
from waypost.trajectory import Action, Observation, Outcome, Subgoal

State = Any
"""The JSON view of a state, as `state` returns it."""

_TRAIN_SEEDS, _TEST_SEEDS = range(10_000), range(1_000_000, 1_001_000)


class EnvironmentDomain:
    """A domain that wraps a Gymnasium environment. `waypost.domain` is another name for this class.

    Only the first two arguments are necessary. People can then answer every query. An oracle needs `succeeded`,
    `reached` and either `good_subgoals` and `good_actions`, or `successor` or `restore`, from which a search finds
    them.

    Args:
        environment: the id of a registered environment, or a function that makes one.
        subgoals: the names of the subgoals.
        name: the domain's name; made from the environment's id if None.
        actions: the names of the actions in their order, or each name's action, for example torques for a continuous
            action space; from the environment if None.
        horizons: the most actions in a segment, segments in an episode, and actions in an episode; from the
            environment's time limit if None.
        observe: maps an observation to what networks see: a vector, or a picture (channels, rows, columns), float32 or
            uint8. If None, pictures get their channels first, and everything else becomes one vector.
        state: returns what experts and people see of the environment's state, as JSON. It must contain everything
            that `succeeded`, `reached` and the oracle use. If None, it is the observation if that is small.
        succeeded: returns whether the task is accomplished in a state. If None, an episode succeeds if it terminates
            with a positive reward.
        reached: returns whether a subgoal, chosen in the first state, is accomplished in the second.
        good_subgoals: returns every optimal subgoal in a state, the preferred one first.
        good_actions: returns every optimal action toward a subgoal, given the state where it was chosen and a state.
        successor: returns the state after an action.
        picture: returns a picture uint8[rows, columns, 3]. If None, the environment's own `rgb_array`, if it has one.
        landmarks: returns where subgoals are in the picture of a state: by subgoal, the left, upper, right and lower
            side of a box, as shares of the picture's width and height.
        action_landmarks: returns where actions lead in the picture of a state: boxes by action, as above.
        instances: the instances to train on and to test on, by "train" and "test". An instance is a seed, or the
            keyword arguments of `reset`, as JSON. If None, 10,000 seeds for training and 1,000 other seeds for tests.
        snapshot: returns the whole state of the environment; if None, what `state` returns.
        restore: brings the environment to the state of a snapshot.
        replay: how trajectories are carried out again (`waypost.domains.Replay`).
        test_every: how many episodes there are from one test rollout to the next.

    Raises:
        ValueError: the arguments contradict each other or the environment; the message says what to change.
    """

    def __init__(
        self,
        environment: str | Callable[[], Env],
        subgoals: Sequence[str],
        *,
        name: str | None = None,
        actions: Sequence[str] | Mapping[str, Any] | None = None,
        horizons: Horizons | tuple[int, int, int] | None = None,
        observe: Callable[[Any], Observation] | None = None,
        state: Callable[[Env], State] | None = None,
        succeeded: Callable[[State], bool] | None = None,
        reached: Callable[[State, State, str], bool] | None = None,
        good_subgoals: Callable[[State], Sequence[str]] | None = None,
        good_actions: Callable[[State, State, str], Sequence[str]] | None = None,
        successor: Callable[[State, str], State] | None = None,
        picture: Callable[[Env], Any] | None = None,
        landmarks: Callable[[State], Mapping[str, Box]] | None = None,
        action_landmarks: Callable[[State], Mapping[str, Box]] | None = None,
        instances: Mapping[str, Sequence[Any]] | None = None,
        snapshot: Callable[[Env], Any] | None = None,
        restore: Callable[[Env, Any], None] | None = None,
        replay: Replay = "actions",
        test_every: int = 1,
    ) -> None:
        self.name = name or _name_of(environment)
        self.subgoals = tuple(subgoals)
        self._environment, self._render = environment, False
        self._state, self._succeeded, self._reached = state, succeeded, reached
        self._sets = _sets_of(instances)
        self.replay: Replay = replay
        self.test_every = test_every
        probe = self._make()
        self._actions = action_table(probe, actions)
        self.actions = tuple(self._actions)
        self._observer = observer(probe, observe, self._sets.train[0])
        self.observation_shape = self._observer.shape
        self.horizons = _horizons(horizons, probe, len(self.subgoals))
        own = "rgb_array" in probe.metadata.get("render_modes", ())
        self._render = own and isinstance(environment, str) and picture is None
        if picture is not None or self._render or probe.render_mode == "rgb_array":
            self._picture = picture or (lambda env: env.render())
            self.frame = self._frame  # only if there are pictures, so that the domain has this part only then
        probe.close()
        self._snapshot, self._restore = snapshot, restore
        if restore is not None:
            self.restore = self._restored
        if landmarks is not None:
            self._landmarks = landmarks
            self.landmarks = self._boxes
        if action_landmarks is not None:
            self._action_landmarks = action_landmarks
            self.action_landmarks = self._action_boxes
        if reached is not None:
            self.outcome = self._outcome
        rules = Rules(reached, succeeded, good_subgoals, good_actions, successor or self._simulated(snapshot, restore))
        if rules.wanted:
            self.oracle = NamedOracle(self.name, self.subgoals, self.actions, rules)

    # --- the members of a domain

    def make_env(self) -> AdaptedEnv:
        """Return a new environment."""
        return AdaptedEnv(self._make(), self._observer, tuple(self._actions.values()), self.horizons.full)

    def instances(self, name: str) -> InstanceSets:
        """Return the instances. The only set is `random`.

        Raises:
            ValueError: `name` is not "random".
        """
        if name != "random":
            raise ValueError(f"the domain {self.name!r} has no instances {name!r}; the only set is: random")
        return self._sets

    def instance_view(self, instance: Any) -> Any:
        """Return the instance: a seed, or the keyword arguments of `reset`."""
        return instance

    def instance_from(self, view: Any) -> Any:
        """Return the instance with this view."""
        return view

    def state_view(self, env: Any) -> Any:
        """Return the JSON view of the current state."""
        adapted = env.unwrapped
        return adapted.small_observation() if self._state is None else self._state(adapted.inner)

    def succeeded(self, env: Any) -> bool:
        """Return whether the task is accomplished in the current state."""
        return env.unwrapped.rewarded if self._succeeded is None else bool(self._succeeded(self.state_view(env)))

    # --- the parts that a domain has if the author gave what they need

    def snapshot(self, env: Any) -> Any:
        """Return the whole state of the environment."""
        return self.state_view(env) if self._snapshot is None else self._snapshot(env.unwrapped.inner)

    def _restored(self, env: Any, snapshot: Any) -> None:
        assert self._restore is not None
        self._restore(env.unwrapped.inner, snapshot)

    def _frame(self, env: Any) -> Any:
        return self._picture(env.unwrapped.inner)

    def _boxes(self, instance: Any, state: Any) -> Mapping[Subgoal, Box]:
        del instance
        return {number_of(name, self.subgoals, "subgoal"): box for name, box in self._landmarks(state).items()}

    def _action_boxes(self, instance: Any, state: Any) -> Mapping[Action, Box]:
        del instance
        return {number_of(name, self.actions, "action"): box for name, box in self._action_landmarks(state).items()}

    def _outcome(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Outcome | None:
        del instance
        assert self._reached is not None
        return "reached" if self._reached(origin, state, self.subgoals[subgoal]) else None

    # --- how it is made

    def _make(self) -> Env:
        if callable(self._environment):
            return self._environment()
        try:
            return gymnasium.make(self._environment, render_mode="rgb_array" if self._render else None)
        except gymnasium.error.Error as error:
            raise ValueError(f"Gymnasium cannot make {self._environment!r}: {error}") from error

    def _simulated(
        self, snapshot: Callable[[Env], Any] | None, restore: Callable[[Env, Any], None] | None
    ) -> Callable[[State, str], State] | None:
        """Return `successor` by means of the environment, if a state's view can be restored; else None."""
        if restore is None or snapshot is not None:
            return None
        env: AdaptedEnv | None = None

        def successor(state: State, action: str) -> State:
            nonlocal env
            env = env or self.make_env()
            env.reset(options={"instance": self._sets.train[0]})
            restore(env.inner, state)
            env.step(np.int64(number_of(action, self.actions, "action")))
            return self.state_view(env)

        return successor


domain = EnvironmentDomain
"""`waypost.domain`: the short name, for a script that describes its domain."""


def _name_of(environment: str | Callable[[], Env]) -> str:
    if not isinstance(environment, str):
        raise ValueError("a domain that is made by a function needs a name: write name=...")
    return re.sub(r"[^a-z0-9]+", "-", environment.lower()).strip("-")


def _sets_of(instances: Mapping[str, Sequence[Any]] | None) -> InstanceSets:
    if instances is None:
        return InstanceSets(_TRAIN_SEEDS, _TEST_SEEDS)
    if set(instances) != {"train", "test"} or not all(instances.values()):
        raise ValueError('instances must be {"train": [...], "test": [...]}, both with at least one instance')
    return InstanceSets(instances["train"], instances["test"])


def _horizons(given: Horizons | tuple[int, int, int] | None, env: Env, subgoals: int) -> Horizons:
    """Return the horizons; by default a subgoal has half of its share of the time limit, and four attempts."""
    if isinstance(given, Horizons):
        return given
    if given is not None:
        return Horizons(*given)
    full = env.spec.max_episode_steps if env.spec is not None else None
    if full is None:
        raise ValueError("the environment has no time limit: write horizons=(actions in a segment, segments, actions)")
    return Horizons(lo=max(full // (2 * max(subgoals, 1)), 1), hi=4 * max(subgoals, 1), full=full)
