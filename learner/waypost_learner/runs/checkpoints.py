"""Checkpoints: everything a learner is, in one safetensors file, written so that it is never torn.

Tensors: `policy.KEY.NAME` (the weights that act), and while a run is under way also `optimizer.KEY.INDEX.NAME`,
`data.KEY.*` (the buffers), `rng.KEY`, and `due` (the policies that will train on); where what acts is an average,
`trained.KEY.NAME` (what it is of) and `averaged.KEY` (of how many); for a Q-function `target.KEY.NAME` and `counts.KEY`
(steps, updates). What else must be known is JSON in the file's metadata. No code is stored, so none can run.
"""

import hashlib
import json
import os
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save

from waypost_learner.algorithms.learner import Learner
from waypost_learner.runs.config import Progress, TrainConfig

Tensors = dict[str, torch.Tensor]


@dataclass(frozen=True)
class Header:
    """What a checkpoint is of."""

    run: str
    config: TrainConfig
    progress: Progress


def write(path: Path, learner: Learner, header: Header, weights_only: bool) -> None:
    """Write a checkpoint: to a temporary file first, synced, then renamed over the old one."""
    tensors = dict(_weights(learner))
    if not weights_only:
        tensors |= _training_state(learner)
    metadata = {"waypost": json.dumps(asdict(header))}
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_suffix(".tmp")
    with temporary.open("wb") as file:
        file.write(save({name: tensor.contiguous() for name, tensor in tensors.items()}, metadata))
        file.flush()
        os.fsync(file.fileno())
    temporary.replace(path)
    folder = os.open(path.parent, os.O_RDONLY)
    try:
        os.fsync(folder)
    finally:
        os.close(folder)


def read_header(path: Path) -> Header:
    """Return what a checkpoint is of.

    Raises:
        ValueError: there is no such checkpoint, or the file is none.
    """
    try:
        with safe_open(path, "pt") as file:
            fields = json.loads((file.metadata() or {})["waypost"])
        return Header(fields["run"], TrainConfig(**fields["config"]), Progress(**fields["progress"]))
    except FileNotFoundError as error:
        raise ValueError(f"there is no checkpoint {path}") from error
    except (SafetensorError, OSError, KeyError, TypeError, json.JSONDecodeError) as error:
        raise ValueError(f"{path} is no checkpoint of this version of Waypost") from error


def load(path: Path, learner: Learner) -> None:
    """Put a checkpoint's weights, and its training state if it has one, into a learner of the same configuration.

    Raises:
        ValueError: its networks are others than the learner's, or another version of Waypost wrote it.
    """
    with safe_open(path, "pt") as file:
        tensors = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118 (no mapping)
    try:
        _restore(tensors, learner)
    except (KeyError, RuntimeError) as error:
        raise ValueError(
            f"{path} does not fit this version of Waypost; go on with the version that wrote it, or begin anew"
        ) from error


def _restore(tensors: Tensors, learner: Learner) -> None:
    for key, policy in learner.learned.items():
        policy.acting.load_state_dict(_below(tensors, f"policy.{key}."))
        if f"rng.{key}" in tensors:
            policy.rng.set_state(tensors[f"rng.{key}"])
            _load_optimizer(policy.optimizer, _below(tensors, f"optimizer.{key}."))
    learner.due = tensors["due"].tolist() if "due" in tensors else []
    for key, policy in learner.imitators.items():
        if f"rng.{key}" in tensors:
            if policy.average is not None:
                policy.network.load_state_dict(_below(tensors, f"trained.{key}."))
                policy.average.n_averaged.copy_(tensors[f"averaged.{key}"])
            learner.data[key].load(_below(tensors, f"data.{key}."))
    for key, q in learner.q.items():
        if f"rng.{key}" in tensors:
            q.target.load_state_dict(_below(tensors, f"target.{key}."))
            q.replay.load(_below(tensors, f"data.{key}."))
            q.steps, q.updates = tensors[f"counts.{key}"].tolist()


def weights_hash(learner: Learner) -> str:
    """Return the SHA-256 of all weights: equal if and only if the policies are, bit by bit."""
    digest = hashlib.sha256()
    for name, tensor in sorted(_weights(learner)):
        digest.update(name.encode())
        digest.update(tensor.cpu().contiguous().numpy().tobytes())
    return digest.hexdigest()


def _weights(learner: Learner) -> Iterator[tuple[str, torch.Tensor]]:
    for key, policy in learner.learned.items():
        for name, tensor in policy.acting.state_dict().items():
            yield f"policy.{key}.{name}", tensor


def _training_state(learner: Learner) -> Tensors:
    tensors: Tensors = {"due": torch.tensor(learner.due, dtype=torch.int64)}
    for key, policy in learner.learned.items():
        for index, state in policy.optimizer.state_dict()["state"].items():
            tensors |= {f"optimizer.{key}.{index}.{name}": tensor for name, tensor in state.items()}
        tensors[f"rng.{key}"] = policy.rng.get_state()
    for key, data in learner.data.items():
        tensors |= {f"data.{key}.{name}": tensor for name, tensor in data.tensors().items()}
    for key, policy in learner.imitators.items():
        if policy.average is not None:
            tensors |= {f"trained.{key}.{name}": tensor for name, tensor in policy.network.state_dict().items()}
            tensors[f"averaged.{key}"] = policy.average.n_averaged
    for key, q in learner.q.items():
        tensors |= {f"target.{key}.{name}": tensor for name, tensor in q.target.state_dict().items()}
        tensors |= {f"data.{key}.{name}": tensor for name, tensor in q.replay.tensors().items()}
        tensors[f"counts.{key}"] = torch.tensor([q.steps, q.updates])
    return tensors


def _load_optimizer(optimizer: torch.optim.Optimizer, tensors: Tensors) -> None:
    """Moments are laid out as their parameters are: fused Adam goes through both in the order of memory."""
    parameters = [parameter for group in optimizer.param_groups for parameter in group["params"]]
    state: dict[int, Tensors] = {}
    for path, tensor in tensors.items():
        index, name = path.split(".")
        is_moment = tensor.shape == parameters[int(index)].shape
        state.setdefault(int(index), {})[name] = (
            torch.empty_like(parameters[int(index)]).copy_(tensor) if is_moment else tensor
        )
    optimizer.load_state_dict({**optimizer.state_dict(), "state": state})


def _below(tensors: Tensors, prefix: str) -> Tensors:
    return {name.removeprefix(prefix): tensor for name, tensor in tensors.items() if name.startswith(prefix)}
