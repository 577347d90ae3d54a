"""The first room of Montezuma's Revenge: the game, the landmarks, and the expert that was computed for it."""

import json
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.learner.kit import store
from typer.testing import CliRunner

from waypost.domains.conformance import check_domain
from waypost_learner.algorithms import ALGORITHMS
from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.cli import app
from waypost_learner.domains.montezuma import table
from waypost_learner.domains.montezuma.domain import MontezumaDomain
from waypost_learner.domains.montezuma.env import Instance, MontezumaEnv
from waypost_learner.domains.montezuma.expert import build, collisions, graph, planning
from waypost_learner.domains.montezuma.game import ACTIONS, Game, Memory
from waypost_learner.domains.montezuma.landmarks import DOOR, KEY, STAIR
from waypost_learner.domains.montezuma.views import changed, figure_at
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.labels import Labels, rows_of
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.policy_keys import pi
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.checkpoints import load
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import build_learner
from waypost_learner.runs.training import train

domain = MontezumaDomain()
oracle = domain.oracle
simulator = Simulator(domain)
few = settings(max_examples=25, deadline=None)
instances = st.builds(
    Instance, st.integers(0, 19), st.sampled_from([0.0, 0.05]), st.sampled_from([0.0, 0.25]), st.integers(0, 99)
)
walks = st.lists(st.tuples(st.integers(0, len(ACTIONS) - 1), st.integers(1, 12)), max_size=12)


def carried_out(walk: list[tuple[int, int]]) -> list[int]:
    """Each action of a walk as often as the walk says."""
    return [action for action, times in walk for _ in range(times)]


def played(instance: Instance, actions: list[int]) -> list[Any]:
    """The states along actions, until the episode ends."""
    states = [simulator.reset(instance)]
    for action in actions:
        if simulator.ended:
            break
        states.append(simulator.step(action))
    return states


def expert_plays(instance: Instance) -> tuple[bool, list[str], list[Any]]:
    """The oracle plays an episode: whether the door opens, the subgoals it chose, and the views."""
    views, subgoals, subgoal = [simulator.reset(instance).view], list[int](), -1
    while not simulator.ended and len(views) < 600:
        if subgoal < 0 or oracle.reached(None, None, views[-1], subgoal):
            subgoal = oracle.good_subgoals(None, views[-1])[0]
            subgoals.append(subgoal)
        good = oracle.good_actions(None, None, views[-1], subgoal)
        views.append(simulator.step(good[0] if good else 0).view)
    return simulator.succeeded, [domain.subgoals[one] for one in subgoals], views


def test_a_demonstration_that_a_slip_spoils_ends_there_and_is_not_taken_for_a_success() -> None:
    slipped = domain.instances("slips").train[85]  # after a slip on the way to the stair, the figure can only die
    translator = Translator(domain, slipped)
    start = Simulator(domain).reset(slipped)
    answer = OracleExpert(domain)(translator.ask(HierDemo(start), 0, 0))
    shown: Any = translator.answer(answer)
    last = shown[-1]
    assert [(one.subgoal, one.outcome) for one in shown] == [(0, None)]
    assert not oracle.good_actions(None, None, last.states[-1].view, last.subgoal)
    assert all(oracle.good_actions(None, None, state.view, last.subgoal) for state in last.states[:-1])
    labels = Labels()
    labels.append_demonstration(shown)
    assert rows_of(labels)[pi(last.subgoal)][-1].termination == 0


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


def test_the_pictures_show_a_box_around_each_landmark() -> None:
    env = domain.make_env()
    env.reset(options={"instance": Instance(0)})
    picture, screen = domain.frame(env), np.repeat(env.picture(), 2, axis=1)
    assert picture.shape == (210, 320, 3)
    changed = np.argwhere((picture != screen).any(axis=2))
    for left, top, right, bottom in ((27, 102, 42, 113), (263, 170, 278, 178), (267, 50, 278, 88)):
        assert any((row == top and left <= column <= right) for row, column in changed)
        assert any((column == right and top <= row <= bottom) for row, column in changed)


# --- the expert


