"""Exploration goes back to places that were seldom chosen, and then to what succeeded."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples

from waypost_learner.policies.exploration import Exploration, ExplorationSpec, Way
from waypost_learner.rollout.lead import NO_LEAD

SPEC = ExplorationSpec(wander=6, guided=0.5, until=0.5, kept=2)
ACTIONS = 4


def places(actions: Way, origin: int = 0) -> list[int]:
    """The places of a walk on a line, on which action 0 and action 1 go ahead and the others back."""
    return [origin, *(origin + int(sum(1 if one < 2 else -1 for one in actions[: n + 1])) for n in range(len(actions)))]


def explored(*attempts: Way, spec: ExplorationSpec = SPEC) -> Exploration:
    exploration = Exploration(spec, ACTIONS)
    for actions in attempts:
        exploration.learn(actions, places(actions), reached=False, ended=False)
    return exploration


@examples
@given(st.lists(st.lists(st.integers(0, ACTIONS - 1), min_size=1, max_size=8).map(tuple), min_size=1, max_size=8))
def test_the_way_to_a_place_leads_there_and_none_that_was_seen_is_shorter(attempts: list[Way]) -> None:
    known = explored(*attempts).known["0"]
    for place, way in known.ways.items():
        assert str(places(way)[-1]) == place
        lengths = [n for actions in attempts for n, at in enumerate(places(actions)[:-1]) if str(at) == place]
        assert len(way) == min(lengths)


def test_before_a_success_an_attempt_goes_to_a_known_place_and_then_acts_at_random_without_the_policy() -> None:
    exploration, rng = explored((0, 0, 0, 0)), np.random.default_rng(0)
    ways, ends = set(exploration.known["0"].ways.values()), set()
    assert ways == {(), (0,), (0, 0), (0, 0, 0)}
    for _ in range(30):
        lead = exploration.lead(0, 0.0, rng)
        assert lead.whole
        assert lead.actions[: -SPEC.wander] in ways
        ends |= set(lead.actions[-SPEC.wander :])
    assert ends == set(range(ACTIONS))
    assert len(exploration.lead("elsewhere", 0.0, rng).actions) == SPEC.wander  # no place is known from there


def test_a_place_that_was_just_found_is_chosen_before_those_that_were_chosen_often() -> None:
    exploration, rng = explored((0, 0, 0)), np.random.default_rng(0)
    for _ in range(60):
        exploration.lead(0, 0.0, rng)
    exploration.learn((2, 2), places((2, 2)), reached=False, ended=False)
    chosen = Counter(exploration.lead(0, 0.0, rng).actions[: -SPEC.wander] for _ in range(5))
    assert chosen[(2,)] >= 3


def test_a_place_that_no_attempt_outlives_is_chosen_less_often_than_one_that_attempts_outlive() -> None:
    exploration, rng = explored(spec=replace(SPEC, outlived=3, focus=0.0)), np.random.default_rng(0)
    for _ in range(9):
        exploration.learn((2, 2), places((2, 2)), reached=False, ended=True)  # what goes back falls
        exploration.learn((0, 0), places((0, 0)), reached=False, ended=False)
        exploration.learn((0,) * 4, places((0,) * 4), reached=False, ended=True)  # place 1 is outlived, 2 is not
        exploration.learn((3, 0, 3), places((3, 0, 3)), reached=False, ended=False)  # cut off, which tells nothing
    chosen = Counter(exploration.lead(0, 0.0, rng).actions[: -SPEC.wander] for _ in range(2000))
    assert chosen[(0,)] > 50 * max(chosen[(2,)], chosen[(0, 0)])
    assert chosen[(2,)] > 0  # it was safe to be there in no attempt, but it is not given up


def test_random_actions_are_repeated_as_often_as_the_specification_says() -> None:
    always = explored(spec=ExplorationSpec(wander=20, repeat=1.0)).lead(0, 0.0, np.random.default_rng(0))
    assert len(set(always.actions)) == 1
    never = explored(spec=ExplorationSpec(wander=4000, repeat=0.0)).lead(0, 0.0, np.random.default_rng(0))
    repeated = np.mean([one == other for one, other in zip(never.actions, never.actions[1:], strict=False)])
    assert repeated == pytest.approx(1 / ACTIONS, abs=0.03)


def test_after_a_success_some_attempts_begin_with_a_part_of_it_until_the_policy_succeeds_by_itself() -> None:
    exploration, rng = explored((0, 0)), np.random.default_rng(0)
    success = (0, 1, 2, 3, 0, 1)
    assert exploration.learn(success, places(success), reached=True, ended=False) != ()
    leads = [exploration.lead(0, 0.49, rng) for _ in range(200)]
    assert all(not lead.whole and lead.actions == success[: len(lead.actions)] for lead in leads)
    assert {len(lead.actions) for lead in leads} == set(range(len(success)))
    assert 0.4 < np.mean([lead is NO_LEAD for lead in leads]) < 0.6
    assert all(exploration.lead(0, 0.5, rng) is NO_LEAD for _ in range(20))
    assert exploration.lead("elsewhere", 0.49, rng).whole  # from there, nothing succeeded yet


def test_only_the_shortest_successes_are_kept_and_imitated() -> None:
    exploration = explored()
    imitated = [len(exploration.learn((0,) * n, places((0,) * n), True, False)) for n in (5, 4, 6, 3, 4)]
    assert imitated == [5, 4, 0, 3, 4]
    assert [len(way) for way in exploration.known["0"].successes] == [3, 4]
    assert not exploration.learn((0,), places((0,)), reached=False, ended=False)


def test_of_a_success_only_the_steps_that_left_a_place_for_good_are_imitated() -> None:
    exploration = explored()
    way = (0, 2, 0, 0, 2, 0, 0)  # places 0, 1, 0, 1, 2, 1, 2 and then 3
    assert exploration.learn(way, places(way), reached=True, ended=False) == {2, 5, 6}
    waited = ["here", "here", "here", "there"]
    assert exploration.learn((1, 1, 0), waited, reached=True, ended=False) == {2}


@examples
@given(st.lists(st.lists(st.integers(0, ACTIONS - 1), min_size=1, max_size=6).map(tuple), max_size=5), st.booleans())
def test_what_is_known_comes_back_from_json(attempts: list[Way], succeeded: bool) -> None:
    exploration = explored(*attempts)
    if succeeded:
        exploration.learn((1, 1), places((1, 1)), reached=True, ended=False)
    exploration.lead(0, 0.0, np.random.default_rng(1))
    other = Exploration(SPEC, ACTIONS)
    other.load(exploration.to_json())
    assert other.known == exploration.known
    one, same = (each.lead(0, 0.0, np.random.default_rng(2)) for each in (exploration, other))
    assert one == same
