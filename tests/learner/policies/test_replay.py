"""Replay buffers: which transitions they keep, and how they sample them."""

from collections import deque
from typing import Any

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples

from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.replay import Replay
from waypost_learner.rollout.experience import Transition


def one_hot(place: int, size: int = 5) -> np.ndarray[Any, np.dtype[np.float32]]:
    return np.eye(size, dtype=np.float32)[place]


def transition(number: int) -> Transition:
    """A transition that can be told by its reward."""
    return Transition(one_hot(number % 5), number % 2, float(number), one_hot((number + 1) % 5), 1)


@examples
@given(st.integers(1, 40), st.integers(0, 120))
def test_replay_keeps_the_newest_up_to_its_capacity(capacity: int, n: int) -> None:
    replay = Replay((5,), DqnSpec(capacity=capacity))
    expected: deque[float] = deque(maxlen=capacity)
    for number in range(n):
        replay.add([transition(number)])
        expected.append(float(number))
    assert len(replay) == len(expected)
    assert sorted(replay.tensors()["reward"].tolist()) == sorted(expected)


def test_rows_are_drawn_in_proportion_to_their_priority_and_weighed_against_it() -> None:
    replay = Replay((5,), DqnSpec(alpha=0.5))
    replay.add([transition(number) for number in range(3)])
    replay.prioritize(torch.arange(3), torch.tensor([0.0, 4.0, 16.0]))  # to the power 0.5: about 0.01, 2 and 4
    rows, found = replay.sample(60_000, torch.Generator().manual_seed(0))
    shares = torch.bincount(rows, minlength=3) / len(rows)
    assert torch.allclose(shares, torch.tensor([0.0017, 0.333, 0.666]), atol=0.01)
    by_row = {int(row): float(weight) for row, weight in zip(rows, found["weight"], strict=True)}
    assert by_row[0] == pytest.approx(1)  # the rarest weighs most
    assert by_row[1] == pytest.approx(2 * by_row[2], rel=1e-3)


def test_a_new_transition_is_as_important_as_the_most_important_one() -> None:
    replay = Replay((5,), DqnSpec(alpha=1.0))
    replay.add([transition(0), transition(1)])
    replay.prioritize(torch.tensor([0, 1]), torch.tensor([9.0, 0.5]))
    replay.add([transition(2)])
    assert replay.tensors()["priority"].tolist() == pytest.approx([9.0, 0.5, 9.0], abs=1e-3)