@pytest.mark.parametrize("motion", [[255, 0, 1, 0, 10], [255, 0, 1, 0, 0]])
@pytest.mark.parametrize("key", [False, True])
def test_the_expert_never_asks_for_the_stair_where_the_detector_sees_the_figure(motion: list[int], key: bool) -> None:
    # On the last steps of the stair, one place has two pictures. The detector sees the figure in one of them only.
    on_the_stair = {"x": 133, "y": 156, "motion": motion, "skull": [24, 8], "key": key}
    state = on_the_stair | {"at_stair": True, "door_open": False, "dying": False}
    for subgoal in oracle.good_subgoals(None, state):
        assert not oracle.reached(None, None, state, subgoal)


@pytest.mark.parametrize("noops", range(20))
def test_the_expert_solves_the_room_from_every_start(noops: int) -> None:
    solved, subgoals, views = expert_plays(Instance(noops))
    assert solved
    assert subgoals == list(domain.subgoals)
    assert len(views) < 170


def test_the_expert_solves_95_of_100_rooms_when_one_action_in_twenty_is_random() -> None:
    assert sum(expert_plays(Instance(n % 20, slips=0.05, seed=n))[0] for n in range(100)) >= 95


def test_a_demonstration_is_the_experts_own_play() -> None:
    instance = Instance(7, slips=0.05, seed=3)
    answer = OracleExpert(domain).demonstrate(domain.instance_view(instance), simulator.reset(instance).view)
    assert [segment.subgoal for segment in answer.segments] == list(domain.subgoals)
    actions = [ACTIONS.index(action) for segment in answer.segments for action in segment.actions]
    played(instance, actions)
    assert simulator.succeeded


@few
@given(st.integers(0, 19), st.data())
def test_any_of_the_good_actions_solves_the_room(noops: int, data: st.DataObject) -> None:
    view, subgoal, rng = simulator.reset(Instance(noops)).view, -1, np.random.default_rng(data.draw(st.integers(0, 99)))
    while not simulator.ended:
        if subgoal < 0 or oracle.reached(None, None, view, subgoal):
            subgoal = oracle.good_subgoals(None, view)[0]
        view = simulator.step(int(rng.choice(oracle.good_actions(None, None, view, subgoal)))).view
    assert simulator.succeeded
    assert simulator.steps < 300  # good actions come closer to the landmark, so they cannot wait forever


def test_no_action_is_good_when_the_figure_can_only_die() -> None:
    states = played(Instance(0), [ACTIONS.index("right")] * 40)  # over the edge of the platform
    assert states[-1].view["dying"]
    assert simulator.final
    doomed = [not oracle.good_actions(None, None, state.view, 0) for state in states]
    assert doomed == sorted(doomed)
    assert doomed[3:] == [True] * 7  # from the edge on


def test_the_expert_answers_about_recorded_states() -> None:
    start = {"x": 77, "y": 235, "motion": [255, 0, 1, 0, 8], "skull": [58, 0], "key": False}
    start |= {"at_stair": False, "door_open": False, "dying": False}
    assert [domain.subgoals[one] for one in oracle.good_subgoals(None, start)] == ["stair"]
    assert ACTIONS[oracle.good_actions(None, None, start, 0)[0]] == "jump_right"  # to the rope
    at_stair = start | {"x": 130, "y": 148, "at_stair": True}
    assert [domain.subgoals[one] for one in oracle.good_subgoals(None, at_stair)] == ["key"]
    assert [domain.subgoals[one] for one in oracle.good_subgoals(None, at_stair | {"key": True})] == ["door"]
    assert oracle.good_actions(None, None, start, domain.subgoals.index("door")) == ()  # there is no key yet


@given(st.integers(0, table.PHASES - 1))
def test_the_skull_has_one_place_in_each_phase(phase: int) -> None:
    assert table.phase_of(*table.skull_at(phase)) == phase


def test_the_skull_goes_through_its_phases_one_by_one() -> None:
    game, phases = Game(), list[int]()
    for _ in range(2 * table.PHASES):
        phases.append(table.phase_of(*game.memory().skull))
        game.act(0)
    assert [(phase - phases[0]) % table.PHASES for phase in phases] == [n % table.PHASES for n in range(len(phases))]


# --- how the table was computed


