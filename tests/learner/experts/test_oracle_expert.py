"""The six verbs of the paper, as the oracle answers them from what is on the wire."""

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter
from tests.learner.kit import drawn_mazes, examples, solved

from waypost import prices as pricing
from waypost import wire
from waypost.domains import find_domain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import MazeEnv
from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.domains.maze.maze import ACTIONS, SUBGOALS, Cell, Maze, closed_rooms, moved
from waypost_learner.experts.oracle import OracleExpert
from waypost_server.queries import checks

NORTH, SOUTH, WEST, EAST, TARGET = SUBGOALS
UP, DOWN, LEFT, RIGHT = ACTIONS
domain = MazeDomain()
expert = OracleExpert(domain)
words = checks.Names(frozenset(SUBGOALS), frozenset(ACTIONS))


def ask(kind: str, maze: Maze, segments: list[wire.Segment] | None = None) -> wire.Ask:
    body: dict[str, Any] = {"kind": kind, "episode": 0, "ordinal": 0, "question": "?", "instance": maze.to_json()}
    if segments is None:
        body |= {"state": list(maze.start), "max_segments": 100, "max_actions": 100}
    else:
        body |= {"segments": [segment.model_dump() for segment in segments]}
    return TypeAdapter(wire.Ask).validate_python(body)


def walked(start: Cell, subgoal: str | None, *actions: str) -> wire.Segment:
    """The segment of these actions."""
    states = [start]
    for action in actions:
        states.append(moved(states[-1], ACTIONS.index(action)))
    return wire.Segment(subgoal=subgoal, states=[list(cell) for cell in states], actions=list(actions))


def two_rooms(goal: Cell = (2, 6)) -> Maze:
    """Start in the middle of a room, with a door to the east in the middle of the wall."""
    lava = closed_rooms()
    lava[2, 4] = False
    return Maze(lava, (2, 2), goal)


@st.composite
def trajectories(draw: st.DrawFn) -> tuple[Maze, list[wire.Segment]]:
    """A maze and some segments that random policies may have walked; lava ends them."""
    maze = draw(drawn_mazes())
    cell, segments = maze.start, []
    for _ in range(draw(st.integers(1, 4))):
        actions: list[str] = []
        there = cell
        for action in draw(st.lists(st.sampled_from(ACTIONS), min_size=1, max_size=8)):
            actions.append(action)
            there = moved(there, ACTIONS.index(action))
            if maze.lava[there] or there == maze.goal:
                break
        segments.append(walked(cell, draw(st.sampled_from(SUBGOALS)), *actions))
        cell = there
        if maze.lava[cell] or cell == maze.goal:
            break
    return maze, segments


def queries(maze: Maze, segments: list[wire.Segment]) -> list[wire.Ask]:
    """A query of each kind; one on each segment where the kind asks about one."""
    whole = [ask(kind, maze, segments) for kind in ("inspect_full", "label_hi", "label_full")]
    single = [ask(kind, maze, [segment]) for kind in ("inspect_lo", "label_lo") for segment in segments]
    return [ask("hier_demo", maze), *whole, *single]


@examples
@given(trajectories())
def test_every_answer_fits_its_query_by_the_servers_own_rules(walk: tuple[Maze, list[wire.Segment]]) -> None:
    for query in queries(*walk):
        checks.check_ask(query, words, ["query"])
        checks.check_answer(checks.Outline.of(query), expert(query), words, ["answer"])


@examples
@given(trajectories())
def test_answers_are_the_same_after_the_query_has_crossed_the_wire(walk: tuple[Maze, list[wire.Segment]]) -> None:
    for query in queries(*walk):
        arrived = TypeAdapter(wire.Ask).validate_json(query.model_dump_json())
        assert json.loads(expert(arrived).model_dump_json()) == json.loads(expert(query).model_dump_json())


@examples
@given(trajectories())
def test_an_agreeing_label_is_the_learners_own_and_its_way_is_a_shortest_one(
    walk: tuple[Maze, list[wire.Segment]],
) -> None:
    maze, segments = walk
    labels = expert(ask("label_full", maze, segments))
    assert isinstance(labels, wire.LabelFullAnswer)
    to_goal = solved(maze)
    steps = [(tuple(state), own) for s in segments for state, own in zip(s.states, s.actions, strict=False)]
    for (cell, own), label in zip(steps, labels.actions, strict=True):
        optimal = [a for a in ACTIONS if to_goal.get(moved(cell, ACTIONS.index(a)), np.inf) < to_goal[cell]]
        assert label in optimal
        assert (label == own) == (own in optimal)


def test_inspect_full_passes_exactly_what_ends_on_the_target() -> None:
    maze = two_rooms(goal=(2, 3))
    for actions, verdict in (([RIGHT], "pass"), ([LEFT], "fail"), ([UP, UP], "fail")):
        answer = expert(ask("inspect_full", maze, [walked((2, 2), TARGET, *actions)]))
        assert answer == wire.InspectAnswer(kind="inspect_full", verdict=verdict)


def test_inspect_lo_passes_exactly_what_ends_in_the_subgoals_room() -> None:
    cases = ([RIGHT], "fail"), ([RIGHT] * 2, "fail"), ([RIGHT] * 3, "pass"), ([RIGHT] * 4, "pass"), ([UP] * 2, "fail")
    for actions, verdict in cases:
        answer = expert(ask("inspect_lo", two_rooms(), [walked((2, 2), EAST, *actions)]))
        assert answer == wire.InspectAnswer(kind="inspect_lo", verdict=verdict)


