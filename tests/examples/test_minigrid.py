"""The MiniGrid example: its environment, its oracle, and what is learned from it."""

import copy
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples, store
from waypost_minigrid import good_actions, good_subgoals, reached, state, succeeded, unlock_pickup

from waypost.trajectory import Trajectory
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Query
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.presets import find_preset
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.checkpoints import load
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.evaluation import evaluate
from waypost_learner.runs.setup import build_learner
from waypost_learner.runs.training import train

DOMAIN = "waypost_minigrid:unlock_pickup"
HORIZONS = unlock_pickup.horizons
seeds = st.integers(0, 2**31 - 1)
actions = st.lists(st.integers(0, len(unlock_pickup.actions) - 1), max_size=30)


def demonstrated_actions(seed: int) -> list[int]:
    """The actions of the oracle's demonstration."""
    demonstration = OracleExpert(unlock_pickup).demonstrate(seed, Simulator(unlock_pickup).reset(seed).view)
    return [unlock_pickup.actions.index(action) for one in demonstration.segments for action in one.actions]


@pytest.mark.filterwarnings("ignore:.*infinity:UserWarning")  # observations of any domain may be any numbers
def test_the_environment_passes_gymnasiums_checker() -> None:
    check_env(unlock_pickup.make_env(), skip_render_check=True)


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
def test_the_oracle_solves_instances_within_the_horizons(instances: str) -> None:
    expert = OracleExpert(unlock_pickup)
    for seed in getattr(unlock_pickup.instances("random"), instances)[:25]:
        simulator = Simulator(unlock_pickup)
        demonstration = expert.demonstrate(seed, simulator.reset(seed).view)
        for action in demonstrated_actions(seed):
            simulator.step(action)
        assert simulator.succeeded
        assert [one.subgoal for one in demonstration.segments] == ["get_key", "open_door", "drop_key", "pick_up_box"]
        assert max(len(one.actions) for one in demonstration.segments) <= HORIZONS.lo
        assert simulator.steps <= HORIZONS.full


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


def test_every_kind_of_query_is_answered() -> None:
    learner = Learner(unlock_pickup, find_preset("lean"), seed=0, threads=1)
    s = learner.start(5, 0)
    sigma: Trajectory = learner.roll_out(s)
    queries: list[Query] = [
        HierDemo(s.state),
        InspectFull(sigma),
        LabelHi(sigma),
        InspectLo(sigma[0]),
        LabelLo(sigma[0]),
        LabelFull(sigma),
    ]
    translator, expert = Translator(unlock_pickup, 5), OracleExpert(unlock_pickup)
    asks = [translator.ask(query, 0, ordinal) for ordinal, query in enumerate(queries)]
    answers = [expert(ask) for ask in asks]
    assert [answer.kind for answer in answers] == [ask.kind for ask in asks]
    demonstration = translator.answer(answers[0])
    assert succeeded(demonstration[-1].states[-1].view)  # type: ignore[union-attr,index]
    assert translator.answer(answers[1]) is False
    assert len(translator.answer(answers[2])) == len(sigma)  # type: ignore[arg-type]
    assert len(translator.answer(answers[5])) == sum(len(one.actions) for one in sigma)  # type: ignore[arg-type]


def test_a_short_run_of_hg_dagger_learns(tmp_path: Path) -> None:
    values = (
        "choosing.temperature=0.3 train_hi.idle=0 train_lo.idle=0 train_hi.averaging=0.98 train_lo.averaging=0.98 "
        "train_hi.least=1920 train_hi.most=1920 train_lo.least=1920 train_lo.most=1920"
    )
    config = TrainConfig("hg-dagger", domain=DOMAIN, episodes=13, warm_start=10, values=values)
    untrained = build_learner(config, threads=1)
    unseen = unlock_pickup.instances("random").test
    assert evaluate(untrained, unseen, 50).successes == 0
    with store(tmp_path / "runs") as (connection, options):
        summary = train(config, connection, options)
    trained = build_learner(config, threads=1)
    load(options.checkpoints / f"{summary['run']}.safetensors", trained)
    assert evaluate(trained, unseen, 50).success_rate > 0.15
    assert all(summary["cost"]["by_kind"][kind] > 0 for kind in ("hier_demo", "inspect_full", "label_hi"))
