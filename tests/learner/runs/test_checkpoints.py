"""Checkpoints hold all of a learner, are never torn, and are refused with a sentence when they are none."""

from pathlib import Path

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st
from safetensors.torch import load_file, save_file
from tests.learner.kit import TINY, random_labels

from waypost.domains import Domain
from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.corridor import CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.policies.datasets import Row
from waypost_learner.policies.labels import Labels
from waypost_learner.policies.networks import NetworkSpec, blocks
from waypost_learner.rollout.policy_keys import META, pi
from waypost_learner.runs import checkpoints
from waypost_learner.runs.checkpoints import Header, weights_hash
from waypost_learner.runs.config import Progress, TrainConfig

HEADER = Header("a-run", TrainConfig("hg-dagger", domain="corridor", in_flight=2, warm_start=5), Progress(7, 9))


CORRIDOR, MAZE = CorridorDomain(), MazeDomain()  # vectors, pictures


def learner(seed: int = 0, domain: Domain = CORRIDOR) -> Learner:
    return Learner(domain, TINY, seed, threads=1)


def labels(episode: int, domain: Domain = CORRIDOR) -> Labels:
    return random_labels(episode, domain.observation_shape, [META, pi(0), pi(2)])


def trained(episodes: int, seed: int = 0, domain: Domain = CORRIDOR) -> Learner:
    one = learner(seed, domain)
    for episode in range(episodes):
        one.learn(labels(episode, domain))
    return one


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "new folder" / "a-run.safetensors"


@pytest.mark.parametrize("domain", [CORRIDOR, MAZE])
def test_training_goes_on_from_a_checkpoint_as_if_never_interrupted(path: Path, domain: Domain) -> None:
    checkpoints.write(path, trained(4, domain=domain), HEADER, weights_only=False)
    resumed = learner(seed=99, domain=domain)  # all that is restored comes from the file, not from the seed
    checkpoints.load(path, resumed)
    uninterrupted = trained(4, domain=domain)
    for episode in range(4, 8):
        resumed.learn(labels(episode, domain))
        uninterrupted.learn(labels(episode, domain))
    assert weights_hash(resumed) == weights_hash(uninterrupted)
    for key, data in uninterrupted.data.items():
        everything = range(len(data))
        assert all(map(torch.equal, resumed.data[key][everything], data[everything]))


def test_a_policy_that_never_learned_anything_is_restored_too(path: Path) -> None:
    checkpoints.write(path, trained(2), HEADER, weights_only=False)
    resumed = learner(seed=99)
    checkpoints.load(path, resumed)
    assert len(resumed.data[pi(1)]) == 0
    resumed.learn(random_labels(9, (38,), [pi(1)]))
    uninterrupted = trained(2)
    uninterrupted.learn(random_labels(9, (38,), [pi(1)]))
    assert weights_hash(resumed) == weights_hash(uninterrupted)


def test_weights_alone_are_enough_to_act_as_before(path: Path) -> None:
    original = trained(3)
    checkpoints.write(path, original, HEADER, weights_only=True)
    restored = learner(seed=99)
    checkpoints.load(path, restored)
    assert weights_hash(restored) == weights_hash(original)
    seen = np.random.default_rng(0).random((4, 38)).astype(np.float32)
    np.testing.assert_array_equal(restored.policies[pi(0)](seen).logits, original.policies[pi(0)](seen).logits)


def test_a_final_checkpoint_is_smaller_than_one_to_go_on_from(path: Path) -> None:
    checkpoints.write(path, trained(1), HEADER, weights_only=False)
    large = path.stat().st_size
    checkpoints.write(path, trained(1), HEADER, weights_only=True)
    assert path.stat().st_size < large / 2


def test_the_header_comes_back_as_it_was(path: Path) -> None:
    checkpoints.write(path, learner(), HEADER, weights_only=True)
    assert checkpoints.read_header(path) == HEADER


def test_a_checkpoint_replaces_the_one_before_and_leaves_nothing_else_behind(path: Path) -> None:
    for episodes in (1, 2):
        checkpoints.write(
            path, trained(episodes), Header("a-run", HEADER.config, Progress(episodes, episodes)), weights_only=False
        )
    assert checkpoints.read_header(path).progress == Progress(2, 2)
    assert list(path.parent.iterdir()) == [path]


