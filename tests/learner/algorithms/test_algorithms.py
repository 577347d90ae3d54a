"""The other algorithms, driven by hand: what they ask, in which order, and what they learn from it."""

from collections import Counter
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.algorithms.scripted_kit import Expert, S, ScriptedLearner, carried_out
from tests.learner.kit import examples, segment

from waypost.trajectory import Trajectory, n_steps
from waypost_learner.algorithms import ALGORITHMS, find_algorithm
from waypost_learner.algorithms.flat_bc import flat_bc
from waypost_learner.algorithms.flat_dagger import flat_dagger
from waypost_learner.algorithms.flat_dqn import flat_dqn
from waypost_learner.algorithms.h_bc import h_bc
from waypost_learner.algorithms.h_dqn import h_dqn
from waypost_learner.algorithms.hg_dagger_q import hg_dagger_q
from waypost_learner.algorithms.naive_h_dagger import naive_h_dagger
from waypost_learner.algorithms.plain_dagger import plain_dagger
from waypost_learner.algorithms.queries import (
    HierDemo,
    InspectFull,
    LabelFull,
    LabelHi,
    LabelLo,
)
from waypost_learner.policies.labels import Labels, rows_of
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi


def test_algorithm_1_asks_for_a_demonstration_from_the_start_state_and_learns_all_of_it() -> None:
    demonstration = (segment(3, n_actions=2, action=1), segment(0, n_actions=1, action=2))
    episode = h_bc(S, None)  # type: ignore[arg-type]  # it never looks at its policies
    assert next(episode) == HierDemo(S.state)
    with pytest.raises(StopIteration) as over:
        episode.send(demonstration)
    labels = over.value.value
    assert [row.choice for row in rows_of(labels)[META]] == [3, 0]
    assert [(row.choice, row.termination) for row in rows_of(labels)[pi(3)]] == [(1, -1), (1, 0), (-1, 1)]
    assert [(row.choice, row.termination) for row in rows_of(labels)[pi(0)]] == [(2, -1), (-1, 1)]


def test_interactive_algorithms_start_with_demonstrations() -> None:
    assert ALGORITHMS["hg-dagger"].warm_start is h_bc
    assert find_algorithm("h-bc").episode is h_bc


def flat_trajectory(actions: int = 3) -> Trajectory:
    return (segment(None, n_actions=actions, terminated=False),)


def test_flat_cloning_asks_for_a_flat_demonstration_and_learns_its_actions() -> None:
    tau = flat_trajectory()
    expert = Expert(tau, True, [], [])
    labels = carried_out(flat_bc(S, ScriptedLearner(())), expert)  # type: ignore[arg-type]
    assert expert.asked == [HierDemo(S.state, flat=True)]
    assert [(row.choice, row.termination) for row in rows_of(labels)[FLAT]] == [(0, -1)] * 3


@pytest.mark.parametrize("passes", [True, False])
def test_flat_dagger_inspects_and_labels_the_whole_trajectory_only_after_a_fail(passes: bool) -> None:
    tau = flat_trajectory()
    expert = Expert(tau, passes, [], [])
    labels = carried_out(flat_dagger(S, ScriptedLearner(tau)), expert)  # type: ignore[arg-type]
    assert expert.asked == [InspectFull(tau)] if passes else [InspectFull(tau), LabelFull(tau)]
    assert [row.choice for row in rows_of(labels).get(FLAT, [])] == ([] if passes else [1, 1, 1])
    assert [row.choice for row in rows_of(labels, from_passed=True)[FLAT]] == ([0, 0, 0] if passes else [1, 1, 1])


def test_plain_dagger_labels_every_rollout_and_inspects_nothing() -> None:
    tau = flat_trajectory()
    expert = Expert(tau, True, [], [])
    labels = carried_out(plain_dagger(S, ScriptedLearner(tau)), expert)  # type: ignore[arg-type]
    assert expert.asked == [LabelFull(tau)]
    assert [row.choice for row in rows_of(labels)[FLAT]] == [1, 1, 1]


