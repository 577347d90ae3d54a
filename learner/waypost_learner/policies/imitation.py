"""Imitation policies (mu, pi_g with beta_g, flat policies) as networks, and the paper's Train(policy, D).

mu chooses among subgoals; pi_g and flat policies choose among actions. beta_g is one more output of pi_g ("one can also
view the subgoal termination classifier as an extra head of the subgoal policy network", appendix).
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import torch
from torch import nn
from torch.nn import functional
from torch.optim.swa_utils import AveragedModel, get_ema_multi_avg_fn

from waypost.trajectory import Observation
from waypost_learner.policies.datasets import UNLABELED, Dataset
from waypost_learner.policies.device import DEVICE, as_input, has_bf16, mixed_precision, to_device
from waypost_learner.policies.networks import NetworkSpec, build_network
from waypost_learner.policies.planning import PlanningSpec
from waypost_learner.rollout.rollout import Outputs


@dataclass(frozen=True)
class TrainSpec:
    """The learning parameters of Train."""

    learning_rate: float = 5e-4
    batch: int = 32  # rows
    passes: int = 1  # over the buffer in each call of Train
    least: int = 1024  # fewest rows in each call: a small buffer is used for more passes
    most: int = 6144  # most rows in each call
    idle: int = 0  # rows more, which are trained on while the expert answers the next query
    dropout: float = 0.5
    weight_decay: float = 0.0
    averaging: float | None = None  # decay of the moving average of the weights, which then acts; no average if None
    every_episode: bool = False  # whether to train after each episode, even if it added no rows
    bf16: bool = True  # mixed precision where bf16 is faster on the device

    def __post_init__(self) -> None:
        """Refuse numbers out of their range.

        Raises:
            ValueError: a number is out of its range; the message gives the ranges.
        """
        if min(self.batch, self.most) < 1 or min(self.passes, self.least, self.idle) < 0:
            raise ValueError("training needs batch and most of at least 1, and passes, least and idle of at least 0")
        if self.averaging is not None and not 0 <= self.averaging < 1:
            raise ValueError("training needs an averaging of at least 0 and less than 1, or null")


class Policy:
    """A policy network with its optimizer and its random generator.

    Args:
        observation_shape: the shape of its observations.
        n_choices: the number of subgoals or actions.
        terminates: whether it has one more output, the logit of beta_g.
        network: the kind and the sizes of the network.
        train: the learning parameters of Train.
        seed: fixes initial weights, dropout and the order of rows.
    """

    def __init__(
        self,
        observation_shape: tuple[int, ...],
        n_choices: int,
        terminates: bool,
        network: NetworkSpec | PlanningSpec,
        train: TrainSpec,
        seed: int,
    ) -> None:
        self.n_choices, self.terminates, self.spec = n_choices, terminates, train
        self.rng = torch.Generator().manual_seed(seed)
        outputs = n_choices + int(terminates)
        self.network = build_network(observation_shape, outputs, network, train.dropout, self.rng).to(DEVICE)
        self.optimizer = torch.optim.AdamW(
            self.network.parameters(), lr=train.learning_rate, weight_decay=train.weight_decay, fused=True
        )
        self.bf16 = train.bf16 and has_bf16()
        self.network.eval()
        self.average: AveragedModel | None = None
        if train.averaging is not None:
            decaying = get_ema_multi_avg_fn(train.averaging)  # type: ignore[no-untyped-call]  # torch has no types here
            self.average = AveragedModel(self.network, multi_avg_fn=decaying)

    @property
    def acting(self) -> nn.Module:
        """The network that acts: the trained one, or the average of its weights over the updates."""
        return self.network if self.average is None else self.average.module

    @torch.inference_mode()
    def __call__(self, observations: Observation) -> Outputs:
        """Return the outputs for a batch float32 or uint8[B, observation shape]."""
        out = self.acting(as_input(observations)).cpu()
        termination = torch.sigmoid(out[:, -1]) if self.terminates else torch.zeros(len(out))
        return Outputs(out[:, : self.n_choices].numpy(), termination.numpy())

    def train(self, data: Dataset) -> None:
        """Train(policy, D): make a few passes over the data, each in a new random order."""
        for _ in self._updates(data, min(max(self.spec.passes * len(data), self.spec.least), self.spec.most)):
            pass

    def idle_updates(self, data: Dataset) -> Iterator[None]:
        """Train as `train` does, on as many more rows as `idle` says, and yield after each update.

        The caller goes on with the next update whenever the expert lets it wait.
        """
        return self._updates(data, self.spec.idle)

    def _updates(self, data: Dataset, n_rows: int) -> Iterator[None]:
        if not len(data) or not n_rows:
            return
        spec = self.spec
        passes = math.ceil(n_rows / len(data))
        order = torch.cat([torch.randperm(len(data), generator=self.rng) for _ in range(passes)])[:n_rows]
        self.network.train()
        for rows in torch.split(order, spec.batch):
            observations, labels = data[rows.tolist()]
            with mixed_precision(self.bf16):
                out = self.network(to_device(observations))
            loss = self._loss(out.float(), labels.to(DEVICE))
            self.optimizer.zero_grad()
            torch.autograd.backward(loss)
            self.optimizer.step()
            if self.average is not None:
                self.average.update_parameters(self.network)
            yield
        self.network.eval()

    def _loss(self, out: torch.Tensor, labels: torch.Tensor) -> torch.Tensor:
        """Return the cross-entropies of choices and of terminations over labeled rows, divided by the batch size."""
        choices, terminations = labels[:, 0], labels[:, 1]
        loss = functional.cross_entropy(
            out[:, : self.n_choices], choices, ignore_index=UNLABELED, reduction="sum"
        ) / len(labels)
        if self.terminates:
            labeled = terminations != UNLABELED
            loss = loss + functional.binary_cross_entropy_with_logits(
                out[:, self.n_choices], terminations.clamp(min=0).float(), labeled.float(), reduction="sum"
            ) / len(labels)
        return loss
