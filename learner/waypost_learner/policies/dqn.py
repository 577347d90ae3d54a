"""Q-functions: double DQN (van Hasselt et al. 2016) with prioritized experience replay (Schaul et al. 2016)."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn
from torch.nn import functional

from waypost_learner.policies.device import DEVICE, has_bf16, laid_out, mixed_precision
from waypost_learner.policies.networks import NetworkSpec, PlanningSpec, build_network
from waypost_learner.rollout.experience import PseudoReward, Transition
from waypost_learner.rollout.rollout import Outputs

Tensors = dict[str, torch.Tensor]


@dataclass(frozen=True)
class DqnSpec:
    """How Q-functions learn."""

    learning_rate: float = 5e-4
    batch: int = 64
    update_every: int = 4  # steps of the learner
    discount: float = 0.9  # gamma
    target_every: int = 100  # updates
    capacity: int = 100_000  # transitions
    least: int = 200  # transitions before the first update
    alpha: float = 0.6  # exponent of priorities
    beta: float = 0.4  # exponent of the weights that make up for them, at first; 1 after `beta_updates`
    beta_updates: int = 20_000
    # epsilon of epsilon-greedy in training, by the steps of the same Q-function; in between it goes in straight lines
    epsilon: tuple[tuple[int, float], ...] = ((0, 1.0), (2_000, 0.1), (12_000, 0.01))
    pseudo: PseudoReward = field(default_factory=PseudoReward)
    symmetries: bool = True  # whether each transition is also learned from in the domain's other symmetries
    bf16: bool = True


class Replay:
    """Prioritized replay, proportional variant; the oldest transitions make room for new ones.

    Sampling sums all priorities up. A tree of sums would be quicker, but over 100,000 rows it is 0.4 of the 10 ms that
    the update takes.
    """

    def __init__(self, observation_shape: tuple[int, ...], spec: DqnSpec) -> None:
        self._spec = spec
        self._columns = {
            "before": torch.empty((0, *observation_shape), dtype=torch.float16),  # half the memory
            "after": torch.empty((0, *observation_shape), dtype=torch.float16),
            "choice": torch.empty(0, dtype=torch.int64),
            "reward": torch.empty(0),
            "discount": torch.empty(0),
            "priority": torch.empty(0, dtype=torch.float64),
        }
        self._size = self._next = 0

    def __len__(self) -> int:
        return self._size

    def add(self, transitions: Iterable[Transition]) -> None:
        """Append transitions; each is as important as the most important one so far, so that it is seen soon."""
        highest = float(self._columns["priority"][: self._size].max()) if self._size else 1.0
        for transition in transitions:
            self._make_room()
            values = {
                "before": torch.from_numpy(transition.observation),
                "after": torch.from_numpy(transition.next_observation),
                "choice": torch.tensor(transition.choice),
                "reward": torch.tensor(transition.reward),
                "discount": torch.tensor(self._spec.discount**transition.steps if transition.steps else 0.0),
                "priority": torch.tensor(highest),
            }
            for name, value in values.items():
                self._columns[name][self._next] = value
            self._size = max(self._size, self._next + 1)
            self._next = (self._next + 1) % self._spec.capacity

    def _make_room(self) -> None:
        room = len(self._columns["choice"])
        if self._next == room:  # never beyond the capacity, where `_next` begins again
            more = min(max(room, 256), self._spec.capacity - room)
            for name, column in self._columns.items():
                self._columns[name] = torch.cat([column, column.new_zeros((more, *column.shape[1:]))])

    def sample(self, size: int, rng: torch.Generator) -> tuple[torch.Tensor, Tensors]:
        """Draw rows in proportion to their priority: their indices int64[size], and their columns.

        The column `weight` [size] makes up for the priorities (importance sampling at beta = 1, the highest at 1).
        """
        priorities = self._columns["priority"][: self._size]
        sums = priorities.cumsum(0)
        drawn = torch.rand(size, dtype=torch.float64, generator=rng) * sums[-1]
        rows = torch.searchsorted(sums, drawn, right=True).clamp(max=self._size - 1)
        found = {name: column[rows] for name, column in self._columns.items()}
        found["weight"] = (priorities.min() / found["priority"]).float()
        return rows, found

    def prioritize(self, rows: torch.Tensor, errors: torch.Tensor) -> None:
        """Set priorities from temporal-difference errors float32[n]."""
        self._columns["priority"][rows] = (errors.double().abs() + 1e-4) ** self._spec.alpha

    def tensors(self) -> Tensors:
        """Return everything there is to save."""
        columns = {name: column[: self._size] for name, column in self._columns.items()}
        return {**columns, "next": torch.tensor(self._next)}

    def load(self, tensors: Tensors) -> None:
        """Put back what `tensors` returned."""
        self._columns = {name: tensors[name] for name in self._columns}
        self._size, self._next = len(tensors["choice"]), int(tensors["next"])


class QFunction:
    """Q over `choices` alternatives, with its target network, its optimizer, its experience and its exploration."""

    def __init__(
        self,
        observation_shape: tuple[int, ...],
        choices: int,
        network: NetworkSpec | PlanningSpec,
        spec: DqnSpec,
        seed: int,
    ) -> None:
        self.spec, self.choices = spec, choices
        self.rng = torch.Generator().manual_seed(seed)
        self.network, self.target = (
            build_network(observation_shape, choices, network, 0, self.rng).to(DEVICE) for _ in range(2)
        )
        self.target.load_state_dict(self.network.state_dict())
        self.optimizer = torch.optim.Adam(self.network.parameters(), lr=spec.learning_rate, fused=True)
        self.replay = Replay(observation_shape, spec)
        self.steps = self.updates = 0
        self._bf16 = spec.bf16 and has_bf16()

    @torch.inference_mode()
    def __call__(self, observations: NDArray[np.float32]) -> Outputs:
        """Evaluate float32[B, observation shape]; the logits of the outputs are Q-values."""
        values = self.network(torch.from_numpy(observations).to(DEVICE))
        return Outputs(values.cpu().numpy(), np.zeros(len(values), np.float32))

    @property
    def acting(self) -> nn.Module:
        """The network that acts."""
        return self.network

    @property
    def epsilon(self) -> float:
        """The probability of a random choice, in training."""
        steps, values = zip(*self.spec.epsilon, strict=True)
        return float(np.interp(float(self.steps), steps, values))

    def step(self) -> None:
        """Count one step under this Q-function; update it when it is time (line 11 of Algorithm 3)."""
        self.steps += 1
        if self.steps % self.spec.update_every == 0 and len(self.replay) >= self.spec.least:
            self._update()

    def _update(self) -> None:
        rows, batch = self.replay.sample(self.spec.batch, self.rng)
        choice, reward, discount, weight = (
            batch[name].to(DEVICE) for name in ("choice", "reward", "discount", "weight")
        )
        before, after = laid_out(batch["before"].float()), laid_out(batch["after"].float())
        with mixed_precision(self._bf16):
            with torch.no_grad():
                best = self.network(after).argmax(1, keepdim=True)  # chosen by one network, valued by the other
                following = self.target(after).float().gather(1, best).squeeze(1)
            values = self.network(before).float().gather(1, choice.unsqueeze(1)).squeeze(1)
        wanted = reward + discount * following
        beta = self.spec.beta + (1 - self.spec.beta) * min(1.0, self.updates / self.spec.beta_updates)
        loss = (weight**beta * functional.huber_loss(values, wanted, reduction="none")).mean()
        self.optimizer.zero_grad()
        torch.autograd.backward(loss)
        self.optimizer.step()
        self.replay.prioritize(rows, (wanted - values).detach().cpu())
        self.updates += 1
        if self.updates % self.spec.target_every == 0:
            self.target.load_state_dict(self.network.state_dict())
