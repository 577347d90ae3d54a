"""Write and read checkpoints: the state of a learner in one safetensors file, which is replaced atomically.

Tensors, where KEY is a policy's number (`PolicyKey.number`):

- `policy.KEY.NAME`: the weights that act. A finished run's checkpoint has only these.
- `optimizer.KEY.INDEX.NAME`, `rng.KEY`, `data.KEY.*`: the optimizer, the random generator, the buffer.
- `due`: the policies that train while the expert answers the next query.
- `transitions.*`: what the policies that share a network learned from where the agent is.
- `trained.KEY.NAME`, `averaged.KEY`: if an average of the weights acts, the trained weights and the number of updates.
- `target.KEY.NAME`, `counts.KEY`, `attempts.KEY`: a Q-function's target network; its steps, its updates, whether
  any attempt succeeded and whether it is mastered; its last attempts.
- `gate.LEVEL.*`: what a gate remembers of each level.
- `exploration.KEY`: what the exploration of a subgoal knows, as JSON.

The file's metadata holds the `Header` as JSON. No code is stored, so loading a file runs none.
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
from waypost_learner.rollout.policy_keys import PolicyKey
from waypost_learner.runs.config import Progress, TrainConfig

Tensors = dict[str, torch.Tensor]


@dataclass(frozen=True)
class Header:
    """The run that a checkpoint belongs to, and the run's progress."""

    run: str
    config: TrainConfig
    progress: Progress


def write(path: Path, learner: Learner, header: Header, weights_only: bool) -> None:
    """Write a checkpoint to a temporary file, sync it, and rename it over the previous one.

    Args:
        path: the path of the file; its folder is created if it does not exist.
        learner: the learner; its state is written.
        header: the run and its progress.
        weights_only: whether to omit everything that only further training needs.
    """
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
    """Return the header of a checkpoint.

    Raises:
        ValueError: the file does not exist, or it is not a checkpoint.
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
    """Load the weights of a checkpoint, and its training state if it has one, into a learner.

    Raises:
        ValueError: the learner's networks differ from the checkpoint's, or another version of Waypost wrote it.
    """
    with safe_open(path, "pt") as file:
        tensors = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118 - it is no mapping
    try:
        _restore(tensors, learner)
    except (LookupError, RuntimeError, ValueError) as error:
        raise ValueError(
            f"{path} does not fit this version of Waypost; continue with the version that wrote it, or start a new run"
        ) from error


def _restore(tensors: Tensors, learner: Learner) -> None:
    for key, policy in learner.learned.items():
        n = key.number
        policy.acting.load_state_dict(_below(tensors, f"policy.{n}."))
        if f"rng.{n}" in tensors:
            policy.rng.set_state(tensors[f"rng.{n}"])
            _load_optimizer(policy.optimizer, _below(tensors, f"optimizer.{n}."))
    learner.due = [PolicyKey.of_number(n) for n in tensors["due"].tolist()] if "due" in tensors else []
    for key, policy in learner.imitators.items():
        n = key.number
        if f"rng.{n}" in tensors and policy.average is not None:
            policy.network.load_state_dict(_below(tensors, f"trained.{n}."))
            policy.average.n_averaged.copy_(tensors[f"averaged.{n}"])
    for key, data in learner.data.items():
        if f"data.{key.number}.labels" in tensors:
            data.load(_below(tensors, f"data.{key.number}."))
    if learner.shared is not None and "transitions.labels" in tensors:
        learner.shared.transitions.load(_below(tensors, "transitions."))
        learner.shared.ends.load(_below(tensors, "ends."))
    for level, memory in learner.gate.memory.items():
        if f"gate.{level}.labels" in tensors:
            memory.load(_below(tensors, f"gate.{level}."))
    for key, q in learner.q.items():
        n = key.number
        if f"rng.{n}" in tensors:
            q.target.load_state_dict(_below(tensors, f"target.{n}."))
            q.replay.load(_below(tensors, f"data.{n}."))
            q.steps, q.updates, succeeded, mastered = tensors[f"counts.{n}"].tolist()
            q.succeeded, q.mastered = bool(succeeded), bool(mastered)
            q.attempts.extend(tensors[f"attempts.{n}"].tolist())
    for key, exploration in learner.explorations.items():
        if f"exploration.{key.number}" in tensors:
            exploration.load(tensors[f"exploration.{key.number}"].numpy().tobytes().decode())


def weights_hash(learner: Learner) -> str:
    """Return the SHA-256 of all weights that act. Two hashes are equal if and only if all weights are identical."""
    digest = hashlib.sha256()
    for name, tensor in sorted(_weights(learner)):
        digest.update(name.encode())
        digest.update(tensor.cpu().contiguous().numpy().tobytes())
    return digest.hexdigest()


def _weights(learner: Learner) -> Iterator[tuple[str, torch.Tensor]]:
    for key, policy in learner.learned.items():
        for name, tensor in policy.acting.state_dict().items():
            yield f"policy.{key.number}.{name}", tensor


def _training_state(learner: Learner) -> Tensors:
    tensors: Tensors = {"due": torch.tensor([key.number for key in learner.due], dtype=torch.int64)}
    for key, policy in learner.learned.items():
        for index, state in policy.optimizer.state_dict()["state"].items():
            tensors |= {f"optimizer.{key.number}.{index}.{name}": tensor for name, tensor in state.items()}
        tensors[f"rng.{key.number}"] = policy.rng.get_state()
    for key, data in learner.data.items():
        tensors |= {f"data.{key.number}.{name}": tensor for name, tensor in data.tensors().items()}
    if learner.shared is not None:
        for kept, data in (("transitions", learner.shared.transitions), ("ends", learner.shared.ends)):
            tensors |= {f"{kept}.{name}": tensor for name, tensor in data.tensors().items()}
    for level, memory in learner.gate.memory.items():
        if len(memory):
            tensors |= {f"gate.{level}.{name}": tensor for name, tensor in memory.tensors().items()}
    for key, policy in learner.imitators.items():
        if policy.average is not None:
            tensors |= {f"trained.{key.number}.{name}": tensor for name, tensor in policy.network.state_dict().items()}
            tensors[f"averaged.{key.number}"] = policy.average.n_averaged
    for key, q in learner.q.items():
        tensors |= {f"target.{key.number}.{name}": tensor for name, tensor in q.target.state_dict().items()}
        tensors |= {f"data.{key.number}.{name}": tensor for name, tensor in q.replay.tensors().items()}
        tensors[f"counts.{key.number}"] = torch.tensor([q.steps, q.updates, q.succeeded, q.mastered])
        tensors[f"attempts.{key.number}"] = torch.tensor(list(q.attempts), dtype=torch.bool)
    for key, exploration in learner.explorations.items():
        known = bytearray(exploration.to_json().encode())
        tensors[f"exploration.{key.number}"] = torch.frombuffer(known, dtype=torch.uint8)
    return tensors


def _load_optimizer(optimizer: torch.optim.Optimizer, tensors: Tensors) -> None:
    """Load an optimizer's state. Moments get the memory layout of their parameters, as fused Adam requires."""
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
