"""One network for all imitation policies, which plans by spreading fields (`FieldNet`), and its Train."""

import hashlib
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn
from torch.nn import functional
from torch.optim.swa_utils import AveragedModel, get_ema_multi_avg_fn

from waypost.domains import Symmetry
from waypost.trajectory import Observation
from waypost_learner.policies.datasets import UNLABELED, Dataset, Row
from waypost_learner.policies.device import DEVICE, as_input, to_device
from waypost_learner.policies.fields.field_net import FieldNet, FieldSpec
from waypost_learner.policies.fields.symmetry_finder import find_symmetries, symmetries_in
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.labels import transformed_rows
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey
from waypost_learner.rollout.rollout import Outputs

_MOST_SEEN = 1_000  # transitions, or subgoals that ended; more are not kept, and the agent is no longer looked for
_CLIP = 1.0  # the largest norm of a gradient
_FLAT_WEIGHT = 0.3  # of the loss of flat actions beside a hierarchy, which gets no labels for them
# Where the likeliest pixel is an end of the subgoal with this probability, pi_g acts half for the subgoal and half for
# the task. Values from 0.001 to 0.05 did equally well.
_UNSEEN = 0.01
_HALF_RATE = 400  # updates after which the learning rate is half of the first one ...
_LEAST_RATE = 0.2  # ... of which this share remains

Data = Mapping[PolicyKey, Dataset]


@dataclass(frozen=True)
class _Batch:
    observations: torch.Tensor  # float32[B, C, rows, columns]
    hi: torch.Tensor  # int64[B], the right subgoal
    subgoal: torch.Tensor  # int64[B], whose pi_g has the labels of action and termination; 0 for other policies
    action: torch.Tensor  # int64[B], of pi_g
    termination: torch.Tensor  # int64[B]
    flat: torch.Tensor  # int64[B], the action of a flat policy


