"""The expert that was computed for the first room of Montezuma's Revenge, and how its table is computed."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.domains.montezuma_kit import carried_out, domain, expert_plays, few, oracle, played, simulator

from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.domains.montezuma import table
from waypost_learner.domains.montezuma.env import Instance
from waypost_learner.domains.montezuma.expert import build, collisions, graph, planning
from waypost_learner.domains.montezuma.game import ACTIONS, Game, Memory
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.policies.labels import Labels, rows_of
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.policy_keys import pi
from waypost_learner.rollout.simulator import Simulator


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
