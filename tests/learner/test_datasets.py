"""What is put into the data buffers, and that nothing is lost there."""

from dataclasses import replace

import numpy as np
import torch
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.learner.kit import examples, segment, state

from waypost.trajectory import Segment, State
from waypost_learner.policies.datasets import UNLABELED, Dataset, Labels, LoLabels, Row
from waypost_learner.rollout.policy_keys import FLAT, META


def learned(segment: Segment, labels: LoLabels) -> list[tuple[int, int]]:
    """The (choice, termination) rows of a labeled segment."""
    taught = Labels()
    taught.append_lo(segment, labels)
    return [(row.choice, row.termination) for row in taught.rows[segment.subgoal or 0]]


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
    return [(row.choice, row.termination) for row in taught.rows[0]]


def test_two_segments_of_one_subgoal_teach_the_same_policy_in_order() -> None:
    taught = Labels()
    taught.append_demonstration((segment(2, 1, action=0), segment(2, 1, action=3)))
    assert [row.choice for row in taught.rows[2]] == [0, UNLABELED, 3, UNLABELED]
    assert [row.choice for row in taught.rows[META]] == [2, 2]


def test_flat_labels_are_one_action_for_each_state_but_the_last() -> None:
    one = segment(None, 3)
    taught = Labels()
    taught.append_flat((one,), [2, 1, 0])
    rows = taught.rows[FLAT]
    assert [(row.choice, row.termination) for row in rows] == [(2, UNLABELED), (1, UNLABELED), (0, UNLABELED)]
    assert [row.observation is s.observation for row, s in zip(rows, one.states, strict=False)] == [True] * 3


def test_a_state_seen_again_in_a_flat_trajectory_teaches_the_same_label_once() -> None:
    one = segment(None, 3)
    going_in_circles = replace(one, states=(one.states[0], one.states[1], one.states[0], one.states[1]))
    taught = Labels()
    taught.append_flat((going_in_circles,), [2, 1, 2])
    assert [row.choice for row in taught.rows[FLAT]] == [2, 1]
    taught = Labels()
    taught.append_flat((going_in_circles,), [2, 1, 3])  # two actions may be as good
    assert [row.choice for row in taught.rows[FLAT]] == [2, 1, 3]


def rows(n: int, first: int = 0) -> list[Row]:
    return [Row(np.full(2, number, np.float32), number % 5, number % 2) for number in range(first, first + n)]


def in_tensors(data: Dataset, shape: tuple[int, ...]) -> Dataset:
    again = Dataset(shape)
    again.load(data.tensors())
    return again


def test_a_buffer_keeps_every_row_in_order() -> None:
    data = Dataset((2,))
    data.append(rows(255))
    data.append(rows(600, first=255))
    assert len(data) == 855
    observations, labels = data[range(855)]
    assert observations[:, 1].tolist() == list(range(855))
    assert labels.tolist() == [[number % 5, number % 2] for number in range(855)]


def test_rows_are_given_as_they_are_asked_for() -> None:
    data = Dataset((2,))
    data.append(rows(9))
    observations, labels = data[[7, 2, 7]]
    assert observations.tolist() == [[7, 7], [2, 2], [7, 7]]
    assert labels.tolist() == [[2, 1], [2, 0], [2, 1]]


@examples
@given(arrays(np.float32, (2, 3, 4, 5)))
def test_observations_come_back_bit_by_bit(pictures: np.ndarray) -> None:
    data = Dataset((3, 4, 5))
    data.append(Row(picture, 0) for picture in pictures)
    for one in (data, in_tensors(data, (3, 4, 5))):
        observations, _ = one[range(2)]
        assert observations.numpy().tobytes() == pictures.tobytes()


def test_an_observation_that_is_seen_turned_is_kept_turned() -> None:
    data, picture = Dataset((3, 3)), np.arange(9, dtype=np.float32).reshape(3, 3)
    data.append([Row(np.rot90(picture), 0)])
    assert data[[0]][0][0].tolist() == np.rot90(picture).tolist()


def test_pictures_take_little_room() -> None:
    data, picture = Dataset((3, 17, 17)), np.zeros((3, 17, 17), np.float32)
    picture[1, ::4] = 1
    data.append([Row(picture, 0)] * 10)
    assert data.tensors()["observations"].numel() < 10 * picture.nbytes / 20


def test_a_buffer_survives_the_way_through_tensors_and_goes_on_growing() -> None:
    data = Dataset((2,))
    data.append(rows(300))
    again = in_tensors(data, (2,))
    again.append(rows(1, first=300))
    data.append(rows(1, first=300))
    assert len(again) == 301
    assert all(map(torch.equal, again[range(301)], data[range(301)]))


def test_an_empty_buffer_survives_the_way_through_tensors() -> None:
    again = in_tensors(Dataset((3, 4, 4)), (3, 4, 4))
    observations, labels = again[range(0)]
    assert (len(again), observations.shape, labels.shape) == (0, (0, 3, 4, 4), (0, 2))
    again.append([Row(np.ones((3, 4, 4), np.float32), 1)])
    assert again[[0]][1].tolist() == [[1, UNLABELED]]


def test_a_row_is_kept_as_it_was_when_the_observation_changes_later() -> None:
    observation = np.zeros(2, np.float32)
    data = Dataset((2,))
    data.append([Row(State(observation, None).observation, 0)])
    observation[:] = 7
    assert data[[0]][0].tolist() == [[0, 0]]
    assert state().observation.tolist() == [0, 0]
