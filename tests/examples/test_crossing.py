"""The crossing example: its rules, and what the preset `general` finds in a domain that declares nothing."""

import copy
from typing import Any

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples
from waypost_crossing import MOVES, SIDE, cell, lava_crossing, reached, state, succeeded, successor

from waypost.domains import Centered, Cropped, Placed, Relabeling, Symmetric, Viewed
from waypost_learner.algorithms import find_algorithm
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import build_learner

seeds = st.integers(0, 2**31 - 1)
actions = st.lists(st.sampled_from(list(MOVES)), max_size=40)


@examples
@given(seeds, actions)
def test_its_rules_are_those_of_the_environment(seed: int, actions: list[str]) -> None:
    """The oracle searches with `successor`, so it must say what MiniGrid does."""
    env = lava_crossing.make_env()
    observation, _ = env.reset(options={"instance": seed})
    for action in actions:
        expected = successor(state(env.inner), action)
        observation, _, terminated, truncated, _ = env.step(np.int64(list(MOVES).index(action)))
        assert state(env.inner) == expected
        agent = np.argwhere(observation[3])
        assert agent[:, ::-1].tolist() == [expected["agent"]]
        assert terminated == (cell(expected) != ".")
        if terminated or truncated:
            break


@examples
@given(seeds, actions)
def test_a_box_of_an_action_is_the_cell_that_it_leads_to(seed: int, actions: list[str]) -> None:
    now = Simulator(lava_crossing).reset(seed).view
    for action in actions:
        boxes = lava_crossing.action_landmarks(seed, now)
        after = successor(now, action)
        box = boxes.get(list(MOVES).index(action))
        assert (box is None) == (after == now), "a wall, or lava, keeps the agent where it is"
        if box is not None:
            assert [round(box[0] * SIDE), round(box[1] * SIDE)] == after["agent"]
            assert [round(box[2] * SIDE), round(box[3] * SIDE)] == [place + 1 for place in after["agent"]]
        now = after


@pytest.mark.parametrize("seed", range(20))
def test_each_subgoal_of_a_demonstration_ends_where_it_is_reached(seed: int) -> None:
    simulator = Simulator(lava_crossing)
    now = simulator.reset(seed).view
    segments = OracleExpert(lava_crossing).demonstrate(seed, now).segments
    for segment in segments:
        origin = copy.deepcopy(now)
        for action in segment.actions:
            assert not reached(origin, now, str(segment.subgoal))
            now = simulator.step(list(MOVES).index(action)).view
        assert reached(origin, now, str(segment.subgoal))
    assert succeeded(now)


def test_it_declares_no_structure() -> None:
    assert not isinstance(lava_crossing, Centered | Cropped | Placed | Relabeling | Symmetric | Viewed)


def test_general_finds_the_agent_and_the_reflection_that_swaps_right_and_down() -> None:
    briefly = "train_shared.least=1 train_shared.most=1 train_shared.idle=0"
    config = TrainConfig("hg-dagger", domain="waypost_crossing:lava_crossing", preset="general", values=briefly)
    learner: Any = build_learner(config, threads=1)
    algorithm, expert = find_algorithm("hg-dagger"), OracleExpert(lava_crossing)
    for seed in range(6):
        s = learner.start(seed, seed)
        translator, queries = Translator(lava_crossing, s.instance), algorithm.warm_start(s, learner)
        ask = translator.ask(next(queries), seed, 0)
        with pytest.raises(StopIteration) as done:
            queries.send(translator.answer(expert(ask)))
        learner.learn(done.value.value)
    pictures = np.stack([Simulator(lava_crossing).reset(seed).observation for seed in range(100, 110)])
    found = learner.shared.network.finder.find(torch.from_numpy(pictures))
    assert found.tolist() == [[1, 1]] * 10
    assert [one.subgoals for one in learner.shared.symmetries] == [(1, 0, 2)]
    [only] = learner.shared.symmetries
    np.testing.assert_array_equal(only.observe(pictures[0]), pictures[0].swapaxes(1, 2))
    assert [list(MOVES)[only.actions[list(MOVES).index(one)]] for one in ("right", "down")] == ["down", "right"]
