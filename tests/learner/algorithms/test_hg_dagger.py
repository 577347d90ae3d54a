"""Algorithm 2, driven by hand: what it asks, in which order, and what it learns from the answers."""

from dataclasses import replace
from typing import Any

from hypothesis import given
from hypothesis import strategies as st
from tests.learner.algorithms.scripted_kit import Expert, S, ScriptedLearner, carried_out
from tests.learner.kit import examples, segment

from waypost.trajectory import Trajectory
from waypost_learner.algorithms.hg_dagger import hg_dagger
from waypost_learner.algorithms.queries import (
    InspectFull,
    InspectLo,
    LabelHi,
    LabelLo,
    Query,
)
from waypost_learner.policies.labels import Labels, rows_of
from waypost_learner.rollout.policy_keys import META, pi


def hg_dagger_episode(
    subgoals: list[int], good_subgoals: list[int], lo_passes: list[bool], passes: bool = False
) -> tuple[Trajectory, Expert, Labels]:
    sigma = tuple(segment(subgoal, n_actions=2) for subgoal in subgoals)
    learner: Any = ScriptedLearner(sigma)
    expert = Expert(sigma, passes, good_subgoals, lo_passes)
    labels = carried_out(hg_dagger(S, learner), expert)
    assert learner.started_from == [S]
    return sigma, expert, labels


def test_a_pass_ends_the_episode_with_one_question_and_nothing_learned() -> None:
    sigma, expert, labels = hg_dagger_episode([0, 1], [0, 1], [True, True], passes=True)
    assert expert.asked == [InspectFull(sigma)]
    assert rows_of(labels) == {}


def test_after_a_fail_the_segments_are_inspected_up_to_the_first_that_fails_which_is_labeled() -> None:
    sigma, expert, labels = hg_dagger_episode([0, 1, 2, 3], [0, 1, 2, 3], [True, True, False, False])
    assert expert.asked == [
        InspectFull(sigma),
        LabelHi(sigma),
        InspectLo(sigma[0], before=()),
        InspectLo(sigma[1], before=sigma[:1]),
        InspectLo(sigma[2], before=sigma[:2]),
        LabelLo(sigma[2], before=sigma[:2]),
    ]
    assert rows_of(labels).keys() == {META, pi(2)}


def test_the_first_wrong_subgoal_ends_the_inspections_and_its_segment_is_not_even_inspected() -> None:
    sigma, expert, labels = hg_dagger_episode([0, 1, 2], [0, 3, 2], [True, False, False])
    assert expert.asked == [InspectFull(sigma), LabelHi(sigma), InspectLo(sigma[0], before=())]
    assert rows_of(labels).keys() == {META}


def test_with_a_wrong_first_choice_the_high_level_alone_learns() -> None:
    sigma, expert, _ = hg_dagger_episode([0, 1], [1, 1], [False, False])
    assert expert.asked == [InspectFull(sigma), LabelHi(sigma)]


def test_the_high_level_gets_every_label_of_the_trajectory_also_those_after_a_wrong_choice() -> None:
    sigma, _, labels = hg_dagger_episode([0, 1, 2], [0, 3, 4], [True, True, True])
    rows = rows_of(labels)[META]
    assert [row.choice for row in rows] == [0, 3, 4]
    assert [row.observation is one.start.observation for row, one in zip(rows, sigma, strict=True)] == [True] * 3


def test_the_low_level_labels_go_to_the_subgoal_that_was_pursued() -> None:
    sigma, _, labels = hg_dagger_episode([4, 2], [4, 2], [True, False])
    assert rows_of(labels).keys() == {META, pi(2)}
    rows = rows_of(labels)[pi(2)]
    assert [row.observation is s.observation for row, s in zip(rows, sigma[1].states, strict=True)] == [True] * 3
    assert [row.choice for row in rows] == [1, 1, -1]


def test_when_every_segment_passes_only_the_subgoals_are_learned() -> None:
    sigma, expert, labels = hg_dagger_episode([0, 1], [0, 1], [True, True])
    assert expert.asked[2:] == [InspectLo(sigma[0], before=()), InspectLo(sigma[1], before=sigma[:1])]
    assert rows_of(labels).keys() == {META}


def test_with_from_passed_a_subpolicy_also_learns_what_it_did_in_the_segments_that_passed() -> None:
    _, _, labels = hg_dagger_episode([0, 1, 2, 3], [0, 1, 2, 3], [True, True, False, False])
    rows = rows_of(labels, from_passed=True)
    assert rows.keys() == {META, pi(0), pi(1), pi(2)}
    assert [(row.choice, row.termination) for row in rows[pi(0)]] == [(0, -1), (0, 0), (-1, 1)]
    assert [row.choice for row in rows[pi(2)]] == [1, 1, -1]  # the expert's

    _, _, labels = hg_dagger_episode([0, 1], [0, 1], [], passes=True)
    assert rows_of(labels, from_passed=True).keys() == {pi(0), pi(1)}


def test_a_segment_that_the_horizon_cut_off_teaches_nothing_by_passing() -> None:
    sigma = (segment(0, terminated=False), replace(segment(1, terminated=False), final=True), segment(2))
    learner: Any = ScriptedLearner(sigma)
    labels = carried_out(hg_dagger(S, learner), Expert(sigma, True, [0, 1, 2], []))
    assert rows_of(labels, from_passed=True).keys() == {pi(1), pi(2)}


choices = st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4), st.booleans()), min_size=1, max_size=8)


@examples
@given(choices, st.booleans())
def test_whatever_happens_the_questions_are_the_papers(script: list[tuple[int, int, bool]], passes: bool) -> None:
    subgoals, good, lo_passes = (list(column) for column in zip(*script, strict=True))
    sigma, expert, labels = hg_dagger_episode(subgoals, good, lo_passes, passes)

    expected: list[Query] = [InspectFull(sigma)]  # Algorithm 2, lines 13-20, by hand
    if not passes:
        expected.append(LabelHi(sigma))
        agreeing = next((h for h, (own, best) in enumerate(zip(subgoals, good, strict=True)) if own != best), len(good))
        failing = next((h for h in range(agreeing) if not lo_passes[h]), None)
        inspected = agreeing if failing is None else failing + 1
        expected += [InspectLo(sigma[h], before=sigma[:h]) for h in range(inspected)]
        if failing is not None:
            expected.append(LabelLo(sigma[failing], before=sigma[:failing]))
    assert expert.asked == expected
    keys = (
        set()
        if passes
        else {META} | {pi(query.segment.subgoal or 0) for query in expected if isinstance(query, LabelLo)}
    )
    assert rows_of(labels).keys() == keys
    assert all(query not in expert.asked[:place] for place, query in enumerate(expert.asked))
