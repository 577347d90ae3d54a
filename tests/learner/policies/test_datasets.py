"""Data buffers keep every row, in order and bit for bit."""

import numpy as np
import torch
from hypothesis import given
from hypothesis.extra.numpy import arrays
from tests.learner.kit import examples, state

from waypost.trajectory import State
from waypost_learner.policies.datasets import UNLABELED, Dataset, Row


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
    assert labels.tolist() == [[number % 5, number % 2, True] for number in range(855)]


def test_rows_are_given_as_they_are_asked_for() -> None:
    data = Dataset((2,))
    data.append(rows(9))
    observations, labels = data[[7, 2, 7]]
    assert observations.tolist() == [[7, 7], [2, 2], [7, 7]]
    assert labels.tolist() == [[2, 1, True], [2, 0, True], [2, 1, True]]


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
    assert (len(again), observations.shape, labels.shape) == (0, (0, 3, 4, 4), (0, 3))
    again.append([Row(np.ones((3, 4, 4), np.float32), 1)])
    assert again[[0]][1].tolist() == [[1, UNLABELED, True]]


def test_a_row_is_kept_as_it_was_when_the_observation_changes_later() -> None:
    observation = np.zeros(2, np.float32)
    data = Dataset((2,))
    data.append([Row(State(observation, None).observation, 0)])
    observation[:] = 7
    assert data[[0]][0].tolist() == [[0, 0]]
    assert state().observation.tolist() == [0, 0]


def test_a_buffer_counts_its_choices_and_those_after_which_a_segment_ended() -> None:
    seen = np.zeros(2, np.float32)
    data = Dataset((2,))
    ended, going = [Row(seen, UNLABELED, 1)], [Row(seen, UNLABELED, 0)]  # where it should end, no action is labeled
    data.append([Row(seen, 2), Row(seen, 1, 0), *ended, Row(seen, 2), *ended, Row(seen, 0), *going])
    assert data.counts(4).tolist() == [1, 1, 2, 0]
    assert data.last_counts(4).tolist() == [0, 1, 1, 0]
    assert Dataset((2,)).last_counts(4).tolist() == [0, 0, 0, 0]