class SharedPolicy:
    """mu and every pi_g with beta_g, or a flat policy, as one network.

    Where the expert said how to act toward a right subgoal, that action was right for the task. So these labels also
    train mu, and the task's field by a flat policy's loss. No label is needed for that. Labels toward a subgoal that
    nobody found right train its pi_g and beta_g alone.

    Args:
        observation_shape: (channels, rows, columns) of the observations, which are pictures.
        n_subgoals: the number of subgoals.
        n_actions: the number of actions.
        network: the sizes of the network.
        train: the learning parameters of Train; `averaging` is needed.
        seed: fixes initial weights and the order of rows.
        symmetries: of the domain, as far as the learner is told; if None, they are looked for. Each row is learned in
            a random one at a time. What is chosen is the average over the transformed pictures, transformed back.

    Raises:
        ValueError: `train` has no averaging.
    """

    def __init__(
        self,
        observation_shape: tuple[int, ...],
        n_subgoals: int,
        n_actions: int,
        network: FieldSpec,
        train: TrainSpec,
        seed: int,
        symmetries: Sequence[Symmetry] | None = None,
    ) -> None:
        if train.averaging is None:
            raise ValueError("a network that spreads fields needs an averaging; write a number below 1")
        self.spec, self._told, self._n_subgoals = train, symmetries, n_subgoals
        self._shape, self._n_actions = observation_shape, n_actions
        self.rng = torch.Generator().manual_seed(seed)
        self.network = FieldNet(observation_shape, n_subgoals, n_actions, network, self.rng).to(DEVICE).eval()
        self._trained = [one for one in self.network.parameters() if one.requires_grad]  # not those that find the agent
        self.optimizer = torch.optim.AdamW(
            self._trained,
            lr=train.learning_rate,
            weight_decay=train.weight_decay,
            fused=True,
        )
        decaying = get_ema_multi_avg_fn(train.averaging)  # type: ignore[no-untyped-call]  # torch has no types here
        self.average = AveragedModel(self.network, multi_avg_fn=decaying)
        self.transitions = Dataset((2, *observation_shape))  # pictures before and after an action
        self.ends = Dataset((2, *observation_shape))  # pictures in which a subgoal was chosen, and in which it ended

    @property
    def acting(self) -> nn.Module:
        """The network that acts: the average of its weights over the updates."""
        return self.average.module

    @property
    def is_told(self) -> bool:
        """Whether no symmetries are looked for: the learner was told those that there are, or does without any."""
        return self._told is not None or not self.network.spec.symmetries

    @property
    def symmetries(self) -> Sequence[Symmetry]:
        """The domain's symmetries: those that the learner was told, or those that it found."""
        if self._told is not None:
            return self._told
        return symmetries_in(self._acting.symmetries, self._n_subgoals)

    @property
    def _acting(self) -> FieldNet:
        acting = self.acting
        assert isinstance(acting, FieldNet)
        return acting

    @torch.inference_mode()
    def outputs(self, observations: Observation) -> dict[str, torch.Tensor]:
        """Return what the policies do, as `FieldNet` does, for observations float32 or uint8[B, C, rows, columns].

        The less an end of a subgoal is seen, the more its pi_g acts as a flat policy does. With symmetries, logarithms
        of probabilities, and logits of terminations, are averages over them.
        """
        return {name: views.mean(0) for name, views in self._views(observations).items()}

    @torch.inference_mode()
    def disagreement(self, key: PolicyKey, observations: Observation) -> NDArray[np.float32]:
        """Return how much the symmetric views of each picture disagree about what mu or a pi_g chooses, float32[B].

        This is the sum of the variances of the choices' probabilities; 0 without symmetries.
        """
        views = self._views(observations)
        logs = views["hi"] if key.subgoal is None else views["lo"][:, :, key.subgoal]
        return logs.softmax(-1).var(0, correction=0).sum(-1).cpu().numpy()

    def _views(self, observations: Observation) -> dict[str, torch.Tensor]:
        """Return what each symmetric view of the pictures says, transformed back, [views, B, ...]."""
        n, symmetries = len(observations), self.symmetries
        seen = [observations, *(np.stack([each.observe(one) for one in observations]) for each in symmetries)]
        out = self.acting(to_device(as_input(np.concatenate(seen))))
        out["lo"] = _mixed(out["lo"], out["flat"].unsqueeze(1), _UNSEEN / (_UNSEEN + out["seen"].unsqueeze(2)))
        subgoals: list[slice | list[int]] = [slice(None), *(list(each.subgoals) for each in symmetries)]
        actions: list[slice | list[int]] = [slice(None), *(list(each.actions) for each in symmetries)]

        def stacked(name: str, choices: Sequence[slice | list[int]]) -> torch.Tensor:
            logs = out[name] if name == "termination" else torch.log_softmax(out[name], -1)
            parts = [one[..., chosen] for one, chosen in zip(logs.split(n), choices, strict=True)]
            if name == "lo":
                parts = [one[:, chosen] for one, chosen in zip(parts, subgoals, strict=True)]
            return torch.stack(parts)

        return {
            "hi": stacked("hi", subgoals),
            "lo": stacked("lo", actions),
            "termination": stacked("termination", subgoals),
            "flat": stacked("flat", actions),
        }

    def parts(self, keys: Sequence[PolicyKey]) -> "dict[PolicyKey, PartPolicy]":
        """Return policies as functions of observations. They remember outputs, so they must not outlive an update."""
        remembered = _Remembered(self.outputs)
        return {key: PartPolicy(remembered, key) for key in keys}

    def see(self, transitions: Sequence[Row], ends: Sequence[Row]) -> None:
        """Learn where the agent is in a picture, where each action moves it, and how far away subgoals end.

        Args:
            transitions: rows of [2, observation shape], the pictures before and after the choice.
            ends: rows of [2, observation shape], the pictures in which a subgoal was chosen, and in which it ended.
        """
        kept = len(self.ends)
        self.ends.append(ends[: _MOST_SEEN - kept])
        if transitions and len(self.transitions) < _MOST_SEEN:
            self.transitions.append(transitions)
            pictures, labels = (one.to(DEVICE) for one in self.transitions[range(len(self.transitions))])
            self.network.find_agent((pictures[:, 0], labels[:, 0], pictures[:, 1]), self.rng)
        elif kept == len(self.ends):
            return
        if len(self.ends):
            pictures = self.ends[range(len(self.ends))][0].to(DEVICE)
            self.network.look_as_far_as(pictures[:, 0], pictures[:, 1])
        for name in ("displacements", "reach"):
            setattr(self._acting, name, getattr(self.network, name).clone())
        self._acting.finder.load_state_dict(self.network.finder.state_dict())

    def train(self, data: Data) -> None:
        """Train(policy, D) for all policies together: passes over all rows, each in a new random order.

        Raises:
            ValueError: gradients are no numbers, so nothing more can be learned.
        """
        if not self.is_told:
            self._find_symmetries(data)
        n = sum(map(len, data.values()))
        for _ in self._updates(data, min(max(self.spec.passes * n, self.spec.least), self.spec.most)):
            pass

    def idle_updates(self, data: Data) -> Iterator[None]:
        """Train as `train` does, on as many more rows as `idle` says, and yield after each update."""
        return self._updates(data, self.spec.idle)

    def _find_symmetries(self, data: Data) -> None:
        every, last = torch.zeros(2, self._n_subgoals, self._n_actions, dtype=torch.int64)
        for key, one in data.items():
            if key.subgoal is not None:
                every[key.subgoal] = one.counts(self._n_actions)
                last[key.subgoal] = one.last_counts(self._n_actions)
        self.network.symmetries = find_symmetries(self._shape, self.network.displacements, (every, last))
        self._acting.symmetries = self.network.symmetries.clone()

    def _updates(self, data: Data, n_rows: int) -> Iterator[None]:
        rows = [(key, row) for key, one in data.items() for row in range(len(one))]
        if not rows or not n_rows:
            return
        passes = math.ceil(n_rows / len(rows))
        order = torch.cat([torch.randperm(len(rows), generator=self.rng) for _ in range(passes)])[:n_rows]
        changes = [None, *self.symmetries]
        self.network.train()
        for some in torch.split(order, self.spec.batch):
            drawn = torch.randint(len(changes), (len(some),), generator=self.rng)
            batch = _batch(data, [(*rows[i], changes[j]) for i, j in zip(some.tolist(), drawn.tolist(), strict=True)])
            for group in self.optimizer.param_groups:
                group["lr"] = self.spec.learning_rate * self._rate()
            loss = self._loss(self.network(to_device(batch.observations)), batch)
            self.optimizer.zero_grad()
            torch.autograd.backward(loss)
            if not torch.isfinite(nn.utils.clip_grad_norm_(self._trained, _CLIP)):
                raise ValueError(
                    "the shared network has gradients that are no numbers, so it cannot learn any more; start a new "
                    "run with a lower train_shared.learning_rate or fields.far"
                )
            self.optimizer.step()
            self.average.update_parameters(self.network)
            yield
        self.network.eval()

    def _rate(self) -> float:
        return max(_LEAST_RATE, 1 / (1 + int(self.average.n_averaged) / _HALF_RATE))

    def _loss(self, out: dict[str, torch.Tensor], batch: _Batch) -> torch.Tensor:
        """Return the sum of the mean cross-entropies over the rows that have a label of each kind."""
        every = torch.arange(len(batch.hi), device=batch.hi.device)
        ending = out["termination"][every, batch.subgoal]
        labeled = (batch.termination != UNLABELED).float()
        terminations = functional.binary_cross_entropy_with_logits(
            ending, batch.termination.clamp(min=0).float(), labeled, reduction="sum"
        ) / labeled.sum().clamp(min=1)
        hierarchy = bool((batch.hi != UNLABELED).any())
        return (
            _cross_entropy(out["hi"], batch.hi)
            + _cross_entropy(out["lo"][every, batch.subgoal], batch.action)
            + terminations
            + (_FLAT_WEIGHT if hierarchy else 1.0) * _cross_entropy(out["flat"], batch.flat)
        )


