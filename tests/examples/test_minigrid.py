"""The MiniGrid example: its environment, its oracle, and what is learned from it."""

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples.kit import success_after
from tests.learner.kit import examples
from waypost_minigrid import OBJECTS, good_actions, good_subgoals, reached, state, succeeded, unlock_pickup

from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.rollout.simulator import Simulator

DOMAIN = "waypost_minigrid:unlock_pickup"
HORIZONS = unlock_pickup.horizons
seeds = st.integers(0, 2**31 - 1)
actions = st.lists(st.integers(0, len(unlock_pickup.actions) - 1), max_size=30)


def demonstrated_actions(seed: int) -> list[int]:
    """The actions of the oracle's demonstration."""
    demonstration = OracleExpert(unlock_pickup).demonstrate(seed, Simulator(unlock_pickup).reset(seed).view)
    return [unlock_pickup.actions.index(action) for one in demonstration.segments for action in one.actions]


@examples
@given(seeds, actions)
def test_a_landmark_frames_its_object_in_the_picture(seed: int, actions: list[int]) -> None:
    env: Any = unlock_pickup.make_env()
    env.reset(options={"instance": seed})
    for action in actions:
        env.step(np.int64(action))
    base = env.unwrapped.inner.unwrapped
    rows, columns, _ = unlock_pickup.frame(env).shape
    assert columns / rows == base.width / base.height
    boxes = unlock_pickup.landmarks(seed, unlock_pickup.state_view(env))
    framed = {g: base.grid.get(round(box[0] * base.width), round(box[1] * base.height)) for g, box in boxes.items()}
    things = [OBJECTS.get(name) for name in unlock_pickup.subgoals]
    assert all(thing.type == things[g] for g, thing in framed.items())
    assert len(framed) == sum(one is not None and one.type in things for one in base.grid.grid)


@examples
@given(seeds, actions)
def test_boxes_of_actions_are_beside_and_ahead_of_the_agent_and_name_what_changes_the_state(
    seed: int, actions: list[int]
) -> None:
    env: Any = unlock_pickup.make_env()
    env.reset(options={"instance": seed})
    for action in actions:
        env.step(np.int64(action))
    before = unlock_pickup.state_view(env)
    boxes = unlock_pickup.action_landmarks(seed, before)
    named = {unlock_pickup.actions[action]: box for action, box in boxes.items()}
    assert {"left", "right"} <= set(named)
    ahead = [box for name, box in named.items() if name not in ("left", "right")]
    column, row = env.unwrapped.inner.unwrapped.front_pos
    assert ahead == [pytest.approx((column / 11, row / 6, (column + 1) / 11, (row + 1) / 6))] * len(ahead)
    for action in set(boxes) - {unlock_pickup.actions.index("toggle")}:  # a locked door stays as it is without the key
        other: Any = unlock_pickup.make_env()
        other.reset(options={"instance": seed})
        for one in [*actions, action]:
            other.step(np.int64(one))
        assert unlock_pickup.state_view(other) != before


@examples
@given(seeds, actions)
def test_the_same_actions_give_the_same_states_and_observations(seed: int, actions: list[int]) -> None:
    runs = []
    for _ in range(2):
        simulator = Simulator(unlock_pickup)
        seen = [simulator.reset(seed)]
        for action in actions:
            if not simulator.ended:
                seen.append(simulator.step(action))
        runs.append(([one.view for one in seen], np.stack([one.observation for one in seen]).tobytes()))
    assert runs[0] == runs[1]


@examples
@given(seeds, st.integers(0, 25), actions, st.data())
def test_the_good_choices_solve_every_state_that_actions_lead_to(
    seed: int, demonstrated: int, actions: list[int], data: st.DataObject
) -> None:
    simulator = Simulator(unlock_pickup)
    now = simulator.reset(seed).view
    for action in [*demonstrated_actions(seed)[:demonstrated], *actions]:
        if not simulator.ended:
            now = simulator.step(action).view
    for _ in range(HORIZONS.hi):
        if simulator.ended:  # solved, or the actions opened the box
            break
        [subgoal] = good_subgoals(now)
        origin = now
        assert not reached(origin, now, subgoal)
        while not reached(origin, now, subgoal) and not simulator.ended:
            action = data.draw(st.sampled_from(good_actions(origin, now, subgoal)))
            now = simulator.step(unlock_pickup.actions.index(action)).view
    assert succeeded(now) or now["box"] is None


@pytest.mark.parametrize("instances", ["train", "test"])
def test_the_oracle_takes_the_subgoals_in_the_order_of_the_mission(instances: str) -> None:
    expert = OracleExpert(unlock_pickup)
    for seed in getattr(unlock_pickup.instances("random"), instances)[:25]:
        demonstration = expert.demonstrate(seed, Simulator(unlock_pickup).reset(seed).view)
        assert [one.subgoal for one in demonstration.segments] == ["get_key", "open_door", "drop_key", "pick_up_box"]


def fewest_actions(env: Any, subgoal: str) -> int:
    """The length of a shortest path to a subgoal, by a search in copies of MiniGrid."""
    origin = state(env)
    seen, level, steps = {json.dumps(origin)}, [env], 0
    while not any(reached(origin, state(one), subgoal) for one in level):
        following = []
        for one in level:
            for action in range(len(unlock_pickup.actions)):
                after = copy.deepcopy(one)
                after.step(action)
                key = json.dumps(state(after))
                if key not in seen:
                    seen.add(key)
                    following.append(after)
        level, steps = following, steps + 1
    return steps


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_demonstrated_segments_are_as_short_as_minigrid_allows(seed: int) -> None:
    env = unlock_pickup.make_env()
    env.reset(options={"instance": seed})
    demonstration = OracleExpert(unlock_pickup).demonstrate(seed, unlock_pickup.state_view(env))
    for segment in demonstration.segments[:3]:
        assert len(segment.actions) == fewest_actions(env.inner.unwrapped, str(segment.subgoal))
        for action in segment.actions:
            env.step(unlock_pickup.actions.index(action))


def test_opening_the_box_ends_the_episode_without_success() -> None:
    simulator = Simulator(unlock_pickup)
    simulator.reset(0)
    for action in [*demonstrated_actions(0)[:-1], unlock_pickup.actions.index("toggle")]:
        assert not simulator.ended
        simulator.step(action)
    assert (simulator.final, simulator.succeeded, simulator.reward) == (True, False, 0)


def test_the_picture_shows_the_carried_object() -> None:
    env = unlock_pickup.make_env()
    env.reset(options={"instance": 0})
    corners = []
    for action in demonstrated_actions(0):
        corners.append((unlock_pickup.state_view(env)["carrying"], unlock_pickup.frame(env)[:32, :32].tobytes()))
        env.step(action)
    empty = {corner for held, corner in corners if held is None}
    full = {corner for held, corner in corners if held == "key"}
    assert len(empty) == len(full) == 1
    assert empty != full


def test_a_short_run_learns(tmp_path: Path) -> None:
    values = (
        "choosing.temperature=0.3 train_hi.idle=0 train_lo.idle=0 train_hi.averaging=0.98 train_lo.averaging=0.98 "
        "train_hi.least=1920 train_hi.most=1920 train_lo.least=1920 train_lo.most=1920"
    )
    assert success_after(0, DOMAIN, tmp_path, values=values) == 0
    assert success_after(13, DOMAIN, tmp_path, warm_start=10, values=values) > 0.15
