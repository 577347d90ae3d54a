"""The first room of Montezuma's Revenge: the game, the landmarks, and learning in it."""

import json
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given
from tests.learner.domains.montezuma_kit import carried_out, domain, few, instances, oracle, played, simulator, walks
from tests.learner.kit import store
from typer.testing import CliRunner

from waypost.domains.conformance import check_domain
from waypost_learner.algorithms import ALGORITHMS
from waypost_learner.cli import app
from waypost_learner.domains.montezuma.env import Instance, MontezumaEnv
from waypost_learner.domains.montezuma.game import ACTIONS
from waypost_learner.domains.montezuma.landmarks import DOOR, KEY, STAIR
from waypost_learner.domains.montezuma.views import changed, figure_at
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.labels import Labels
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.policy_keys import pi
from waypost_learner.runs.checkpoints import load
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import build_learner
from waypost_learner.runs.training import train


def test_it_keeps_the_contract_and_gymnasiums_checker_finds_nothing() -> None:
    results = check_domain("montezuma")
    assert len(results) > 10
    assert [result for result in results if result.failures] == []
    check_env(MontezumaEnv(), skip_render_check=True)


@few
@given(instances, walks)
def test_the_same_actions_lead_to_the_same_states_again(instance: Instance, walk: list[tuple[int, int]]) -> None:
    first, again = (played(instance, carried_out(walk)) for _ in range(2))
    assert [state.view for state in first] == [state.view for state in again]
    assert all((one.observation == other.observation).all() for one, other in zip(first, again, strict=True))


@few
@given(instances, walks)
def test_the_view_of_a_state_is_small_and_survives_json(instance: Instance, walk: list[tuple[int, int]]) -> None:
    for state in played(instance, carried_out(walk)):
        text = json.dumps(state.view)
        assert json.loads(text) == state.view
        assert len(text) < 200


@few
@given(instances, walks)
def test_an_observation_has_the_last_four_pictures_the_newest_last(
    instance: Instance, walk: list[tuple[int, int]]
) -> None:
    states = played(instance, carried_out(walk))
    for before, after in pairwise(states):
        assert (after.observation[:-1] == before.observation[1:]).all()


@few
@given(instances, walks)
def test_the_small_view_shows_the_brightest_of_each_four_pixels_that_differ_from_the_empty_room(
    instance: Instance, walk: list[tuple[int, int]]
) -> None:
    *_, state = played(instance, carried_out(walk))
    seen, whole = domain.lo_view.observe(state.observation), changed(state.observation)
    assert (seen.dtype, seen.shape) == (np.uint8, domain.lo_view.shape)
    np.testing.assert_array_equal(seen, whole.reshape(2, 42, 2, 42, 2).max(axis=(2, 4)))
    assert 5 < np.count_nonzero(seen[1] > 30) < 100  # the figure and the skull, but not the room


@few
@given(instances, walks)
def test_the_centered_view_finds_the_figure_where_the_games_memory_says(
    instance: Instance, walk: list[tuple[int, int]]
) -> None:
    misses = []
    for state in played(instance, carried_out(walk)):
        if state.view["dying"]:
            break
        seen = domain.centered_view.observe(state.observation)
        assert (seen.dtype, seen.shape) == (np.uint8, domain.centered_view.shape)
        np.testing.assert_array_equal(seen[2:], domain.lo_view.observe(state.observation))
        misses.append(miss(state))
    assert np.median(misses) < 2


@pytest.mark.parametrize("noops", [0, 7, 13])
def test_the_figure_is_found_on_the_whole_way_to_the_door(noops: int) -> None:
    state, subgoal, misses = simulator.reset(Instance(noops)), 0, []
    while not simulator.ended:
        misses.append(miss(state))
        if oracle.reached(None, None, state.view, subgoal):
            subgoal = oracle.good_subgoals(None, state.view)[0]
        state = simulator.step(oracle.good_actions(None, None, state.view, subgoal)[0])
    assert len(misses) > 100
    assert np.mean(np.array(misses) <= 3) > 0.97


def miss(state: Any) -> float:
    """By how many pixels of 84x84 the figure is not where the game's memory says."""
    x, y = 0.5266 * state.view["x"] + 1.12, 127.97 - 0.4055 * state.view["y"]
    row, column = figure_at(changed(state.observation)[-1])
    return float(max(abs(row - y), abs(column - x)))


def test_no_ops_decide_where_the_skull_is() -> None:
    skulls = {tuple(simulator.reset(Instance(noops)).view["skull"]) for noops in range(20)}
    assert len(skulls) == 20


# --- landmarks