@pytest.fixture(scope="module")
def floor() -> graph.Graph:
    """Ten states of the expert's way along the floor, and how actions connect them."""
    _, _, views = expert_plays(Instance(0))
    demonstration = OracleExpert(domain).demonstrate(domain.instance_view(Instance(0)), views[0])
    game, found = Game(), dict[bytes, bytes]()
    for action in [action for segment in demonstration.segments for action in segment.actions]:
        game.act(ACTIONS.index(action))
        memory = game.memory()
        if memory.y <= 175 and not memory.key:
            found[node_of(memory)] = game.snapshot()
    places = {node: place for place, node in enumerate(list(found)[10:20])}
    after = [[follows(game, found[node], action, places) for action in range(len(ACTIONS))] for node in places]
    nodes = np.array([list(node) for node in places], np.uint8)
    snapshots = {place: found[node] for node, place in places.items()}
    return graph.Graph(nodes, np.zeros(len(nodes), bool), np.array(after, np.int32), snapshots)


def node_of(memory: Memory) -> bytes:
    return table.node_of(memory.x, memory.y, memory.motion, memory.key)


def follows(game: Game, snapshot: bytes, action: int, places: dict[bytes, int]) -> int:
    game.restore(snapshot)
    graph.keep_skull_away(game)
    game.act(action)
    return places.get(node_of(game.memory()), graph.DIES)


def test_the_skull_kills_where_it_touches_and_only_there(floor: graph.Graph) -> None:
    touched = 0
    for node in floor.snapshots:
        deadly = collisions.measure(floor, node, Game())
        distances = [abs(table.skull_at(phase)[0] + 32 - int(floor.nodes[node, 0])) for phase in range(table.PHASES)]
        assert not deadly[:, np.array(distances) > 12].any()
        touched += deadly.any()
    assert touched


def test_a_build_continues_where_it_was_interrupted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, floor: graph.Graph
) -> None:
    monkeypatch.setattr(build, "explore", lambda _progress: floor)
    monkeypatch.setattr(build, "_KEPT_EVERY", 4)
    measured: list[int] = []

    def measure(one: graph.Graph, node: int, game: Game) -> collisions.Deadly:
        measured.append(node)
        return original(one, node, game)

    def interrupt(what: str, done: int, known: int) -> None:
        if done == 7:
            raise KeyboardInterrupt

    original = collisions.measure
    monkeypatch.setattr(collisions, "measure", measure)
    build.build(tmp_path / "whole.npz", lambda *_: None)
    measured.clear()
    with pytest.raises(KeyboardInterrupt):
        build.build(tmp_path / "interrupted.npz", interrupt)
    assert measured == list(range(7))
    monkeypatch.setattr(build, "explore", lambda _progress: pytest.fail("the graph was kept"))
    build.build(tmp_path / "interrupted.npz", lambda *_: None)
    assert measured == [*range(7), *range(4, 10)]
    assert {path.name for path in tmp_path.iterdir()} == {"whole.npz", "interrupted.npz"}
    assert (tmp_path / "whole.npz").read_bytes() == (tmp_path / "interrupted.npz").read_bytes()


def test_the_plan_leads_to_the_door_and_does_not_wait() -> None:
    """A row of states: left and right move along it, the door is at its right end, and below its left end is death."""
    length, left, right = 6, ACTIONS.index("left"), ACTIONS.index("right")
    after = np.tile(np.arange(length)[:, None], (1, len(ACTIONS))).astype(np.int32)
    after[:, left] = np.arange(length) - 1  # -1 is death
    after[:, right] = [*range(1, length), graph.OPENS_DOOR]
    nodes = np.array([[x, 0, 0, 0, 0, 0, 0, 1] for x in range(length)], np.uint8)
    row = graph.Graph(nodes, np.arange(length) == 2, after, {})
    made = planning.plan(row, np.zeros((length, len(ACTIONS), table.PHASES), bool))
    assert all(made.actions(1, node, 0) == [right] for node in range(length))
    assert [made.actions(0, node, 0) for node in (0, 1, 3, 4)] == [[right], [right], [left], [left]]
    assert made.by_stair[:, 0].tolist() == [True, True, False, False, False, False]


def test_almost_every_state_of_random_play_is_in_the_table() -> None:
    known, seen, missing = {bytes(node) for node in table.shipped().nodes}, 0, 0
    for seed in range(60):
        rng = np.random.default_rng(seed)
        walk = [(int(rng.integers(len(ACTIONS))), int(rng.integers(1, 13))) for _ in range(30)]
        views = [state.view for state in played(Instance(seed % 20), carried_out(walk))]
        nodes = [bytes([view["x"], view["y"], *view["motion"], view["key"]]) for view in views if not view["dying"]]
        seen, missing = seen + len(nodes), missing + sum(node not in known for node in nodes)
    assert seen > 1_500
    assert missing <= 0.003 * seen


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
