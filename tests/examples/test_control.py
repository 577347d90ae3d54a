"""The control example: its pendulum, its oracle, and what is learned from it."""

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples.kit import success_after
from tests.learner.kit import examples
from waypost_control import (
    GRAVITY,
    HOLD,
    REPEAT,
    STRENGTH,
    TORQUES,
    angle_and_speed,
    catchable,
    good_actions,
    reached,
    upright_pendulum,
)

from waypost_learner.rollout.simulator import Simulator

DOMAIN = "waypost_control:upright_pendulum"
HORIZONS = upright_pendulum.horizons
seeds = st.integers(0, 2**31 - 1)
actions = st.integers(0, len(TORQUES) - 1)


@examples
@given(seeds, st.lists(actions, max_size=30))
def test_the_same_actions_give_the_same_states_and_observations(seed: int, said: list[int]) -> None:
    first, second = Simulator(upright_pendulum), Simulator(upright_pendulum)
    states = [(first.reset(seed), second.reset(seed))]
    states += [(first.step(action), second.step(action)) for action in said if not first.ended]
    assert all(one.view == other.view for one, other in states)
    assert all(np.array_equal(one.observation, other.observation) for one, other in states)


@examples
@given(seeds, st.sampled_from(list(TORQUES)))
def test_an_action_accelerates_the_pendulum_as_the_constants_say(seed: int, name: str) -> None:
    env = upright_pendulum.make_env()
    env.reset(options={"instance": seed})
    angle, speed = angle_and_speed(env.inner)
    env.step(np.int64(list(TORQUES).index(name)))
    for _ in range(REPEAT):
        speed += (GRAVITY * math.sin(angle) + STRENGTH * TORQUES[name]) * 0.05
        angle += speed * 0.05
    assert angle_and_speed(env.inner) == pytest.approx((math.remainder(angle, 2 * math.pi), speed), abs=1e-5)


@examples
@given(seeds, st.lists(actions, max_size=30))
def test_a_good_subgoal_is_not_reached_where_it_is_chosen(seed: int, said: list[int]) -> None:
    simulator = Simulator(upright_pendulum)
    view = simulator.reset(seed).view
    for action in said:
        view = simulator.step(action).view if not simulator.ended else view
    for subgoal in upright_pendulum.oracle.good_subgoals(seed, view):
        name = upright_pendulum.subgoals[subgoal]
        assert not reached(view, view, name)
        assert good_actions(view, view, name)


@examples
@given(st.floats(-0.6, 0.6), st.floats(-3, 3))
def test_what_is_catchable_is_held_for_a_second(angle: float, speed: float) -> None:
    start = {"angle": angle, "speed": speed, "turned": False, "held": 0}
    if not catchable(start):
        return
    env = upright_pendulum.make_env()
    env.reset(options={"instance": 0})
    env.inner.unwrapped.state = np.array([angle, speed])
    state = start
    for _ in range(3 * HOLD):
        if upright_pendulum.succeeded(env):
            break
        [name] = good_actions(start, state, "hold")
        env.step(np.int64(upright_pendulum.actions.index(name)))
        state = upright_pendulum.state_view(env)
    assert upright_pendulum.succeeded(env)


def test_pictures_show_the_torque() -> None:
    env = upright_pendulum.make_env()
    env.reset(options={"instance": 0})
    before = upright_pendulum.frame(env)
    env.step(np.int64(0))
    assert before.shape == (500, 500, 3)
    assert not np.array_equal(before, upright_pendulum.frame(env))


def test_a_short_run_learns_to_swing_up(tmp_path: Path) -> None:
    assert success_after(0, DOMAIN, tmp_path) < 0.1
    assert success_after(20, DOMAIN, tmp_path, warm_start=16) > 0.2
