"""The variants of Algorithm 2, driven by hand: what they ask, and what they learn from the answers."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.learner.algorithms.scripted_kit import Expert, S, ScriptedLearner, carried_out
from tests.learner.kit import segment

from waypost.trajectory import Trajectory
from waypost_learner.algorithms.hg_dagger import hg_dagger
from waypost_learner.algorithms.hg_dagger_by_place import hg_dagger_by_place
from waypost_learner.algorithms.hg_gated import hg_gated
from waypost_learner.algorithms.hg_stagger import hg_stagger
from waypost_learner.algorithms.hg_takeover import hg_takeover
from waypost_learner.algorithms.queries import (
    HierDemo,
    InspectFull,
    InspectLo,
    LabelHi,
    LabelLo,
    Query,
)
from waypost_learner.gates.gate import Doubts
from waypost_learner.gates.views import N_FEATURES, Seen
from waypost_learner.policies.labels import Labels, rows_of
from waypost_learner.rollout.policy_keys import META, pi


@pytest.mark.parametrize(
    ("good", "lo_passes", "kinds"),
    [
        (1, True, [InspectFull, LabelHi, InspectLo]),
        (1, False, [InspectFull, LabelHi, InspectLo, LabelLo]),
        (3, False, [InspectFull, LabelHi]),
    ],
)
def test_stagger_asks_for_the_subgoal_of_one_segment_and_inspects_that_alone(
    good: int, lo_passes: bool, kinds: list[Any]
) -> None:
    sigma = tuple(segment(subgoal, n_actions=2) for subgoal in (0, 1, 2))
    learner: Any = ScriptedLearner(sigma, drawn=1)
    expert = Expert(sigma, passes=False, good_subgoals=[0, good, 2], lo_passes=[True, lo_passes, True])
    labels = carried_out(hg_stagger(S, learner), expert)
    asked: list[Query] = [
        InspectFull(sigma),
        LabelHi(sigma[1:2], before=sigma[:1]),
        InspectLo(sigma[1], before=sigma[:1]),
        LabelLo(sigma[1], before=sigma[:1]),
    ]
    assert expert.asked == asked[: len(kinds)]
    assert [type(query) for query in expert.asked] == kinds
    assert [row.choice for row in rows_of(labels)[META]] == [good]
    assert (pi(1) in rows_of(labels)) == (LabelLo in kinds)
    assert (pi(1) in rows_of(labels, from_passed=True)) == (InspectLo in kinds)


def test_stagger_learns_nothing_of_an_episode_that_passed() -> None:
    sigma = (segment(0), segment(1))
    learner: Any = ScriptedLearner(sigma, drawn=1)
    expert = Expert(sigma, passes=True, good_subgoals=[0, 1], lo_passes=[True, True])
    assert rows_of(carried_out(hg_stagger(S, learner), expert)) == {}
    assert expert.asked == [InspectFull(sigma)]


def test_where_a_segment_failed_the_expert_plays_on_and_what_it_shows_is_learned() -> None:
    sigma = tuple(segment(subgoal, n_actions=2) for subgoal in (0, 1, 2))
    shown = (segment(3, n_actions=3, action=1),)
    learner: Any = ScriptedLearner(sigma)
    expert = Expert(sigma, passes=False, good_subgoals=[0, 1, 2], lo_passes=[True, False, True], shown=shown)
    labels = carried_out(hg_takeover(S, learner), expert)
    assert expert.asked == [
        InspectFull(sigma),
        LabelHi(sigma),
        InspectLo(sigma[0], before=()),
        InspectLo(sigma[1], before=sigma[:1]),
        HierDemo(sigma[1].states[-1], before=sigma[:2], max_segments=1),
    ]
    rows = rows_of(labels)
    assert rows.keys() == {META, pi(3)}
    assert [(row.choice, row.termination) for row in rows[pi(3)]] == [(1, -1), (1, 0), (1, 0), (-1, 1)]
    assert sorted(row.choice for row in rows[META]) == [0, 1, 2, 3]
    assert labels.passed == [(sigma[0], True)]


def test_where_the_episode_ended_with_the_failed_segment_the_segment_is_labeled() -> None:
    sigma = (segment(0), replace(segment(1, n_actions=2), final=True))
    learner: Any = ScriptedLearner(sigma)
    expert = Expert(sigma, passes=False, good_subgoals=[0, 1], lo_passes=[True, False])
    labels = carried_out(hg_takeover(S, learner), expert)
    assert expert.asked[3:] == [InspectLo(sigma[1], before=sigma[:1]), LabelLo(sigma[1], before=sigma[:1])]
    assert rows_of(labels).keys() == {META, pi(1)}


@pytest.mark.parametrize(
    ("good_subgoals", "lo_passes", "passes"),
    [([0, 1], [], True), ([1, 1], [False] * 2, False), ([0, 1], [True] * 2, False)],
)
def test_where_no_segment_failed_at_a_right_subgoal_nobody_takes_over(
    good_subgoals: list[int], lo_passes: list[bool], passes: bool
) -> None:
    sigma = (segment(0), segment(1))
    both = [Expert(sigma, passes, good_subgoals, lo_passes) for _ in range(2)]
    learner: Any = ScriptedLearner(sigma)
    found = [carried_out(one(S, learner), expert) for one, expert in zip((hg_takeover, hg_dagger), both, strict=True)]
    assert both[0].asked == both[1].asked
    assert found[0] == found[1]


def gated_episode(
    hi: list[bool], lo: list[bool], good_subgoals: list[int], lo_passes: list[bool]
) -> tuple[Trajectory, Expert, Labels]:
    sigma = tuple(segment(subgoal, n_actions=2) for subgoal in (0, 1, 2))
    seen: Seen = {"hi": np.zeros((3, N_FEATURES), np.float32), "lo": np.zeros((3, N_FEATURES), np.float32)}
    learner: Any = ScriptedLearner(sigma)
    learner.doubts = lambda given: Doubts(hi, lo, seen) if given == sigma else None
    expert = Expert(sigma, False, good_subgoals, lo_passes)
    return sigma, expert, carried_out(hg_gated(S, learner), expert)


def answers(labels: Labels) -> dict[str, list[int]]:
    """What a gate learns of each segment: 0 for right, 1 for wrong, -1 for nothing."""
    return {level: [row.choice for row in rows] for level, rows in labels.judged.items()}


def test_gated_a_rollout_without_doubts_costs_nothing() -> None:
    _, expert, labels = gated_episode([False] * 3, [False] * 3, [0, 1, 2], [False] * 3)
    assert expert.asked == []
    assert rows_of(labels, from_passed=True) == {}
    assert answers(labels) == {"hi": [-1, -1, -1], "lo": [-1, -1, -1]}


def test_gated_only_what_is_doubted_is_asked_about_each_level_by_itself() -> None:
    sigma, expert, labels = gated_episode([False, True, False], [True, False, True], [0, 1, 2], [True, False, False])
    assert expert.asked == [
        InspectLo(sigma[0], before=()),
        LabelHi(sigma[1:2], before=sigma[:1]),
        InspectLo(sigma[2], before=sigma[:2]),
        LabelLo(sigma[2], before=sigma[:2]),
    ]
    assert [row.choice for row in rows_of(labels)[META]] == [1]
    rows = rows_of(labels, from_passed=True)
    assert rows.keys() == {META, pi(0), pi(2)}
    assert not any(row.for_right_subgoal for key in (pi(0), pi(2)) for row in rows[key])  # nobody said so
    assert answers(labels) == {"hi": [-1, 0, -1], "lo": [0, -1, 1]}


def test_gated_what_was_labeled_for_a_subgoal_that_the_expert_agreed_to_is_for_a_right_one() -> None:
    _, _, labels = gated_episode([True] * 3, [True] * 3, [0, 1, 2], [True, False, False])
    rows = rows_of(labels, from_passed=True)
    assert rows.keys() == {META, pi(0), pi(1)}
    assert all(row.for_right_subgoal for key in (pi(0), pi(1)) for row in rows[key])


def test_gated_nothing_is_asked_after_the_first_thing_that_is_wrong() -> None:
    sigma, expert, labels = gated_episode([True] * 3, [True] * 3, [0, 3, 2], [True, False, False])
    assert expert.asked == [LabelHi(sigma[:1]), InspectLo(sigma[0]), LabelHi(sigma[1:2], before=sigma[:1])]
    assert [row.choice for row in rows_of(labels)[META]] == [0, 3]
    assert answers(labels) == {"hi": [0, 1, -1], "lo": [0, -1, -1]}

    sigma, expert, labels = gated_episode([True] * 3, [True] * 3, [0, 1, 2], [False, True, True])
    assert expert.asked == [LabelHi(sigma[:1]), InspectLo(sigma[0]), LabelLo(sigma[0])]
    assert answers(labels) == {"hi": [0, -1, -1], "lo": [1, -1, -1]}


def test_by_place_the_authors_hg_dagger_labels_first_visits_and_goes_on_after_what_is_wrong() -> None:
    sigma = tuple(segment(subgoal, n_actions=2) for subgoal in (0, 1, 2, 3, 4))
    learner: Any = ScriptedLearner(sigma, drawn=3)  # the fourth segment begins where another one began
    expert = Expert(sigma, False, good_subgoals=[0, 3, 2, 3, 4], lo_passes=[False, True, True, False, False])
    labels = carried_out(hg_dagger_by_place(S, learner), expert)
    before = [sigma[:h] for h in range(5)]
    assert (
        expert.asked
        == [
            InspectFull(sigma),
            LabelHi(sigma[0:1], before[0]),
            InspectLo(sigma[0], before[0]),
            LabelLo(sigma[0], before[0]),
            LabelHi(sigma[1:2], before[1]),  # another subgoal would have been right
            LabelHi(sigma[2:3], before[2]),
            InspectLo(sigma[2], before[2]),
            LabelHi(sigma[4:5], before[4]),
            InspectLo(sigma[4], before[4]),
            LabelLo(sigma[4], before[4]),
        ]
    )
    assert [row.choice for row in rows_of(labels)[META]] == [0, 3, 2, 4]
    assert rows_of(labels).keys() == {META, pi(0), pi(4)}
    assert rows_of(labels, from_passed=True).keys() == {META, pi(0), pi(2), pi(4)}

    passed = Expert(sigma, True, [], [])
    assert rows_of(carried_out(hg_dagger_by_place(S, learner), passed)) == {}
    assert passed.asked == [InspectFull(sigma)]
