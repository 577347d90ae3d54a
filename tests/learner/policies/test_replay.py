"""Replay buffers: which transitions they keep, and how they sample them."""

import tracemalloc
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
from waypost_learner.rollout.experience import Experience, Transition


def one_hot(place: int, size: int = 5) -> np.ndarray[Any, np.dtype[np.float32]]:
    return np.eye(size, dtype=np.float32)[place]


def experience(*numbers: int) -> Experience:
    """Transitions that can be told by their rewards."""
    observations = [one_hot(place % 5) for number in numbers for place in (number, number + 1)]
    transitions = [Transition(2 * n, number % 2, float(number), 2 * n + 1, 1) for n, number in enumerate(numbers)]
    return Experience(tuple(observations), tuple(transitions))


@examples
@given(st.integers(1, 40), st.integers(0, 120))
def test_replay_keeps_the_newest_up_to_its_capacity(capacity: int, n: int) -> None:
    replay = Replay((5,), DqnSpec(capacity=capacity))
    expected: deque[float] = deque(maxlen=capacity)
    for number in range(n):
        replay.add(experience(number))
        expected.append(float(number))
    assert len(replay) == len(expected)
    assert sorted(replay.tensors()["reward"].tolist()) == sorted(expected)


def stacked(pictures: np.ndarray, depth: int = 4) -> Experience:
    """A walk through pictures uint8[n, rows, columns], seen `depth` at a time, with returns of three steps."""
    padded = np.concatenate([np.repeat(pictures[:1], depth - 1, axis=0), pictures])
    observations = [padded[n : n + depth] for n in range(len(pictures))]
    last = len(pictures) - 1
    transitions = [Transition(n, n % 3, float(n), min(n + 3, last), min(3, last - n)) for n in range(last)]
    return Experience(tuple(observations), tuple(transitions))


@examples
@given(st.integers(1, 60), st.lists(st.integers(2, 30), min_size=1, max_size=8), st.integers(0, 9))
def test_stacked_pictures_come_back_as_they_were_and_each_is_stored_once(
    capacity: int, lengths: list[int], seed: int
) -> None:
    rng = np.random.default_rng(seed)
    replay, wanted = Replay((4, 6, 6), DqnSpec(capacity=capacity)), deque[tuple[Any, Any, float]](maxlen=capacity)
    for length in lengths:
        walk = stacked(rng.integers(0, 256, (length, 6, 6), np.uint8))
        replay.add(walk)
        for one in walk.transitions:
            wanted.append((walk.observations[one.state], walk.observations[one.next_state], one.reward))
    fresh = Replay((4, 6, 6), DqnSpec(capacity=capacity))
    fresh.load(replay.tensors())
    for buffer in (replay, fresh):
        _, found = buffer.sample(64, torch.Generator().manual_seed(seed))
        for before, after, reward in zip(found["before"], found["after"], found["reward"], strict=True):
            same = [one for one in wanted if one[2] == reward]
            assert any(
                np.array_equal(before.cpu().numpy(), b / np.float32(255))
                and np.array_equal(after.cpu().numpy(), a / np.float32(255))
                for b, a, _ in same
            )
    # One new picture for each state, and the pictures around the first and the last state of each walk.
    assert len(replay.tensors()["sizes"]) <= len(wanted) + 7 * len(lengths) + 3


def test_rows_are_drawn_in_proportion_to_their_priority_and_weighed_against_it() -> None:
    replay = Replay((5,), DqnSpec(alpha=0.5))
    replay.add(experience(0, 1, 2))
    replay.prioritize(torch.arange(3), torch.tensor([0.0, 4.0, 16.0]))  # to the power 0.5: about 0.01, 2 and 4
    rows, found = replay.sample(60_000, torch.Generator().manual_seed(0))
    shares = torch.bincount(rows, minlength=3) / len(rows)
    assert torch.allclose(shares, torch.tensor([0.0017, 0.333, 0.666]), atol=0.01)
    by_row = {int(row): float(weight) for row, weight in zip(rows, found["weight"], strict=True)}
    assert by_row[0] == pytest.approx(1)  # the rarest weighs most
    assert by_row[1] == pytest.approx(2 * by_row[2], rel=1e-3)