def test_a_tie_between_good_subgoals_counts_as_agreement() -> None:
    lava = closed_rooms()
    for door in ((4, 2), (2, 4), (4, 6), (6, 4)):
        lava[door] = False
    maze = Maze(lava, (2, 2), (6, 6))
    for own, label in ((SOUTH, SOUTH), (EAST, EAST), (NORTH, SOUTH)):
        answer = expert(ask("label_hi", maze, [walked((2, 2), own, RIGHT)]))
        assert answer == wire.LabelHiAnswer(kind="label_hi", subgoals=[label])


def test_a_tie_between_good_actions_counts_as_agreement() -> None:
    maze = two_rooms()
    for own in (RIGHT, DOWN):
        answer = expert(ask("label_lo", maze, [walked((1, 1), EAST, own)]))
        assert isinstance(answer, wire.LabelLoAnswer)
        assert answer.actions == [own]


def test_label_hi_labels_every_segment_where_it_began_also_after_a_wrong_choice() -> None:
    maze = two_rooms()
    segments = [walked((2, 2), WEST, LEFT), walked((2, 1), EAST, *[RIGHT] * 4), walked((2, 5), SOUTH, DOWN)]
    answer = expert(ask("label_hi", maze, segments))
    assert answer == wire.LabelHiAnswer(kind="label_hi", subgoals=[EAST, EAST, TARGET])


def test_a_label_of_a_segment_that_never_got_there_has_an_action_for_every_state_and_no_termination() -> None:
    answer = expert(ask("label_lo", two_rooms(), [walked((1, 1), EAST, RIGHT, RIGHT)]))
    assert answer == wire.LabelLoAnswer(kind="label_lo", actions=[RIGHT, RIGHT], terminations=[False] * 3)


def test_after_an_overshoot_actions_are_null_from_the_first_true_termination_on_and_never_before() -> None:
    answer = expert(ask("label_lo", two_rooms(), [walked((2, 2), EAST, *[RIGHT] * 3, UP, LEFT, LEFT)]))
    assert answer == wire.LabelLoAnswer(
        kind="label_lo",
        actions=[RIGHT, RIGHT, RIGHT, None, None, None],
        terminations=[False, False, False, True, False, False, False],  # the first is the one that counts
    )


def test_a_segment_is_over_in_its_room_also_if_it_came_in_by_another_door() -> None:
    lava = closed_rooms()
    for door in ((2, 4), (4, 2), (6, 4), (4, 6)):
        lava[door] = False
    around = [*[DOWN] * 3, *[RIGHT] * 4, *[UP] * 3]
    answer = expert(ask("label_lo", Maze(lava, (3, 2), (2, 7)), [walked((3, 2), EAST, *around, UP, LEFT)]))
    assert isinstance(answer, wire.LabelLoAnswer)
    assert answer.terminations == [False] * 10 + [True] + [False] * 2
    assert [action is None for action in answer.actions] == [False] * 10 + [True] * 2


@examples
@given(trajectories())
def test_only_at_and_after_a_true_termination_is_an_action_null(walk: tuple[Maze, list[wire.Segment]]) -> None:
    maze, segments = walk
    for segment in segments:
        answer = expert(ask("label_lo", maze, [segment]))
        assert isinstance(answer, wire.LabelLoAnswer)
        first = answer.terminations.index(True) if True in answer.terminations else len(answer.actions)
        assert [action is None for action in answer.actions] == [i >= first for i in range(len(answer.actions))]


def test_a_subgoal_that_is_not_valid_is_labeled_as_over_before_its_first_action() -> None:
    answer = expert(ask("label_lo", two_rooms(), [walked((2, 2), NORTH, UP, DOWN)]))
    assert answer == wire.LabelLoAnswer(kind="label_lo", actions=[None, None], terminations=[True, False, False])


@examples
@given(drawn_mazes())
def test_a_demonstration_replays_to_success_in_the_shortest_number_of_steps(maze: Maze) -> None:
    answer = expert(ask("hier_demo", maze))
    assert isinstance(answer, wire.HierDemoAnswer)
    env = MazeEnv()
    env.reset(options={"instance": maze})
    ends = [env.step(np.int64(ACTIONS.index(action)))[1:3] for s in answer.segments for action in s.actions]
    assert ends[-1] == (1, True)
    assert not any(terminated for _, terminated in ends[:-1])
    assert len(ends) == solved(maze)[maze.start]


def test_a_demonstration_costs_about_64_units_under_the_papers_prices() -> None:
    prices = wire.Prices()
    costs = [pricing.cost(expert(ask("hier_demo", maze)), prices).units / 1e6 for maze in maze_set("random")[1][:100]]
    assert np.mean(costs) == pytest.approx(64, abs=2)


def test_a_domain_without_an_oracle_is_refused_with_what_to_do_instead() -> None:
    corridor: Any = find_domain("corridor")
    corridor.oracle = None
    with pytest.raises(ValueError, match=r"'corridor' has no oracle.*--expert queue"):
        OracleExpert(corridor)
