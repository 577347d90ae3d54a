"""Q-functions: what they learn, and how they explore."""

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import torch

from waypost.trajectory import Outcome
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


def test_the_same_seed_learns_the_same_from_pictures_too() -> None:
    pictures = np.random.default_rng(0).integers(0, 256, (6, 2, 42, 42), np.uint8)
    transitions = tuple(Transition(i, i % 2, float(i == 4), i + 1, int(i < 4)) for i in range(5))

    def weights() -> list[torch.Tensor]:
        q = QFunction((2, 42, 42), 2, NETWORK, replace(SPEC, margin=0.1), seed=3)
        q.replay.add(Experience(tuple(pictures), transitions, demonstrated=frozenset({1})))
        for _ in range(40):
            q.step()
        return [each.detach() for each in q.network.parameters()]

    assert all(torch.equal(a, b) for a, b in zip(weights(), weights(), strict=True))


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


def attempt(outcome: Outcome | None, alone: bool = True) -> Experience:
    return replace(chain(), outcome=outcome, alone=alone)


def test_experience_can_be_kept_only_from_the_first_success_on() -> None:
    q = QFunction((5,), 2, NETWORK, replace(SPEC, from_success=True), 0)
    sizes = []
    for outcome in ("failed", None, "reached", "failed"):
        one = attempt(outcome)
        q.attempt(one)
        q.remember(one)
        sizes.append(len(q.replay))
    assert sizes == [0, 0, 8, 16]


def succeeding(q: QFunction) -> tuple[list[int], list[float]]:
    """The updates and the exploration after 99 successes, one more, nine failures, and one more."""
    q.remember(chain())
    updates, explores = [], []
    for outcome, times in (("reached", 99), ("reached", 1), ("failed", 9), ("failed", 1)):
        for _ in range(times):
            q.attempt(attempt(outcome))
        before = q.updates
        q.step()
        updates.append(q.updates - before)
        explores.append(q.epsilon)
    return updates, explores


def test_updates_and_exploration_stop_while_the_last_hundred_attempts_succeed_often_enough() -> None:
    updates, explores = succeeding(QFunction((5,), 2, NETWORK, replace(SPEC, stop_above=0.9), 0))
    assert updates == [1, 0, 0, 1]  # 91 of 100 is above 0.9, 90 of 100 is not
    assert [one > 0 for one in explores] == [True, False, False, True]


def test_updates_can_end_for_good_and_exploration_then_stays_as_it_was() -> None:
    spec = replace(SPEC, stop_above=0.9, relearn=False, epsilon=((0, 1.0), (10, 0.0)))
    updates, explores = succeeding(QFunction((5,), 2, NETWORK, spec, 0))
    assert updates == [1, 0, 0, 0]
    assert explores == [0.9, 0.9, 0.9, 0.9]


def test_a_demonstration_is_a_success_but_no_attempt() -> None:
    q = QFunction((5,), 2, NETWORK, SPEC, 0)
    q.attempt(attempt("reached", alone=False))
    assert q.succeeded
    assert not q.attempts


def test_a_demonstrated_choice_exceeds_the_others_by_a_margin() -> None:
    """Both actions of the last cell bring the same; only the demonstration makes one better."""
    both = Experience((one_hot(0),), (Transition(0, 0, 0.0, 0, 0), Transition(0, 1, 0.0, 0, 0)))
    shown = replace(both, transitions=both.transitions[:1], demonstrated=(0,))
    gaps = []
    for demonstration in (both, shown):
        q = QFunction((5,), 2, NETWORK, replace(SPEC, margin=0.5), 0)
        for one in (both, demonstration):
            q.remember(one)
        for _ in range(400):
            q.step()
        ((wrong, right),) = q(one_hot(0)[None]).logits[:, ::-1]
        gaps.append(right - wrong)
    assert gaps[0] == pytest.approx(0, abs=0.05)
    assert gaps[1] > 0.15


@pytest.mark.parametrize("optimizer", ["adam", "rmsprop"])
def test_either_optimizer_learns_the_chain(optimizer: str) -> None:
    spec = replace(SPEC, optimizer=optimizer, learning_rate=1e-2 if optimizer == "adam" else 1e-3)
    values = learned(spec, 900)(np.stack([one_hot(i) for i in range(4)])).logits
    assert values.argmax(1).tolist() == [1, 1, 1, 1]
