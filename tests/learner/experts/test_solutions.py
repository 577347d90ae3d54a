"""What is right for a query, all of it: the answers of the oracle among it, and nothing that is worse."""

import json
from pathlib import Path

import pytest
from hypothesis import given
from pydantic import TypeAdapter
from tests.learner.experts.test_oracle_expert import (
    EAST,
    RIGHT,
    UP,
    ask,
    domain,
    examples,
    expert,
    trajectories,
    two_rooms,
    walked,
    words,
)
from typer.testing import CliRunner

from waypost import wire
from waypost.domains import find_domain, oracle_of
from waypost_learner.cli import app
from waypost_learner.experts.gold import make_gold
from waypost_learner.experts.practice import practice
from waypost_learner.experts.solutions import solve
from waypost_learner.remote.embedded import embedded
from waypost_server.gold import scoring
from waypost_server.gold.practice import SHIPPED, BadPractice, PracticeSet

LABELS = ("inspect_full", "label_hi", "label_full")


@examples
@given(drawn=trajectories())
def test_the_oracles_own_answers_are_right_in_every_label(drawn):
    maze, segments = drawn
    queries = [ask(kind, maze, segments) for kind in LABELS]
    queries += [ask(kind, maze, [one]) for one in segments for kind in ("inspect_lo", "label_lo")]
    for query in queries:
        solution = solve(domain, query)
        scoring.check(query, solution.known, words, [])
        marks = scoring.marks(solution.known, expert(query))
        assert all(mark.is_right for mark in marks), (query.kind, marks)
        assert len(solution.reasons) == len(marks)


def test_choices_that_are_as_good_are_all_right_and_others_are_not():
    maze = two_rooms(goal=(1, 6))
    segment = walked((3, 2), EAST, UP, RIGHT)
    known = solve(domain, ask("label_lo", maze, [segment])).known
    assert [set(right) for right in known.actions] == [{UP, RIGHT}, {RIGHT}]
    assert known.end is None


def test_a_segment_should_end_where_its_subgoal_is_reached():
    segment = walked((2, 2), EAST, RIGHT, RIGHT, RIGHT, RIGHT)
    solution = solve(domain, ask("label_lo", two_rooms(), [segment]))
    assert (solution.known.end, len(solution.known.actions)) == (3, 3)
    assert solution.reasons == ("shortest",) * 3 + ("accomplished",)


def test_a_demonstration_is_not_known_beforehand():
    with pytest.raises(ValueError, match="many are equally good"):
        solve(domain, ask("hier_demo", two_rooms()))


def test_the_practice_that_ships_is_what_the_command_makes(tmp_path: Path):
    file = tmp_path / "practice.json"
    done = CliRunner().invoke(app, ["practice", str(file), "--instances", "corners"])
    assert done.exit_code == 0, done.output
    assert json.loads(file.read_text()) == json.loads(SHIPPED.read_text())


def test_practice_is_made_for_any_domain_with_an_oracle(tmp_path: Path):
    file = tmp_path / "practice.json"
    corridor = find_domain("corridor")
    file.write_text(practice(corridor, "random", seed=0))
    kinds = {one.ask.kind for one in PracticeSet(file).questions().queries}
    assert kinds == {"inspect_full", "inspect_lo", "label_hi", "label_lo", "label_full"}


@pytest.mark.parametrize("name", ["maze", "corridor"])
def test_practice_has_a_demonstration_of_each_way_in_which_one_is_asked_for(tmp_path: Path, name: str):
    file, played = tmp_path / "practice.json", find_domain(name)
    file.write_text(practice(played, "random", seed=0))
    oracle = oracle_of(played)
    shown = {(one.ask.flat, bool(one.ask.context)): one for one in PracticeSet(file).questions().demonstrations}
    assert set(shown) == {(False, False), (True, False), (False, True)}
    for (flat, plays_on), one in shown.items():
        states, segments = one.answer.replay.states, one.answer.segments
        assert len(states) == 1 + sum(len(segment.actions) for segment in segments)
        assert (segments[0].subgoal is None) == flat
        assert oracle.succeeded(one.ask.instance, states[-1]) != plays_on
        if plays_on:
            *reached, failed = one.ask.context
            ways = [(one.subgoal, one.states[0], one.states[-1]) for one in (*reached, failed)]
            ways.append((segments[0].subgoal, states[0], states[-1]))
            done = [oracle.reached(one.ask.instance, s, t, played.subgoals.index(g)) for g, s, t in ways]
            assert done == [*(True for _ in reached), False, True]


def test_practice_has_the_pictures_of_a_domain_that_draws_its_states(tmp_path: Path):
    file = tmp_path / "practice.json"
    file.write_text(practice(find_domain("corridor"), "random", seed=0))
    made = PracticeSet(file)
    offered = made.questions()
    asks = [one.ask for one in (*offered.queries, *offered.demonstrations)]
    shown = [one for ask in asks for one in (*getattr(ask, "segments", ()), *ask.context)]
    shown += [one.answer.replay for one in offered.demonstrations]
    assert all(len(one.frames) == len(one.states) for one in shown)
    assert {frame for one in shown for frame in one.frames} == set(made.files)

    content = json.loads(file.read_text())
    content["frames"].pop()
    file.write_text(json.dumps(content))
    with pytest.raises(BadPractice, match="is not in the file"):
        PracticeSet(file)


def test_a_runs_own_queries_become_gold_by_the_oracle(tmp_path: Path):
    with embedded(tmp_path / "waypost.db") as connection:
        client, maze = connection.learner, two_rooms()
        names = wire.Vocabulary(
            domain="maze", subgoals=list(domain.subgoals), actions=list(domain.actions), renderer="maze"
        )
        run = client.create_run(wire.RunCreate(name="r", algorithm="hg-dagger", seed=0, vocabulary=names)).id
        queries = [ask("label_hi", maze, [walked((2, 2), EAST, RIGHT)]), ask("hier_demo", maze)]
        numbered = [query.model_copy(update={"ordinal": place}) for place, query in enumerate(queries)]
        client.ask(run, TypeAdapter(list[wire.Ask]).validate_python(numbered))
        for _ in numbered:
            assignment = connection.annotator.lease(wire.Lease())
            connection.annotator.answer(assignment, expert(assignment.query.ask))
        assert make_gold(client, run, 20) == 1
        assert make_gold(client, run, 20) == 1