def test_a_write_that_fails_leaves_the_checkpoint_before_it_whole(path: Path) -> None:
    checkpoints.write(path, trained(1), HEADER, weights_only=False)
    before = path.read_bytes()
    path.with_suffix(".tmp").mkdir()  # the next write cannot open its temporary file
    with pytest.raises(IsADirectoryError):
        checkpoints.write(path, trained(2), HEADER, weights_only=False)
    assert path.read_bytes() == before


def test_a_missing_checkpoint_is_refused_by_its_name(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"there is no checkpoint .*none\.safetensors"):
        checkpoints.read_header(tmp_path / "none.safetensors")


@settings(deadline=None, max_examples=25)
@given(share=st.floats(0, 0.99))
def test_a_torn_file_is_refused_with_a_sentence_wherever_it_was_torn(
    tmp_path_factory: pytest.TempPathFactory, share: float
) -> None:
    path = tmp_path_factory.mktemp("torn") / "a-run.safetensors"
    checkpoints.write(path, learner(), HEADER, weights_only=True)
    whole = path.read_bytes()
    path.write_bytes(whole[: int(share * len(whole))])
    with pytest.raises(ValueError, match="is no checkpoint of this version of Waypost"):
        checkpoints.read_header(path)


@pytest.mark.parametrize(
    "metadata",
    [
        None,
        {"waypost": "no json"},
        {"waypost": "[]"},
        {"waypost": '{"run": "a"}'},
        {"waypost": '{"run": "a", "config": {"algorithm": "h-bc", "from_the_future": 1}, "episodes": 3}'},
    ],
)
def test_another_programs_file_is_refused_with_a_sentence(tmp_path: Path, metadata: dict[str, str] | None) -> None:
    path = tmp_path / "foreign.safetensors"
    save_file({"weight": torch.zeros(2)}, path, metadata)
    with pytest.raises(ValueError, match="is no checkpoint of this version of Waypost"):
        checkpoints.read_header(path)


def test_a_folder_is_refused_with_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="is no checkpoint of this version of Waypost"):
        checkpoints.read_header(tmp_path)


def test_a_checkpoint_of_other_networks_is_refused_with_a_sentence(path: Path) -> None:
    checkpoints.write(path, learner(), HEADER, weights_only=True)
    larger = TINY.with_values(network=NetworkSpec(blocks(4), 99))
    with pytest.raises(ValueError, match="does not fit"):
        checkpoints.load(path, Learner(CorridorDomain(), larger, 0, threads=1))


def test_a_run_that_another_version_began_is_refused_with_a_sentence(path: Path) -> None:
    checkpoints.write(path, trained(2), HEADER, weights_only=False)
    written = {name: tensor for name, tensor in load_file(path).items() if not name.endswith(".sizes")}
    save_file(written, path, {"waypost": "{}"})
    with pytest.raises(ValueError, match="does not fit this version of Waypost"):
        checkpoints.load(path, learner())


def test_a_run_whose_rows_say_less_is_refused_with_a_sentence(path: Path) -> None:
    checkpoints.write(path, trained(2), HEADER, weights_only=False)
    rows = {name: tensor for name, tensor in load_file(path).items() if name.endswith(".labels")}
    fewer = {name: tensor[:, :2].contiguous() for name, tensor in rows.items()}
    save_file(load_file(path) | fewer, path, {"waypost": "{}"})
    with pytest.raises(ValueError, match="does not fit this version of Waypost"):
        checkpoints.load(path, learner())


def test_the_hash_changes_with_any_single_weight() -> None:
    one = learner()
    seen = {weights_hash(one)}
    for policy in one.learned.values():
        for parameter in policy.network.parameters():
            with torch.no_grad():
                parameter.view(-1)[-1] += 1e-3
            seen.add(weights_hash(one))
    assert len(seen) == 1 + sum(len(list(policy.network.parameters())) for policy in one.learned.values())


def test_the_hash_depends_on_the_weights_alone() -> None:
    one, other = learner(), learner()
    other.data[pi(0)].append([Row(np.zeros(38, np.float32), 1)])
    assert weights_hash(one) == weights_hash(other)