@examples
@given(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=1, max_size=8), st.booleans())
def test_naive_hierarchical_dagger_labels_everything_and_inspects_nothing(
    chosen_and_good: list[tuple[int, int]], passes: bool
) -> None:
    sigma = tuple(segment(chosen, n_actions=2) for chosen, _ in chosen_and_good)
    expert = Expert(sigma, passes, [good for _, good in chosen_and_good], [passes] * len(sigma))
    labels = carried_out(naive_h_dagger(S, ScriptedLearner(sigma)), expert)  # type: ignore[arg-type]
    assert expert.asked == [LabelHi(sigma), *(LabelLo(one, before=sigma[:h]) for h, one in enumerate(sigma))]
    assert [row.choice for row in rows_of(labels)[META]] == expert.good_subgoals
    rows = rows_of(labels)
    assert rows.keys() == {META, *(pi(one.subgoal) for one in sigma if one.subgoal is not None)}
    wrong = Counter(chosen for chosen, good in chosen_and_good if chosen != good)
    for key in rows.keys() - {META}:  # the same number of rows for each segment
        each = len(rows[key]) // sum(chosen == key.subgoal for chosen, _ in chosen_and_good)
        assert sum(not row.for_right_subgoal for row in rows[key]) == each * wrong[key.subgoal or 0]


def learned_from(labels: Labels) -> Counter[PolicyKey]:
    """How many choices each Q-function learns from."""
    learned: Counter[PolicyKey] = Counter()
    for key, trajectory in labels.experience:
        learned[key] += len(trajectory) if key == META else n_steps(trajectory)
    return learned


@examples
@given(st.lists(st.tuples(st.integers(0, 4), st.integers(0, 4)), min_size=1, max_size=8), st.booleans())
def test_the_hybrid_learns_to_act_only_from_segments_before_the_first_wrong_subgoal(
    chosen_and_good: list[tuple[int, int]], passes: bool
) -> None:
    sigma = tuple(segment(chosen, n_actions=2) for chosen, _ in chosen_and_good)
    expert = Expert(sigma, passes, [good for _, good in chosen_and_good], [])
    labels = carried_out(hg_dagger_q(S, ScriptedLearner(sigma)), expert)  # type: ignore[arg-type]
    agreeing = 0
    while agreeing < len(sigma) and (passes or chosen_and_good[agreeing][0] == chosen_and_good[agreeing][1]):
        agreeing += 1
    learned = learned_from(labels)
    assert learned == {key: 2 * sum(s.subgoal == key.subgoal for s in sigma[:agreeing]) for key in learned}
    assert sum(learned.values()) == 2 * agreeing
    assert expert.asked == ([InspectFull(sigma)] if passes else [InspectFull(sigma), LabelHi(sigma)])
    assert [row.choice for row in rows_of(labels).get(META, [])] == ([] if passes else expert.good_subgoals)


def test_learning_by_reinforcement_alone_asks_nobody_and_learns_from_everything() -> None:
    expert = Expert((), True, [], [])
    sigma = (segment(1, n_actions=3), segment(0, n_actions=2))
    labels = carried_out(h_dqn(S, ScriptedLearner(sigma)), expert)  # type: ignore[arg-type]
    assert learned_from(labels) == {pi(1): 3, pi(0): 2, META: 2}
    tau = (replace(flat_trajectory()[0], rewards=(0.0, 0.0, 1.0)),)
    labels = carried_out(flat_dqn(S, ScriptedLearner(tau)), expert)  # type: ignore[arg-type]
    assert learned_from(labels) == {FLAT: 3}
    assert expert.asked == []


def test_an_unknown_algorithm_is_refused_with_those_that_exist() -> None:
    with pytest.raises(ValueError, match=r"no algorithm 'dagger'.*h-bc, h-dqn, hg-dagger"):
        find_algorithm("dagger")