class _Remembered:
    """What the network says of pictures, computed once for each.

    Where a subgoal ends, three policies are asked about the same picture: its pi_g, mu, and the next pi_g. A policy
    that is lost sees the same pictures again and again.
    """

    def __init__(self, compute: Callable[[Observation], Mapping[str, torch.Tensor]]) -> None:
        self._compute = compute
        self._known: dict[bytes, Mapping[str, torch.Tensor]] = {}

    def __call__(self, observations: Observation) -> dict[str, torch.Tensor]:
        """Return the outputs for a batch of pictures."""
        pictures = [hashlib.blake2b(one.tobytes(), digest_size=16).digest() for one in observations]
        new = {picture: row for row, picture in enumerate(pictures) if picture not in self._known}
        if new:
            out = self._compute(observations[list(new.values())])
            for row, picture in enumerate(new):
                self._known[picture] = {name: one[row] for name, one in out.items()}
        rows = [self._known[picture] for picture in pictures]
        return {name: torch.stack([row[name] for row in rows]) for name in rows[0]}


class PartPolicy:
    """One of the policies that share a network."""

    def __init__(self, outputs: Callable[[Observation], Mapping[str, torch.Tensor]], key: PolicyKey) -> None:
        self._outputs, self._key = outputs, key

    @torch.inference_mode()
    def __call__(self, observations: Observation) -> Outputs:
        """Return the outputs for a batch float32 or uint8[B, C, rows, columns]."""
        out = self._outputs(observations)
        none = np.zeros(len(observations), np.float32)
        if self._key == META:
            return Outputs(out["hi"].cpu().numpy(), none)
        if self._key == FLAT:
            return Outputs(out["flat"].cpu().numpy(), none)
        ending = torch.sigmoid(out["termination"][:, self._key.subgoal])
        return Outputs(out["lo"][:, self._key.subgoal].cpu().numpy(), ending.cpu().numpy())


