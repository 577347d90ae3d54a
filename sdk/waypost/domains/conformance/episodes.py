"""Checks of a domain's episodes: observations, views, ends, and whether trajectories can be carried out again."""

import copy
import json
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np

from waypost.domains.contract import Domain
from waypost.domains.parts import Restorable, replay_of
from waypost.trajectory import Action

TRIALS = 3  # instances that are tried
LARGEST_VIEW = 100_000  # characters of one view


@dataclass(frozen=True)
class Episode:
    """What was seen in one episode, from its start."""

    observations: list[Any]
    views: list[Any]
    rewards: list[float]
    snapshots: list[Any]
    ended: bool


def random_actions(domain: Domain, seed: int) -> list[Action]:
    """Return as many random actions as an episode may have."""
    rng = np.random.default_rng(seed)
    return [int(action) for action in rng.integers(len(domain.actions), size=domain.horizons.full)]


def episode(domain: Domain, env: gymnasium.Env[Any, Any], instance: Any, actions: list[Action]) -> Episode:
    """Carry out actions on an instance until it ends."""
    observation, _ = env.reset(options={"instance": instance})
    snapshot = domain.snapshot if isinstance(domain, Restorable) else lambda _: None
    seen = Episode([observation], [domain.state_view(env)], [], [snapshot(env)], False)
    for action in actions:
        observation, reward, terminated, truncated, _ = env.step(np.int64(action))
        seen.observations.append(observation)
        seen.views.append(domain.state_view(env))
        seen.rewards.append(float(reward))
        seen.snapshots.append(snapshot(env))
        if terminated or truncated:
            return Episode(seen.observations, seen.views, seen.rewards, seen.snapshots, True)
    return seen


def trials(domain: Domain) -> Iterator[tuple[Any, list[Action]]]:
    """Yield some training instances with random actions for each."""
    for number, instance in zip(range(TRIALS), domain.instances("random").train, strict=False):
        yield instance, random_actions(domain, number)


def observes_arrays(domain: Domain) -> Iterator[str]:
    """Every observation is a finite array of the declared shape."""
    env = domain.make_env()
    for instance, actions in trials(domain):
        for observation in episode(domain, env, instance, actions[:20]).observations:
            if not isinstance(observation, np.ndarray):
                yield f"An observation is {type(observation).__name__}; return a numpy array."
                return
            if observation.dtype not in (np.float32, np.uint8):
                yield f"Observations have the type {observation.dtype}; return float32 or uint8."
                return
            if observation.shape != tuple(domain.observation_shape):
                yield (
                    f"An observation has the shape {observation.shape}, but observation_shape is "
                    f"{tuple(domain.observation_shape)}; make them equal."
                )
                return
            if not np.isfinite(observation).all():
                yield "An observation contains nan or infinity; networks cannot learn from it."
                return


def is_json(domain: Domain) -> Iterator[str]:
    """Views survive the way through JSON, and are small."""
    env = domain.make_env()
    for instance, actions in trials(domain):
        seen = episode(domain, env, instance, actions[:20])
        for name, view in [("instance_view", domain.instance_view(instance)), *(("state_view", v) for v in seen.views)]:
            try:
                text = json.dumps(view, allow_nan=False)
            except (TypeError, ValueError) as error:
                yield f"{name} returns what JSON cannot hold ({error}); return numbers, texts, lists and dicts of them."
                return
            if json.loads(text) != view:
                yield (
                    f"{name} changes on its way through JSON: {view!r} becomes {json.loads(text)!r}; "
                    "use lists instead of tuples, and texts as keys."
                )
                return
            if len(text) > LARGEST_VIEW:
                yield (
                    f"{name} has {len(text):,} characters, and each query keeps one for each step; "
                    "leave out what no expert needs."
                )
                return


def starts_unsolved(domain: Domain) -> Iterator[str]:
    """The task is not accomplished before the first action."""
    env = domain.make_env()
    for instance, _ in trials(domain):
        env.reset(options={"instance": instance})
        done: Any = domain.succeeded(env)
        if not isinstance(done, bool | np.bool_):
            yield f"succeeded returns {done!r}; return True or False."
            return
        if done:
            yield f"succeeded is true at the start of the instance {domain.instance_view(instance)}; leave it out."
            return


def ends_in_time(domain: Domain) -> Iterator[str]:
    """An episode is not longer than H_FULL."""
    env = domain.make_env()
    for instance, actions in trials(domain):
        if not episode(domain, env, instance, actions).ended:
            yield (
                f"An episode did not end within {domain.horizons.full} actions, which is horizons.full; "
                "truncate it in step, or raise horizons.full."
            )
            return


def keeps_what_it_returned(domain: Domain) -> Iterator[str]:
    """A value that was returned is not changed by later steps."""
    env = domain.make_env()
    for instance, actions in trials(domain):
        observation, _ = env.reset(options={"instance": instance})
        view = domain.state_view(env)
        before = copy.deepcopy((observation, view))
        for action in actions[:20]:
            _, _, terminated, truncated, _ = env.step(np.int64(action))
            if terminated or truncated:
                break
        if not np.array_equal(before[0], observation):
            yield "step changes an observation that was returned earlier; return a copy."
            return
        if before[1] != view:
            yield "step changes a state_view that was returned earlier; return a copy."
            return


def is_deterministic(domain: Domain) -> Iterator[str]:
    """A trajectory can be carried out again, in the way that the domain declares."""
    try:
        replay = replay_of(domain)
    except ValueError as error:
        yield f"{error}."
        return
    for instance, actions in trials(domain):
        first = episode(domain, domain.make_env(), instance, actions)
        if replay == "actions":
            difference = next(_differences(first, episode(domain, domain.make_env(), instance, actions)), None)
            if difference is not None:
                yield difference
                return
        elif replay == "snapshots" and isinstance(domain, Restorable):
            env = domain.make_env()
            env.reset(options={"instance": instance})
            middle = (len(first.views) - 1) // 2
            domain.restore(env, first.snapshots[middle])
            if domain.state_view(env) != first.views[middle]:
                yield "restore does not bring back the state of the snapshot: state_view differs; restore all of it."
                return


def _differences(first: Episode, second: Episode) -> Iterator[str]:
    """Yield the differences between two episodes with the same actions."""
    advice = (
        'draw everything random from the seed of reset, or declare replay="snapshots" or replay="recorded" '
        "(waypost.domains.Replay)"
    )
    for step, (one, other) in enumerate(zip(first.views, second.views, strict=False)):
        if one != other or not np.array_equal(first.observations[step], second.observations[step]):
            when = "reset" if step == 0 else f"{step} actions"
            yield f"The same instance and actions gave another state after {when}; {advice}."
            return
    if len(first.views) != len(second.views) or first.rewards != second.rewards:
        yield f"The same instance and actions gave another end or another reward; {advice}."
