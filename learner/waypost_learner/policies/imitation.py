"""mu, pi_g and beta_g as networks, and the paper's Train(policy, D).

A `Policy` chooses among n alternatives: subgoals for mu, actions for pi_g and for a flat policy. With `terminates` it
has one more output, the logit of beta_g ("one can also view the subgoal termination classifier as an extra head of the
subgoal policy network", appendix).
"""

import math
from dataclasses import dataclass

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn
from torch.nn import functional
from torch.optim.swa_utils import AveragedModel, get_ema_multi_avg_fn

from waypost_learner.policies.datasets import UNLABELED, Dataset
from waypost_learner.policies.device import DEVICE, has_bf16, laid_out, mixed_precision
from waypost_learner.policies.networks import NetworkSpec, PlanningSpec, build_network
from waypost_learner.rollout.rollout import Outputs


@dataclass(frozen=True)
class TrainSpec:
    """How Train works."""

    learning_rate: float = 5e-4
    batch: int = 32
    passes: int = 1  # over the buffer in a round,
    least: int = 1024  # but so many rows at least: a small buffer is passed over more often,
    most: int = 6144  # and so many at most
    idle: int = 0  # rows more (`train_on`), after the expert has been put the next question
    dropout: float = 0.5
    weight_decay: float = 0.0
    averaging: float | None = None  # what acts is the average of the weights after each update, decaying at this rate
    every_episode: bool = False  # rather than only after episodes that added to the buffer
    bf16: bool = True  # mixed precision where the processor has bf16 arithmetic

    def __post_init__(self) -> None:
        """Refuse numbers with which nothing could be trained.

        Raises:
            ValueError: with what to write instead.
        """
        if min(self.batch, self.most) < 1 or min(self.passes, self.least, self.idle) < 0:
            raise ValueError("training takes batch and most from 1 on, and passes, least and idle from 0 on")
        if self.averaging is not None and not 0 <= self.averaging < 1:
            raise ValueError("training takes an averaging from 0 to below 1, or null")


class Policy:
    """A network that chooses among `choices` alternatives, with its optimizer and its place in the data."""

    def __init__(
        self,
        observation_shape: tuple[int, ...],
        choices: int,
        terminates: bool,
        network: NetworkSpec | PlanningSpec,
        train: TrainSpec,
        seed: int,
    ) -> None:
        self.choices, self.terminates, self.spec = choices, terminates, train
        self.rng = torch.Generator().manual_seed(seed)
        outputs = choices + int(terminates)
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
        """The network that acts: the one that is trained, or the average of what it was."""
        return self.network if self.average is None else self.average.module

    @torch.inference_mode()
    def __call__(self, observations: NDArray[np.float32]) -> Outputs:
        """Evaluate float32[B, observation shape]."""
        out = self.acting(torch.from_numpy(observations).to(DEVICE)).cpu()
        fires = torch.sigmoid(out[:, -1]) if self.terminates else torch.zeros(len(out))
        return Outputs(out[:, : self.choices].numpy(), fires.numpy())

    def train(self, data: Dataset) -> None:
        """Train(policy, D): a few passes over the data, each in a random order of its own."""
        self._go_through(data, min(max(self.spec.passes * len(data), self.spec.least), self.spec.most))

    def train_on(self, data: Dataset) -> None:
        """Train on in the same way, while the expert is at the next question."""
        self._go_through(data, self.spec.idle)

    def _go_through(self, data: Dataset, n_rows: int) -> None:
        if not len(data) or not n_rows:
            return
        spec = self.spec
        passes = math.ceil(n_rows / len(data))
        order = torch.cat([torch.randperm(len(data), generator=self.rng) for _ in range(passes)])[:n_rows]
        self.network.train()
        for rows in torch.split(order, spec.batch):
            observations, labels = data[rows.tolist()]
            with mixed_precision(self.bf16):
                out = self.network(laid_out(observations))
            loss = self._loss(out.float(), labels.to(DEVICE))
            self.optimizer.zero_grad()
            torch.autograd.backward(loss)
            self.optimizer.step()
            if self.average is not None:
                self.average.update_parameters(self.network)
        self.network.eval()

    def _loss(self, out: torch.Tensor, labels: torch.Tensor) -> torch.Tensor:
        """Cross-entropy of the choices plus that of the terminations, over the rows where each is labeled."""
        choices, terminations = labels[:, 0], labels[:, 1]
        loss = functional.cross_entropy(out[:, : self.choices], choices, ignore_index=UNLABELED, reduction="sum") / len(
            labels
        )
        if self.terminates:
            labeled = terminations != UNLABELED
            loss = loss + functional.binary_cross_entropy_with_logits(
                out[:, self.choices], terminations.clamp(min=0).float(), labeled.float(), reduction="sum"
            ) / len(labels)
        return loss