def test_a_new_transition_is_as_important_as_the_most_important_one() -> None:
    replay = Replay((5,), DqnSpec(alpha=1.0))
    replay.add(experience(0, 1))
    replay.prioritize(torch.tensor([0, 1]), torch.tensor([9.0, 0.5]))
    replay.add(experience(2))
    assert replay.tensors()["priority"].tolist() == pytest.approx([9.0, 0.5, 9.0], abs=1e-3)


@pytest.mark.parametrize(("capacity", "n"), [(1, 1), (64, 64), (64, 100), (65, 65), (1000, 700), (1000, 1300)])
def test_each_row_of_a_large_buffer_is_drawn_in_proportion_to_its_priority(capacity: int, n: int) -> None:
    replay = Replay((5,), DqnSpec(capacity=capacity, alpha=0.6))
    replay.add(experience(*range(n)))
    errors = torch.rand(len(replay), generator=torch.Generator().manual_seed(1)) ** 4
    replay.prioritize(torch.arange(len(replay)), errors)
    drawn = 400 * len(replay)
    rows, found = replay.sample(drawn, torch.Generator().manual_seed(0))
    priorities = (errors.double() + 1e-4) ** 0.6
    expected = drawn * priorities / priorities.sum()
    counts = torch.bincount(rows, minlength=len(replay))
    assert len(counts) == len(replay)  # no row that was never filled
    assert (counts - expected).abs().div(expected.sqrt()).max() < 5  # standard deviations
    assert torch.allclose(found["weight"], (priorities.min() / priorities[rows]).float())


def test_a_loaded_buffer_draws_the_same_rows_and_only_its_own() -> None:
    long, short = (Replay((4, 6, 6), DqnSpec(capacity=300)) for _ in range(2))
    pictures = np.random.default_rng(0).integers(0, 256, (200, 6, 6), np.uint8)
    long.add(stacked(pictures))
    short.add(stacked(pictures[:20]))
    short.prioritize(torch.arange(19), torch.linspace(0.01, 1, 19))
    long.load(short.tensors())  # over a fuller one
    for buffer in (long, short):
        buffer.add(stacked(pictures[50:60]))
    (rows, found), (same, wanted) = (one.sample(2_000, torch.Generator().manual_seed(0)) for one in (long, short))
    assert torch.equal(rows, same)
    assert int(rows.max()) == 19 + 9 - 1
    assert all(torch.equal(found[name], wanted[name]) for name in wanted)
    assert all(torch.equal(value, long.tensors()[name]) for name, value in short.tensors().items())


@pytest.mark.parametrize("shape", [(5,), (2, 6, 6)])
def test_an_empty_buffer_comes_back_from_a_checkpoint(shape: tuple[int, ...]) -> None:
    """Until a subgoal is first chosen, its buffer is empty."""
    replay = Replay(shape, DqnSpec(capacity=300))
    replay.load(Replay(shape, DqnSpec(capacity=300)).tensors())
    assert len(replay) == 0


def test_atari_transitions_take_little_more_memory_than_one_picture_each() -> None:
    """So that 500,000 of them take less than 4 GiB. Full buffers free the memory of the oldest."""
    replay = Replay((4, 84, 84), DqnSpec(capacity=300))
    pictures = np.random.default_rng(0).integers(0, 256, (901, 84, 84), np.uint8)
    walks = [stacked(pictures[first : first + 101]) for first in range(0, 900, 100)]
    tracemalloc.start()
    for walk in walks:
        replay.add(walk)
    memory, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 300 * 84 * 84 < memory < 300 * 4 * 2**30 / 500_000
