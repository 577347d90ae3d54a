"""Q-functions: double DQN (van Hasselt et al. 2016) with prioritized experience replay.

Q-functions of subgoals can have the paper's two additions for Montezuma's Revenge (section 6.2): they learn only from
the first success on, and no longer when they succeed often. They can learn from demonstrations too (Hester et al.
2018).
"""

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
import torch
from torch import nn
from torch.nn import functional

from waypost.trajectory import Observation
from waypost_learner.policies.device import DEVICE, as_input, has_bf16, mixed_precision
from waypost_learner.policies.exploration import ExplorationSpec
from waypost_learner.policies.networks import NetworkSpec, build_network
from waypost_learner.policies.planning import PlanningSpec
from waypost_learner.policies.replay import Replay
from waypost_learner.rollout.experience import Experience, PseudoReward, Returns
from waypost_learner.rollout.rollout import Outputs

ATTEMPTS = 100  # at a subgoal, over which a success rate is taken


@dataclass(frozen=True)
class DqnSpec:
    """The learning parameters of a Q-function."""

    learning_rate: float = 5e-4
    optimizer: Literal["adam", "rmsprop"] = "adam"
    batch: int = 64  # transitions
    update_every: int = 4  # steps under this Q-function
    discount: float = 0.9  # gamma
    discount_per: Literal["step", "choice"] = "step"  # what a meta-controller discounts (`Returns`)
    ahead: int = 1  # steps whose rewards are summed up before the value of the state after them (n-step returns)
    terminal: Literal["subgoal", "episode"] = "subgoal"  # whose end is terminal in a subgoal's experience (`Returns`)
    target_every: int = 100  # updates
    capacity: int = 100_000  # transitions
    least: int = 200  # transitions in the buffer before the first update
    alpha: float = 0.6  # exponent of priorities
    beta: float = 0.4  # initial exponent of the importance weights; it grows to 1 in `beta_updates`
    beta_updates: int = 20_000
    # epsilon in training, by the number of steps under this Q-function; linear in between
    epsilon: tuple[tuple[int, float], ...] = ((0, 1.0), (2_000, 0.1), (12_000, 0.01))
    pseudo: PseudoReward = field(default_factory=PseudoReward)
    from_success: bool = False  # whether experience is kept only from a subgoal's first success on
    stop_above: float | None = None  # no updates above this success rate of the last 100 attempts; always if None
    relearn: bool = True  # whether updates go on when the rate has fallen again
    margin: float = 0.0  # by which a demonstrated choice should exceed the others; 0 ignores who chose
    exploration: ExplorationSpec = field(default_factory=ExplorationSpec)  # of subgoals
    symmetries: bool = True  # whether each transition is also learned in every symmetry of the domain
    bf16: bool = True  # mixed precision where bf16 is faster on the device

    @property
    def returns(self) -> Returns:
        """How rewards are summed up."""
        return Returns(self.discount, self.ahead, self.terminal, self.discount_per)


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
        self.optimizer = _optimizer(self.network.parameters(), spec)
        self.replay = Replay(observation_shape, spec)
        self.steps = self.updates = 0
        self.attempts: deque[bool] = deque(maxlen=ATTEMPTS)  # whether the last attempts reached the subgoal
        self.succeeded = False  # whether any attempt did
        self.mastered = False  # whether the last attempts succeeded so often that there are no more updates
        self.uses_bf16 = spec.bf16 and has_bf16()

    @torch.inference_mode()
    def __call__(self, observations: Observation) -> Outputs:
        """Return the Q-values of a batch float32 or uint8[B, observation shape], as logits."""
        values = self.network(as_input(observations))
        return Outputs(values.cpu().numpy(), np.zeros(len(values), np.float32))

    @property
    def acting(self) -> nn.Module:
        """The network that chooses in rollouts."""
        return self.network

    @property
    def epsilon(self) -> float:
        """The current probability of a random choice in training.

        It is 0 while there are no updates, unless they have ended for good: then it stays as it was when the attempts
        succeeded, because some states are left only by a random action.
        """
        if self.mastered and self.spec.relearn:
            return 0.0
        steps, values = zip(*self.spec.epsilon, strict=True)
        return float(np.interp(float(self.steps), steps, values))

    @property
    def success(self) -> float:
        """The share of its last attempts, at most 100, that succeeded; 0 without attempts."""
        return sum(self.attempts) / max(1, len(self.attempts))

    def attempt(self, experience: Experience) -> None:
        """Count an attempt at the subgoal. What others chose too is no attempt, but it can be a success."""
        if experience.outcome is not None:
            self.succeeded = self.succeeded or experience.outcome == "reached"
            if experience.alone:
                self.attempts.append(experience.outcome == "reached")
                if self.spec.stop_above is not None and len(self.attempts) == ATTEMPTS:
                    kept = self.mastered and not self.spec.relearn
                    self.mastered = kept or self.success > self.spec.stop_above

    def remember(self, experience: Experience) -> None:
        """Append experience to the replay buffer."""
        if self.succeeded or not self.spec.from_success:
            self.replay.add(experience)

    def step(self) -> None:
        """Count one step under this Q-function, and update it every `update_every` steps (Algorithm 3, line 11)."""
        if self.mastered and not self.spec.relearn:
            return
        self.steps += 1
        due = self.steps % self.spec.update_every == 0 and len(self.replay) >= self.spec.least
        if due and not self.mastered:
            self._update()

    def _update(self) -> None:
        rows, batch = self.replay.sample(self.spec.batch, self.rng)
        choice, reward, discount, weight = (
            batch[name].to(DEVICE) for name in ("choice", "reward", "discount", "weight")
        )
        before, after = batch["before"], batch["after"]
        with torch.inference_mode(), mixed_precision(self.uses_bf16):
            best = self.network(after).argmax(1, keepdim=True)  # double Q-learning
            next_value = self.target(after).float().gather(1, best).squeeze(1)
        with mixed_precision(self.uses_bf16):
            all_values = self.network(before).float()
            values = all_values.gather(1, choice.unsqueeze(1)).squeeze(1)
        target = reward + discount * next_value
        beta = self.spec.beta + (1 - self.spec.beta) * min(1.0, self.updates / self.spec.beta_updates)
        losses = functional.huber_loss(values, target, reduction="none")
        if self.spec.margin:
            others = torch.full_like(all_values, self.spec.margin).scatter_(1, choice.unsqueeze(1), 0.0)
            demonstrated = batch["demonstrated"].to(DEVICE)
            losses = losses + demonstrated * ((all_values + others).max(1).values - values)
        loss = (weight**beta * losses).mean()
        self.optimizer.zero_grad()
        torch.autograd.backward(loss)
        self.optimizer.step()
        self.replay.prioritize(rows, (target - values.detach()).cpu())
        self.updates += 1
        if self.updates % self.spec.target_every == 0:
            self.target.load_state_dict(self.network.state_dict())


def _optimizer(parameters: Iterable[nn.Parameter], spec: DqnSpec) -> torch.optim.Optimizer:
    """Return the optimizer of a specification. RMSprop has the values of the authors' code."""
    if spec.optimizer == "adam":
        return torch.optim.Adam(parameters, lr=spec.learning_rate, fused=True)
    return torch.optim.RMSprop(parameters, lr=spec.learning_rate, alpha=0.95, eps=1e-8)
