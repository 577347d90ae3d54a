"""Which rows the labels of an episode become."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples, segment

from waypost.trajectory import Segment
from waypost_learner.policies.datasets import UNLABELED
from waypost_learner.policies.labels import Labels, LoLabels, rows_of
from waypost_learner.rollout.policy_keys import FLAT, META, pi


def learned(segment: Segment, labels: LoLabels) -> list[tuple[int, int]]:
    """The (choice, termination) rows of a labeled segment."""
    taught = Labels()
    taught.append_lo(segment, labels)
    return [(row.choice, row.termination) for row in rows_of(taught)[pi(segment.subgoal or 0)]]


def test_a_segment_that_should_go_on_teaches_every_action_and_that_it_is_not_over() -> None:
    labels = LoLabels((3, 2), (False, False, False))
    assert learned(segment(1, 2), labels) == [(3, UNLABELED), (2, 0), (UNLABELED, 0)]


def test_the_state_where_a_segment_ends_has_a_termination_and_no_action() -> None:
    labels = LoLabels((3, 2), (False, False, True))
    assert learned(segment(1, 2), labels) == [(3, UNLABELED), (2, 0), (UNLABELED, 1)]


def test_nothing_after_an_overshoot_is_learned_even_if_it_was_labeled() -> None:
    labels = LoLabels((3, 2, 1, 0), (False, False, True, True, False))
    assert learned(segment(1, 4), labels) == [(3, UNLABELED), (2, 0), (UNLABELED, 1)]


def test_the_termination_at_the_first_state_is_never_learned() -> None:
    assert learned(segment(1, 2), LoLabels((None, None), (True, True, True))) == []
    assert learned(segment(1, 1), LoLabels((0,), (False, True))) == [(0, UNLABELED), (UNLABELED, 1)]


@examples
@given(
    st.lists(st.tuples(st.one_of(st.none(), st.integers(0, 3)), st.booleans()), min_size=1, max_size=10), st.booleans()
)
def test_no_row_is_without_a_label_and_none_has_an_action_where_the_segment_ends(
    steps: list[tuple[int | None, bool]], last: bool
) -> None:
    actions, ends = (tuple(column) for column in zip(*steps, strict=True))
    rows = learned_or_nothing(segment(0, len(actions)), LoLabels(actions, (*ends, last)))
    assert all(choice != UNLABELED or termination != UNLABELED for choice, termination in rows)
    assert all(choice == UNLABELED for choice, termination in rows if termination == 1)
    assert sum(termination == 1 for _, termination in rows) <= 1


def learned_or_nothing(one: Segment, labels: LoLabels) -> list[tuple[int, int]]:
    taught = Labels()
    taught.append_lo(one, labels)
    return [(row.choice, row.termination) for row in rows_of(taught)[pi(0)]]


def test_two_segments_of_one_subgoal_teach_the_same_policy_in_order() -> None:
    taught = Labels()
    taught.append_demonstration((segment(2, 1, action=0), segment(2, 1, action=3)))
    assert [row.choice for row in rows_of(taught)[pi(2)]] == [0, UNLABELED, 3, UNLABELED]
    assert [row.choice for row in rows_of(taught)[META]] == [2, 2]


def test_flat_labels_are_one_action_for_each_state_but_the_last() -> None:
    one = segment(None, 3)
    taught = Labels()
    taught.append_flat((one,), [2, 1, 0])
    rows = rows_of(taught)[FLAT]
    assert [(row.choice, row.termination) for row in rows] == [(2, UNLABELED), (1, UNLABELED), (0, UNLABELED)]
    assert [row.observation is s.observation for row, s in zip(rows, one.states, strict=False)] == [True] * 3


def test_a_state_seen_again_in_a_flat_trajectory_teaches_the_same_label_once() -> None:
    one = segment(None, 3)
    going_in_circles = replace(one, states=(one.states[0], one.states[1], one.states[0], one.states[1]))
    taught = Labels()
    taught.append_flat((going_in_circles,), [2, 1, 2])
    assert [row.choice for row in rows_of(taught)[FLAT]] == [2, 1]
    taught = Labels()
    taught.append_flat((going_in_circles,), [2, 1, 3])  # two actions may be as good
    assert [row.choice for row in rows_of(taught)[FLAT]] == [2, 1, 3]


class Relabeling:
    """A domain that derives one HI row from each labeled trajectory and repeats each demonstrated segment."""

    def relabeled(self, trajectory, good_subgoals):  # type: ignore[no-untyped-def]
        return [(trajectory[0].start.observation, 10 + good_subgoals[0])]

    def retraced(self, demonstration):  # type: ignore[no-untyped-def]
        return demonstration


def test_rows_come_in_the_order_of_the_labels_and_relabeled_ones_after_them() -> None:
    taught = Labels()
    taught.append_hi((segment(0), segment(1)), [4, 3])
    taught.append_demonstration((segment(2, 1, action=1),))
    taught.append_lo(segment(2, 1), LoLabels((3,), (False, False)))
    rows = rows_of(taught, Relabeling())  # type: ignore[arg-type]
    assert [row.choice for row in rows[META]] == [4, 3, 2, 14, 12]
    shown, labeled = [(1, UNLABELED), (UNLABELED, 1)], [(3, UNLABELED), (UNLABELED, 0)]
    assert [(row.choice, row.termination) for row in rows[pi(2)]] == shown + labeled + shown


def test_rows_are_derived_without_changing_the_labels() -> None:
    taught = Labels()
    taught.append_demonstration((segment(2, 1),))
    first = rows_of(taught, Relabeling())  # type: ignore[arg-type]
    assert rows_of(taught, Relabeling()).keys() == first.keys() == {META, pi(2)}  # type: ignore[arg-type]
    assert [len(rows) for rows in rows_of(taught, Relabeling()).values()] == [2, 4]  # type: ignore[arg-type]
    assert [len(rows) for rows in rows_of(taught).values()] == [1, 2]
