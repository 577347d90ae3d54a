"""Train(policy, D): what is learned, from which labels, and that the same seed learns the same."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import torch
from tests.learner.kit import TINY, TINY_TRAIN, random_labels, segment

from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.corridor import CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.policies import device
from waypost_learner.policies.datasets import UNLABELED, Dataset, Row
from waypost_learner.policies.imitation import Policy, TrainSpec
from waypost_learner.policies.labels import Labels, LoLabels
from waypost_learner.policies.networks import NetworkSpec, blocks, build_network
from waypost_learner.rollout.policy_keys import META, pi
from waypost_learner.runs.checkpoints import weights_hash

SPEC = TrainSpec(learning_rate=5e-3, batch=16, passes=2, least=256, most=640, dropout=0.0)
NETWORK = NetworkSpec(blocks(4), hidden=16)


def policy(seed: int = 0, terminates: bool = True, spec: TrainSpec = SPEC, shape: tuple[int, ...] = (2,)) -> Policy:
    return Policy(shape, 2, terminates, NETWORK, spec, seed)


def data(n: int, choice: bool = True, termination: bool = True, seed: int = 0) -> Dataset:
    """Points of the square; the choice is the sign of the first coordinate, the termination that of the second."""
    points = np.random.default_rng(seed).uniform(-1, 1, (n, 2)).astype(np.float32)
    filled = Dataset((2,))
    filled.append(
        Row(point, int(point[0] > 0) if choice else UNLABELED, int(point[1] > 0) if termination else UNLABELED)
        for point in points
    )
    return filled


def weights(trained: Policy) -> list[torch.Tensor]:
    return [parameter.detach().clone() for parameter in trained.network.parameters()]


def equal(one: list[torch.Tensor], other: list[torch.Tensor]) -> list[bool]:
    return [bool(torch.equal(a, b)) for a, b in zip(one, other, strict=True)]


def test_a_policy_with_terminations_learns_both_of_a_separable_task() -> None:
    learned = policy()
    for _ in range(12):
        learned.train(data(200))
    observations, labels = data(200, seed=1)[range(200)]
    says = learned(observations.numpy())
    assert (says.logits.argmax(1) == labels[:, 0].numpy()).mean() > 0.95
    assert ((says.termination > 0.5) == labels[:, 1].numpy()).mean() > 0.95


def test_rows_without_any_label_teach_nothing() -> None:
    trained = policy()
    before = weights(trained)
    trained.train(data(50, choice=False, termination=False))
    assert all(equal(before, weights(trained)))


def test_without_action_labels_the_choices_stay_as_they_are() -> None:
    trained = policy()
    before = weights(trained)
    trained.train(data(50, choice=False))
    *_, weight, bias = weights(trained)
    assert torch.equal(weight[:2], before[-2][:2])
    assert torch.equal(bias[:2], before[-1][:2])
    assert not torch.equal(weight[2], before[-2][2])


def test_without_termination_labels_the_termination_stays_as_it_is() -> None:
    trained = policy()
    before = weights(trained)
    trained.train(data(50, termination=False))
    *_, weight, bias = weights(trained)
    assert torch.equal(weight[2], before[-2][2])
    assert torch.equal(bias[2], before[-1][2])
    assert not torch.equal(weight[:2], before[-2][:2])


def test_one_unlabeled_row_more_in_a_batch_only_scales_what_the_others_teach() -> None:
    labeled = Dataset((2,))
    labeled.append([Row(np.array([1, 1], np.float32), 0, 1)])
    both = Dataset((2,))
    both.append([Row(np.array([1, 1], np.float32), 0, 1), Row(np.array([-5, 3], np.float32), UNLABELED)])
    gradients = []
    for some in (labeled, both):
        trained = policy(spec=TrainSpec(batch=2, least=1, dropout=0.0, bf16=False))
        trained.train(some)
        gradients.append([parameter.grad.clone() for parameter in trained.network.parameters()])
    for alone, beside in zip(*gradients, strict=True):
        torch.testing.assert_close(alone / 2, beside)


def test_an_empty_buffer_trains_nothing() -> None:
    trained = policy()
    before = weights(trained)
    trained.train(Dataset((2,)))
    assert all(equal(before, weights(trained)))


def test_a_round_is_so_many_passes_over_the_buffer_within_a_least_and_a_most_number_of_rows() -> None:
    for n_rows, n_learned in ((1, 256), (100, 256), (128, 256), (200, 400), (320, 640), (1_000, 640)):
        trained = policy()
        trained.train(data(n_rows))
        steps = {int(state["step"]) for state in trained.optimizer.state_dict()["state"].values()}
        assert steps == {n_learned // SPEC.batch}


def test_a_policy_without_a_termination_head_never_fires() -> None:
    says = policy(terminates=False)(np.zeros((3, 2), np.float32))
    assert says.logits.shape == (3, 2)
    assert says.termination.tolist() == [0, 0, 0]


def test_a_policy_says_the_same_of_a_state_alone_and_in_a_batch_also_after_training() -> None:
    trained = policy(shape=(3, 17, 17))
    batch = np.random.default_rng(0).normal(size=(5, 3, 17, 17)).astype(np.float32)
    filled = Dataset((3, 17, 17))
    filled.append(Row(picture, 1, 0) for picture in batch)
    trained.train(filled)
    together = trained(batch)
    for place in range(5):
        alone = trained(batch[place : place + 1])
        np.testing.assert_allclose(alone.logits[0], together.logits[place], rtol=1e-5, atol=1e-6)


def maze_labels(seed: int) -> Labels:
    return random_labels(seed, (3, 17, 17), [META, *map(pi, range(5))], n=40, choices=4)


def trained_hash(threads: int, seed: int = 0) -> str:
    learner = Learner(MazeDomain(), TINY, seed, threads=threads)
    for episode in range(3):
        learner.learn(maze_labels(episode))
    return weights_hash(learner)


def test_the_same_seed_gives_the_same_weights_to_the_last_bit_on_one_thread_and_on_two() -> None:
    once = trained_hash(threads=1)
    assert trained_hash(threads=1) == once
    assert [trained_hash(threads=2) for _ in range(3)] == [once] * 3


def test_another_seed_gives_other_weights() -> None:
    assert trained_hash(threads=1, seed=1) != trained_hash(threads=1)


def test_policies_whose_buffer_did_not_grow_are_not_trained() -> None:
    learner = Learner(CorridorDomain(), TINY, seed=0, threads=1)
    before = {key: weights(one) for key, one in learner.policies.items()}
    labels = random_labels(0, (38,), [pi(1)])
    labels.append_lo(segment(2, n_actions=1), LoLabels((None,), (True, False)))  # gives no row
    learner.learn(labels)
    changed = {key for key, one in learner.policies.items() if not all(equal(before[key], weights(one)))}
    assert changed == {pi(1)}


def test_policies_that_train_every_episode_do_so_without_new_labels_too() -> None:
    learner = Learner(
        CorridorDomain(), TINY.with_values(train_hi=replace(TINY_TRAIN, every_episode=True)), 0, threads=1
    )
    learner.learn(random_labels(0, (38,), [META, pi(1)]))
    before = {key: weights(one) for key, one in learner.policies.items()}
    learner.learn(Labels())
    changed = {key for key, one in learner.policies.items() if not all(equal(before[key], weights(one)))}
    assert changed == {META}


def test_training_in_bf16_where_the_processor_has_it_keeps_the_weights_in_32_bits() -> None:
    trained = policy(shape=(3, 17, 17))
    filled = Dataset((3, 17, 17))
    filled.append([Row(np.ones((3, 17, 17), np.float32), 1, 0)])
    trained.train(filled)
    assert {weight.dtype for weight in weights(trained)} == {torch.float32}
    assert all(torch.isfinite(weight).all() for weight in weights(trained))


@pytest.mark.parametrize(
    ("capabilities", "pays"),
    [
        ({"amx_bf16": True, "avx512_bf16": True, "cpu_name": "Intel Xeon"}, True),
        ({"amx_bf16": False, "avx512_bf16": True, "cpu_name": "Intel Xeon"}, False),
        ({"amx_bf16": False, "avx512_bf16": True, "cpu_name": "AMD EPYC 9R14"}, True),
        ({"amx_bf16": False, "avx512_bf16": False, "cpu_name": "Intel Xeon"}, False),
    ],
)
def test_training_uses_bf16_only_on_processors_that_it_makes_faster(
    monkeypatch: pytest.MonkeyPatch, capabilities: dict[str, object], pays: bool
) -> None:
    monkeypatch.setattr(device, "DEVICE", torch.device("cpu"))
    monkeypatch.setattr(torch.cpu, "get_capabilities", lambda: {"architecture": "x86_64", **capabilities})
    assert device.has_bf16() is pays


def test_a_network_can_read_bytes_instead_of_fractions() -> None:
    fractions, bytes_ = (
        build_network((3, 17, 17), 4, replace(NETWORK, scale=scale), 0.0, torch.Generator().manual_seed(1))
        for scale in (1.0, 255.0)
    )
    pictures = torch.rand(2, 3, 17, 17)
    assert torch.allclose(bytes_(pictures), fractions(255 * pictures))
    assert not torch.allclose(bytes_(pictures), fractions(pictures))


def test_the_papers_network_has_the_layers_of_table_1() -> None:
    layers = build_network((3, 17, 17), 4, NetworkSpec(), 0.5, torch.Generator())
    sizes = [(layer.in_channels, layer.out_channels) for layer in layers if isinstance(layer, torch.nn.Conv2d)]
    assert sizes == [(3, 32), (32, 32), (32, 64), (64, 64)]
    assert [layer.out_features for layer in layers if isinstance(layer, torch.nn.Linear)] == [256, 4]
    assert sum(isinstance(layer, torch.nn.MaxPool2d) for layer in layers) == 2


def test_observations_of_another_shape_are_refused_with_the_shapes_that_work() -> None:
    with pytest.raises(ValueError, match=r"\(C, rows, columns\) or \(features,\)"):
        build_network((3, 17), 4, NetworkSpec(), 0.5, torch.Generator())


def test_dropout_is_on_in_training_alone() -> None:
    trained = policy(spec=TrainSpec(least=16, dropout=0.5, batch=16))
    for _ in range(2):  # before the first training and after it
        said = [trained(np.ones((1, 2), np.float32)).logits.tolist() for _ in range(10)]
        assert said == said[:1] * 10
        trained.train(data(16))


@pytest.mark.parametrize("idle", [0, 32])
def test_policies_train_idle_by_the_rows_of_their_preset(idle: int) -> None:
    trained = policy(spec=replace(SPEC, idle=idle))
    before = weights(trained)
    assert sum(1 for _ in trained.idle_updates(data(50))) == idle / SPEC.batch
    assert all(equal(before, weights(trained))) == (idle == 0)


@pytest.mark.parametrize(
    "number",
    [{"batch": 0}, {"most": 0}, {"least": -1}, {"passes": -1}, {"idle": -1}, {"averaging": 1.0}, {"averaging": -0.1}],
)
def test_numbers_with_which_nothing_could_be_trained_are_refused(number: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="training needs"):
        TrainSpec(**number)


def taught_mu(idle: int) -> Learner:
    """A learner that has just learned an episode's labels of mu, after which policies train on `idle` rows more."""
    domain = CorridorDomain()
    spec = replace(TINY_TRAIN, idle=idle)
    learner = Learner(domain, TINY.with_values(train_hi=spec, train_lo=spec), seed=0, threads=1)
    sigma = learner.roll_out(learner.start(domain.instances("random").train[0], 0))
    labels = Labels()
    labels.append_hi(sigma, [0 for _ in sigma])
    learner.learn(labels)
    return learner


def test_policies_train_idle_once_after_an_episode_and_only_those_it_taught() -> None:
    learner = taught_mu(idle=32)
    learned = {key: weights(one) for key, one in learner.imitators.items()}
    learner.train_idle()
    once = {key: weights(one) for key, one in learner.imitators.items()}
    learner.train_idle()
    assert not all(equal(learned[META], once[META]))
    for key, one in learner.imitators.items():
        assert all(equal(once[key], weights(one)))
        assert key == META or all(equal(learned[key], once[key]))


def test_what_idle_training_learns_does_not_depend_on_where_it_stops() -> None:
    without_stops, with_stops, used_early = (taught_mu(idle=10 * TINY_TRAIN.batch) for _ in range(3))
    without_stops.train_idle()
    stops = 0
    while not with_stops.train_idle(seconds=0):
        stops += 1
    assert stops == 10
    used_early.train_idle(seconds=0)
    assert used_early.policies  # whoever uses them gets policies that have trained to the end
    expected = weights(without_stops.imitators[META])
    for learner in (with_stops, used_early):
        assert all(equal(expected, weights(learner.imitators[META])))
