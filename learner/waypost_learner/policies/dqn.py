"""Q-functions: double DQN (van Hasselt et al. 2016) with prioritized experience replay."""

from dataclasses import dataclass, field

import numpy as np
import torch
from torch import nn
from torch.nn import functional

from waypost.trajectory import Observation
from waypost_learner.policies.device import DEVICE, as_input, has_bf16, mixed_precision, to_device
from waypost_learner.policies.networks import NetworkSpec, PlanningSpec, build_network
from waypost_learner.policies.replay import Replay
from waypost_learner.rollout.experience import PseudoReward, Returns
from waypost_learner.rollout.rollout import Outputs


@dataclass(frozen=True)
class DqnSpec:
    """The learning parameters of a Q-function."""

    learning_rate: float = 5e-4
    batch: int = 64  # transitions
    update_every: int = 4  # steps under this Q-function
    discount: float = 0.9  # gamma
    ahead: int = 1  # steps whose rewards are summed up before the value of the state after them (n-step returns)
    target_every: int = 100  # updates
    capacity: int = 100_000  # transitions
    least: int = 200  # transitions in the buffer before the first update
    alpha: float = 0.6  # exponent of priorities
    beta: float = 0.4  # initial exponent of the importance weights; it grows to 1 in `beta_updates`
    beta_updates: int = 20_000
    # epsilon in training, by the number of steps under this Q-function; linear in between
    epsilon: tuple[tuple[int, float], ...] = ((0, 1.0), (2_000, 0.1), (12_000, 0.01))
    pseudo: PseudoReward = field(default_factory=PseudoReward)
    symmetries: bool = True  # whether each transition is also learned in every symmetry of the domain
    bf16: bool = True  # mixed precision where the device supports bf16

    @property
    def returns(self) -> Returns:
        """How rewards are summed up."""
        return Returns(self.discount, self.ahead)


class QFunction:
    """A Q-function with its target network, optimizer, replay buffer and exploration rate.

    Args:
        observation_shape: the shape of its observations.
        n_choices: the number of subgoals or actions.
        network: the kind and the sizes of the network.
        spec: the learning parameters.
        seed: fixes initial weights and sampling.
    """

    def __init__(
        self,
        observation_shape: tuple[int, ...],
        n_choices: int,
        network: NetworkSpec | PlanningSpec,
        spec: DqnSpec,
        seed: int,
    ) -> None:
        self.spec, self.n_choices = spec, n_choices
        self.rng = torch.Generator().manual_seed(seed)
        self.network, self.target = (
            build_network(observation_shape, n_choices, network, 0, self.rng).to(DEVICE) for _ in range(2)
        )
        self.target.load_state_dict(self.network.state_dict())
        self.optimizer = torch.optim.Adam(self.network.parameters(), lr=spec.learning_rate, fused=True)
        self.replay = Replay(observation_shape, spec)
        self.steps = self.updates = 0
        self._bf16 = spec.bf16 and has_bf16()

    @torch.inference_mode()
    def __call__(self, observations: Observation) -> Outputs:
        """Return the Q-values of a batch float32 or uint8[B, observation shape], as logits."""
        values = self.network(as_input(observations).to(DEVICE))
        return Outputs(values.cpu().numpy(), np.zeros(len(values), np.float32))

    @property
    def acting(self) -> nn.Module:
        """The network that chooses in rollouts."""
        return self.network

    @property
    def epsilon(self) -> float:
        """The current probability of a random choice in training."""
        steps, values = zip(*self.spec.epsilon, strict=True)
        return float(np.interp(float(self.steps), steps, values))

    def step(self) -> None:
        """Count one step under this Q-function, and update it every `update_every` steps (Algorithm 3, line 11)."""
        self.steps += 1
        if self.steps % self.spec.update_every == 0 and len(self.replay) >= self.spec.least:
            self._update()

    def _update(self) -> None:
        rows, batch = self.replay.sample(self.spec.batch, self.rng)
        choice, reward, discount, weight = (
            batch[name].to(DEVICE) for name in ("choice", "reward", "discount", "weight")
        )
        before, after = to_device(batch["before"]), to_device(batch["after"])
        with mixed_precision(self._bf16):
            with torch.no_grad():
                best = self.network(after).argmax(1, keepdim=True)  # double Q-learning
                next_value = self.target(after).float().gather(1, best).squeeze(1)
            values = self.network(before).float().gather(1, choice.unsqueeze(1)).squeeze(1)
        target = reward + discount * next_value
        beta = self.spec.beta + (1 - self.spec.beta) * min(1.0, self.updates / self.spec.beta_updates)
        loss = (weight**beta * functional.huber_loss(values, target, reduction="none")).mean()
        self.optimizer.zero_grad()
        torch.autograd.backward(loss)
        self.optimizer.step()
        self.replay.prioritize(rows, (target - values).detach().cpu())
        self.updates += 1
        if self.updates % self.spec.target_every == 0:
            self.target.load_state_dict(self.network.state_dict())