def _mixed(logits: torch.Tensor, others: torch.Tensor, share: torch.Tensor) -> torch.Tensor:
    """Return the logarithms of probabilities of which a share comes from other logits."""
    ours, theirs = torch.log_softmax(logits, -1), torch.log_softmax(others, -1)
    return torch.logaddexp(torch.log1p(-share) + ours, torch.log(share) + theirs)


def _cross_entropy(logits: torch.Tensor, labels: torch.Tensor) -> torch.Tensor:
    """Return the mean cross-entropy over labeled rows; 0 without any."""
    n = (labels != UNLABELED).sum().clamp(min=1)
    return functional.cross_entropy(logits, labels, ignore_index=UNLABELED, reduction="sum") / n


def _batch(data: Data, rows: Sequence[tuple[PolicyKey, int, Symmetry | None]]) -> _Batch:
    """Return rows of the buffers, each transformed by a symmetry, if there is one."""
    seen, labels, keys = [], [], []
    for key in data:
        chosen = [(row, symmetry) for one, row, symmetry in rows if one == key]
        if not chosen:
            continue
        observations, found = data[key][[row for row, _ in chosen]]
        for observation, (choice, ends, right), (_, symmetry) in zip(observations, found.tolist(), chosen, strict=True):
            changed = {key: [Row(observation.numpy(), choice, ends, bool(right))]}
            if symmetry is not None:
                changed = transformed_rows(changed, symmetry)
            for key_after, (row,) in changed.items():
                seen.append(torch.from_numpy(row.observation))
                labels.append((row.choice, row.termination, row.for_right_subgoal))
                keys.append(key_after)
    choices, terminations, right = torch.tensor(labels).to(DEVICE).unbind(1)
    subgoal = torch.tensor([UNLABELED if key.subgoal is None else key.subgoal for key in keys]).to(DEVICE)
    unlabeled = torch.full_like(choices, UNLABELED)
    of_pi, of_mu = subgoal != UNLABELED, torch.tensor([key == META for key in keys]).to(DEVICE)
    for_task = (choices != UNLABELED) & (right != 0)
    return _Batch(
        torch.stack(seen),
        hi=torch.where(of_mu, choices, torch.where(of_pi & for_task, subgoal, unlabeled)),
        subgoal=subgoal.clamp(min=0),
        action=torch.where(of_pi, choices, unlabeled),
        termination=terminations,
        flat=torch.where(of_mu | ~for_task, unlabeled, choices),
    )