def test_the_detectors_agree_with_the_games_memory() -> None:
    start, beside_key, noop = simulator.reset(Instance(0)).observation[-1], 0, ACTIONS.index("noop")
    for instance in domain.instances("slips").train[:12]:
        env, subgoal, ended = domain.make_env(), -1, False
        picture = env.reset(options={"instance": instance})[0][-1]
        while not ended:
            view = domain.state_view(env)
            assert view["at_stair"] == STAIR.changed(picture, start)
            if view["at_stair"]:
                assert 125 <= view["x"] <= 133
                assert 148 <= view["y"] <= 160
            if view["key"]:
                assert KEY.changed(picture, start)
            beside_key += KEY.changed(picture, start) and not view["key"]
            if subgoal < 0 or oracle.reached(None, None, view, subgoal):
                subgoal = oracle.good_subgoals(None, view)[0]
            good = oracle.good_actions(None, None, view, subgoal)
            (*_, picture), _, ended, *_ = env.step(np.int64(good[0] if good else noop))
        opened = domain.succeeded(env)
        (*_, picture), *_ = env.step(np.int64(noop))
        assert opened == DOOR.changed(picture, start)  # the picture shows the open door one step later
    assert beside_key <= 12  # at most one step before the key is taken


def test_each_subgoal_has_its_detectors_box_in_the_picture() -> None:
    env = domain.make_env()
    env.reset(options={"instance": Instance(0)})
    rows, columns, _ = domain.frame(env).shape
    boxes = domain.landmarks(domain.instance_view(Instance(0)), domain.state_view(env))
    pixels = {
        domain.subgoals[g]: (round(left * columns), round(top * rows), round(right * columns), round(bottom * rows))
        for g, (left, top, right, bottom) in boxes.items()
    }
    stair = (263, 170, 278, 178)
    assert (rows, columns) == (210, 320)
    assert pixels == {"stair": stair, "key": (27, 102, 42, 112), "stair_back": stair, "door": (267, 50, 278, 88)}


# --- learning and commands


QUICK = " ".join(f"train_{level}.{value}" for level in ("hi", "lo", "flat") for value in ("least=64", "most=64"))


@pytest.mark.parametrize("algorithm", ALGORITHMS)
def test_every_algorithm_trains_on_it(algorithm: str, tmp_path: Path) -> None:
    levels = ALGORITHMS[algorithm].levels
    wanted = [one for one in QUICK.split() if one.startswith("train_flat") == levels.flat and not levels.q_lo]
    warm_start = 1 if ALGORITHMS[algorithm].interactive else None
    config = TrainConfig(
        algorithm, domain="montezuma", episodes=2, warm_start=warm_start, values=" ".join(wanted) or None
    )
    with store(tmp_path / "runs") as (connection, options):
        summary = train(config, connection, options)
    assert summary["episodes"] == 2
    costs = summary["cost"]["by_kind"]
    assert (costs["hier_demo"] > 130) == (algorithm in ("h-bc", "flat-bc") or warm_start == 1)


def test_without_the_emulator_one_sentence_says_what_to_install() -> None:
    without = "import sys; sys.modules['ale_py'] = None; from waypost_learner.cli import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", without, "train", "h-bc", "--domain", "montezuma"], capture_output=True, text=True
    )
    assert done.returncode == 2
    assert done.stderr == "This needs the package ale_py: install it with `pip install 'waypost[atari]'`.\n"


def test_the_command_says_that_a_domain_has_nothing_to_compute(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["domain", "build", "maze", str(tmp_path / "file")])
    assert done.exit_code == 2
    assert done.output == "The domain 'maze' has no data to compute.\n"


def test_the_hybrid_begins_with_demonstrations_and_learns_from_them(tmp_path: Path) -> None:
    values = "warm_start_hybrid=2 train_hi_hybrid.least=64 train_hi_hybrid.most=64"
    config = TrainConfig("hg-dagger-q", domain="montezuma", episodes=3, values=values)
    learner = build_learner(config, threads=1)
    warm = list[bool]()
    with store(tmp_path / "runs") as (connection, options):
        summary = train(config, connection, options, on_episode=lambda result, _units: warm.append(result.warm_start))
        load(options.checkpoints / f"{summary['run']}.safetensors", learner)
    assert warm == [True, True, False]
    assert summary["cost"]["by_kind"]["hier_demo"] > 2 * 130
    instance = Instance(0)
    start, answer = simulator.reset(instance), OracleExpert(domain).demonstrate
    demonstration = Translator(domain, instance).answer(answer(domain.instance_view(instance), start.view))
    labels = Labels()
    labels.append_demonstration(demonstration)  # type: ignore[arg-type]
    learner.learn(labels)
    lengths = [len(segment.actions) for segment in demonstration]  # type: ignore[union-attr]
    assert [len(learner.q[pi(g)].replay) for g in range(4)] == lengths
    assert all(learner.q[pi(g)].succeeded for g in range(4))
