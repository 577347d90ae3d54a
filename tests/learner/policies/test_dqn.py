"""Q-functions: what they learn, and how they explore."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import torch

from waypost_learner.policies.dqn import DqnSpec, QFunction
from waypost_learner.policies.networks import NetworkSpec, blocks
from waypost_learner.rollout.experience import Experience, Transition

NETWORK = NetworkSpec(blocks(4), hidden=32)


def one_hot(place: int, size: int = 5) -> np.ndarray[Any, np.dtype[np.float32]]:
    return np.eye(size, dtype=np.float32)[place]


def chain() -> Experience:
    """Five cells in a row: action 1 goes right and brings 1 at the end, action 0 ends the episode with nothing."""
    right = [Transition(i, 1, float(i == 3), i + 1, 0 if i == 3 else 1) for i in range(4)]
    left = [Transition(i, 0, 0.0, i, 0) for i in range(4)]
    return Experience(tuple(one_hot(i) for i in range(5)), (*right, *left))


def learned(spec: DqnSpec, steps: int, seed: int = 0) -> QFunction:
    q = QFunction((5,), 2, NETWORK, spec, seed)
    q.replay.add(chain())
    for _ in range(steps):
        q.step()
    return q


SPEC = DqnSpec(
    learning_rate=1e-2,
    batch=16,
    update_every=1,
    discount=0.9,
    target_every=20,
    least=1,
    epsilon=((0, 1.0), (100, 0.02)),
    bf16=False,
)


def test_a_chain_is_learned_to_its_discounted_values() -> None:
    values = learned(SPEC, 600)(np.stack([one_hot(i) for i in range(4)])).logits
    assert np.allclose(values[:, 1], [0.9**3, 0.9**2, 0.9, 1.0], atol=0.05)
    assert np.allclose(values[:, 0], 0, atol=0.05)


def test_the_same_seed_learns_the_same_bit_by_bit() -> None:
    same, other = ([p.detach() for p in learned(SPEC, 50, seed).network.parameters()] for seed in (3, 3))
    assert all(torch.equal(a, b) for a, b in zip(same, other, strict=True))


def test_the_best_choice_is_chosen_by_one_network_and_valued_by_the_other() -> None:
    spec = DqnSpec(learning_rate=0.0, batch=64, update_every=1, least=1, target_every=10**9, alpha=1.0, bf16=False)
    q = QFunction((5,), 2, NETWORK, spec, 0)
    for network, bias in ((q.network, [0.0, 1.0]), (q.target, [7.0, 3.0])):  # the target's own best would be 7
        for parameter in network.parameters():
            torch.nn.init.zeros_(parameter)
        last = list(network.parameters())[-1]
        last.data.copy_(torch.tensor(bias))
    q.replay.add(Experience((one_hot(0), one_hot(1)), (Transition(0, 0, 0.0, 1, 1),)))
    q.step()
    ((_, found),) = [q.replay.sample(1, torch.Generator().manual_seed(0))]
    assert found["priority"].item() == pytest.approx(0.9 * 3.0, abs=1e-3)  # the error: wanted 0.9 * 3, was 0


def test_exploration_goes_down_to_its_floor_with_the_steps_of_the_same_q_function() -> None:
    q = QFunction((5,), 2, NETWORK, SPEC, 0)
    epsilons = []
    for _ in range(150):
        epsilons.append(q.epsilon)
        q.step()
    assert epsilons[0] == 1
    assert all(a >= b for a, b in pairwise(epsilons))
    assert epsilons[50] == pytest.approx(0.51)
    assert epsilons[100:] == pytest.approx([0.02] * 50)


def test_nothing_is_learned_before_there_is_the_least_experience() -> None:
    q = QFunction((5,), 2, NETWORK, DqnSpec(least=9, update_every=1, bf16=False), 0)
    q.replay.add(chain())
    for _ in range(20):
        q.step()
    assert (q.steps, q.updates) == (20, 0)
