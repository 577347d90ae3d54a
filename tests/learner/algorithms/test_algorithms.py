"""The algorithms, driven by hand: what they ask, in which order, and what they learn from the answers."""

from collections import Counter
from collections.abc import Generator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import TINY, examples, segment, state

from waypost.trajectory import Trajectory, n_steps
from waypost_learner.algorithms import ALGORITHMS, find_algorithm
from waypost_learner.algorithms.flat_bc import flat_bc
from waypost_learner.algorithms.flat_dagger import flat_dagger
from waypost_learner.algorithms.flat_dqn import flat_dqn
from waypost_learner.algorithms.h_bc import h_bc
from waypost_learner.algorithms.h_dqn import h_dqn
from waypost_learner.algorithms.hg_dagger import hg_dagger
from waypost_learner.algorithms.hg_dagger_by_place import hg_dagger_by_place
from waypost_learner.algorithms.hg_dagger_q import hg_dagger_q
from waypost_learner.algorithms.hg_gated import hg_gated
from waypost_learner.algorithms.hg_stagger import hg_stagger
from waypost_learner.algorithms.hg_takeover import hg_takeover
from waypost_learner.algorithms.naive_h_dagger import naive_h_dagger
from waypost_learner.algorithms.plain_dagger import plain_dagger
from waypost_learner.algorithms.queries import (
    HierDemo,
    InspectFull,
    InspectLo,
    LabelFull,
    LabelHi,
    LabelLo,
    Query,
)
from waypost_learner.gates.gate import Doubts
from waypost_learner.gates.views import N_FEATURES, Seen
from waypost_learner.policies.labels import Labels, LoLabels, rows_of
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi
from waypost_learner.rollout.simulator import Start

NO_SIMULATOR: Any = None
S = Start(state("s"), instance=None, draw=0, simulator=NO_SIMULATOR)


class ScriptedLearner:
    """Rolls out the trajectory it was given."""

    preset = TINY

    def __init__(self, sigma: Trajectory, drawn: int = 0) -> None:
        self.sigma, self.drawn = sigma, drawn
        self.started_from: list[Start] = []

    def roll_out(self, s: Start) -> Trajectory:
        self.started_from.append(s)
        return self.sigma

    def draw_one(self, s: Start, sigma: Trajectory) -> int:
        assert (s, sigma) == (S, self.sigma)
        return self.drawn

    def goes_on(self, s: Start, sigma: Trajectory) -> bool:
        assert s is S
        return not sigma[-1].final

    def first_visits(self, sigma: Trajectory) -> list[int]:
        assert sigma == self.sigma
        return [h for h in range(len(sigma)) if h != self.drawn]


class Expert:
    """Answers from a script and keeps what was asked.

    `lo_passes` says which segments pass, by place; Label_LO corrects each action to 1 and ends with the segment.
    """

    def __init__(
        self,
        sigma: Trajectory,
        passes: bool,
        good_subgoals: list[int],
        lo_passes: list[bool],
        shown: Trajectory | None = None,
    ) -> None:
        self.sigma, self.passes, self.good_subgoals, self.lo_passes = sigma, passes, good_subgoals, lo_passes
        self.shown = sigma if shown is None else shown
        self.asked: list[Query] = []

    def __call__(self, query: Query) -> Any:
        self.asked.append(query)
        match query:
            case InspectFull():
                return self.passes
            case HierDemo():
                return self.shown
            case LabelFull(sigma):
                return (1,) * n_steps(sigma)
            case LabelHi(sigma):
                return tuple(self.good_subgoals[self.sigma.index(one)] for one in sigma)
            case InspectLo(one):
                return self.lo_passes[self.sigma.index(one)]
            case LabelLo(one):
                return LoLabels((1,) * len(one.actions), (*(False for _ in one.actions), True))
        raise AssertionError(query)


def carried_out(episode: Generator[Query, Any, Labels], expert: Expert) -> Labels:
    answer = None
    while True:
        try:
            answer = expert(episode.send(answer))
        except StopIteration as over:
            return over.value


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


def test_stagger_learns_nothing_of_an_episode_that_passed() -> None:
    sigma = (segment(0), segment(1))
    learner: Any = ScriptedLearner(sigma, drawn=1)
    expert = Expert(sigma, passes=True, good_subgoals=[0, 1], lo_passes=[True, True])
    assert rows_of(carried_out(hg_stagger(S, learner), expert)) == {}
    assert expert.asked == [InspectFull(sigma)]


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


def test_algorithm_1_asks_for_a_demonstration_from_the_start_state_and_learns_all_of_it() -> None:
    demonstration = (segment(3, n_actions=2, action=1), segment(0, n_actions=1, action=2))
    episode = h_bc(S, learner=None)  # type: ignore[arg-type]  # it never looks at its policies
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
