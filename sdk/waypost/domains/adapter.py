"""Adapts a Gymnasium environment: numbered actions, observations as arrays, and instances as options of `reset`."""

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from waypost.trajectory import Observation

Env = gymnasium.Env[Any, Any]

_LARGEST_VIEW = 100  # numbers; each query keeps the views of all its states


@dataclass(frozen=True)
class Observer:
    """Maps an environment's observations to arrays float32 or uint8 of one shape."""

    observe: Callable[[Any], Observation]
    shape: tuple[int, ...]
    dtype: type[np.float32] | type[np.uint8]

    def __call__(self, observation: Any) -> Observation:
        """Return an observation as a new array."""
        return np.array(self.observe(observation), self.dtype)


class AdaptedEnv(gymnasium.Env[Any, Any]):
    """An environment with numbered actions, which starts `options["instance"]`.

    Args:
        inner: the author's environment.
        observer: maps its observations.
        actions: its actions, in the order of their numbers.
        steps: the most actions in an episode.
    """

    def __init__(self, inner: Env, observer: Observer, actions: Sequence[Any], steps: int) -> None:
        self.inner, self._observer, self._actions, self._limit = inner, observer, actions, steps
        self.metadata, self.render_mode = inner.metadata, inner.render_mode
        picture = observer.dtype is np.uint8
        low, high = (0, 255) if picture else (-np.inf, np.inf)
        self.observation_space = spaces.Box(low, high, observer.shape, observer.dtype)
        self.action_space = spaces.Discrete(len(actions))
        self.rewarded = False  # whether the episode terminated with a positive reward
        self._steps = 0
        self._raw: Any = None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Start an instance: a seed, or keyword arguments of the inner `reset`."""
        super().reset(seed=seed)
        options = dict(options or {})
        instance = options.pop("instance", None)
        given = {"seed": seed, "options": options or None} if instance is None else reset_arguments(instance)
        self._raw, info = self.inner.reset(**given)
        self.rewarded, self._steps = False, 0
        return self._observer(self._raw), info

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Carry out the action with this number."""
        self._raw, reward, terminated, truncated, info = self.inner.step(self._actions[int(action)])
        self._steps += 1
        self.rewarded = bool(terminated) and float(reward) > 0
        over = truncated or (not terminated and self._steps >= self._limit)
        return self._observer(self._raw), float(reward), bool(terminated), bool(over), info

    def render(self) -> Any:
        """Return the inner environment's picture."""
        return self.inner.render()

    def close(self) -> None:
        """Close the inner environment."""
        self.inner.close()

    def small_observation(self) -> Any:
        """Return the inner observation as JSON if it is small, else the number of actions so far."""
        raw = np.asarray(self._raw)
        if raw.dtype != object and raw.size <= _LARGEST_VIEW:
            return json.loads(json.dumps(raw.tolist()))
        return {"step": self._steps}


def reset_arguments(instance: Any) -> dict[str, Any]:
    """Return the arguments of `reset` for an instance.

    Raises:
        ValueError: the instance is neither a seed nor keyword arguments.
    """
    if isinstance(instance, int | np.integer):
        return {"seed": int(instance)}
    if isinstance(instance, Mapping):
        return dict(instance)
    raise ValueError(f"{instance!r} is no instance: it must be a seed, or a mapping with the arguments of reset")


def observer(env: Env, observe: Callable[[Any], Observation] | None, instance: Any) -> Observer:
    """Return how observations of an environment become arrays.

    Args:
        env: the environment; it is reset.
        observe: the author's function; if None, it is made from the observation space.
        instance: an instance to try it on.

    Raises:
        ValueError: no array can be made; the message says what to do.
    """
    observe = observe or _observe_space(env.observation_space)
    raw, _ = env.reset(**reset_arguments(instance))
    seen = np.asarray(observe(raw))
    if seen.dtype == object or seen.ndim not in (1, 3):
        raise ValueError(
            f"observations have the shape {seen.shape} and the type {seen.dtype}; networks need a vector or a picture "
            "(channels, rows, columns): write observe=..."
        )
    return Observer(observe, seen.shape, np.uint8 if seen.dtype == np.uint8 else np.float32)


def _observe_space(space: spaces.Space[Any]) -> Callable[[Any], Observation]:
    if isinstance(space, spaces.Box) and len(space.shape) == 3:
        last = space.shape[-1] <= 4 < space.shape[0]  # pictures usually have their channels last
        return (lambda picture: np.moveaxis(picture, -1, 0)) if last else np.asarray
    if isinstance(space, spaces.Box) and len(space.shape) == 2:
        return lambda picture: np.asarray(picture)[None]
    if not space.is_np_flattenable:
        raise ValueError(f"observations of the space {space} cannot become a vector: write observe=...")
    return lambda observation: np.asarray(spaces.flatten(space, observation), np.float32)


def action_table(env: Env, given: Sequence[str] | Mapping[str, Any] | None) -> dict[str, Any]:
    """Return each action of an environment by its name, in the order of their numbers.

    Raises:
        ValueError: the names do not fit the environment's actions; the message says what to write.
    """
    if isinstance(given, Mapping):
        return dict(given)
    space = env.action_space
    if not isinstance(space, spaces.Discrete):
        raise ValueError(
            f"the actions are {space}, not numbers: give each action a name, such as "
            'actions={"left": [-1.0], "right": [1.0]}'
        )
    names = list(given) if given is not None else _own_names(env, int(space.n))
    if len(names) != space.n:
        raise ValueError(f"the environment has {space.n} actions, but {len(names)} names are given")
    if len(set(names)) != len(names):
        raise ValueError("two actions have the same name")
    return dict(zip(names, range(int(space.start), int(space.start + space.n)), strict=True))


def _own_names(env: Env, n: int) -> list[str]:
    """Return the environment's own names of actions (as Atari and MiniGrid have them), else numbers."""
    inner: Any = env.unwrapped
    if hasattr(inner, "get_action_meanings"):
        return [str(name).lower() for name in inner.get_action_meanings()]
    if hasattr(inner, "actions") and len(list(inner.actions)) >= n:
        return [str(getattr(one, "name", one)) for one in list(inner.actions)[:n]]
    return [f"action_{number}" for number in range(n)]
