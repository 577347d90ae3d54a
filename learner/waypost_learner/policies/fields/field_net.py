"""A network for pictures that plans by spreading fields over the pixels, and is told nothing of the domain.

It finds the agent (`AgentFinder`), sees where its actions move it, and learns which pixels can be passed, where the
task ends, and where each subgoal ends near the agent. All of it comes from the expert's labels.
"""

import math
from dataclasses import dataclass

import torch
from torch import nn
from torch.nn import functional

from waypost_learner.policies.device import draw_weights
from waypost_learner.policies.fields.agent_finder import AgentFinder, Transitions
from waypost_learner.policies.fields.spreading import spread
from waypost_learner.policies.fields.symmetry_finder import NO_SYMMETRY, TURNS

_LARGEST = 690.0  # the logarithm of about the largest number of float64; gradients need a little room above it
_LARGEST_GROWTH = 600.0  # of a field, as a logarithm: fields below exp(600 - 690) can then not be told apart


@dataclass(frozen=True)
class FieldSpec:
    """Sizes of a network that spreads fields."""

    far: int = 64  # the most steps over which a field spreads
    reach: int | None = None  # pixels to the farthest end of a subgoal; as far as subgoals ended so far if None
    ending: int = 3  # pixels from the agent that beta_g sees, in each direction
    features: int = 32  # of a pixel, for the ends of subgoals
    hidden: int = 64  # units of beta_g
    gain: float = 1.8  # the sum of a spreading step's weights
    symmetries: bool = True  # whether symmetries are looked for that nobody told

    def __post_init__(self) -> None:
        """Refuse numbers out of their range.

        Raises:
            ValueError: a number is out of its range, or fields could grow beyond float64; the message says which.
        """
        reach = 1 if self.reach is None else self.reach
        if min(self.far, reach, self.ending, self.features, self.hidden) < 1 or self.gain <= 0:
            raise ValueError("fields need far, reach, ending, features and hidden of at least 1, and gain above 0")
        if self.growth > _LARGEST_GROWTH:
            raise ValueError("fields could grow beyond all numbers: choose a smaller far or gain")

    @property
    def growth(self) -> float:
        """The logarithm of how much a field can grow at most."""
        return self.far * math.log(self.gain)


_GATE_FEATURES = 16
# The farther a field must reach, the closer to 0 must be the gates of what cannot be passed, and the attention where
# the task does not end. With large multiples of what is learned, few updates make both that small.
_SHARP_GATES, _SHARP_SOURCE = 6.0, 15.0
_OPEN = -1 / 3  # the first output of the gates, before its multiple: at first almost everything can be passed
_FAINT = -3.0  # the first logit of a subgoal's ends
_DETOUR = 2  # steps that the way to a corner of the square around the agent may take beyond the shortest


class FieldNet(nn.Module):
    """One network for mu, all pi_g with beta_g, and a flat policy.

    A field h spreads from a source e through gates p between 0 and 1: h <- p * (W @ h) + e. W adds the neighboring
    pixels to which actions move the agent, each action with the same weight. It is a soft value iteration (Tamar et al.
    2016) in exp(V). The task's field spreads from where the task ends, a subgoal's field from where the subgoal ends.
    pi_g climbs the subgoal's field. For mu, each end of a subgoal counts as much as the task's field there. Ends of
    subgoals are looked for as far from the agent as subgoals have ended so far (`reach`).

    Args:
        shape: (channels, rows, columns) of the pictures.
        n_subgoals: the number of subgoals.
        n_actions: the number of actions.
        spec: the sizes.
        rng: draws initial weights.
    """

    def __init__(
        self, shape: tuple[int, ...], n_subgoals: int, n_actions: int, spec: FieldSpec, rng: torch.Generator
    ) -> None:
        super().__init__()
        channels, *sides = shape
        self.spec, self.n_actions = spec, n_actions
        # Added to fields before their logarithms. The gradient of a logarithm is 1 / field, and spreads back to a
        # source of which the field may be a multiple. With less than this, it could grow beyond float64.
        self._least = math.exp(spec.growth - _LARGEST)
        self.finder = AgentFinder(channels, n_actions).requires_grad_(False)
        self.register_buffer("displacements", torch.full((n_actions, 9), 1 / 9))
        self.symmetries: torch.Tensor
        self.register_buffer("symmetries", torch.full((len(TURNS), n_subgoals + n_actions), NO_SYMMETRY))
        gate = nn.Conv2d(_GATE_FEATURES, 1, 1)
        self.gates = nn.Sequential(nn.Conv2d(channels, _GATE_FEATURES, 1), nn.ReLU(), gate)
        self.source = nn.Conv2d(channels, 1, 1)
        self.near = nn.ModuleList(
            [
                nn.Conv2d(channels, spec.features, 3, padding=1),
                nn.Conv2d(spec.features, spec.features, 3, padding=1),
                nn.Conv2d(spec.features, n_subgoals, 1),
            ]
        )
        self._farthest = max(sides) - 1
        side = 2 * self._farthest + 1  # of a square around the agent that holds the picture wherever the agent is
        self.place = nn.Parameter(torch.zeros(spec.features, side, side))  # tells apart pixels around the agent
        self.ends_place = nn.Parameter(torch.zeros(n_subgoals, side, side))
        self.reach: torch.Tensor
        # Pixels around the agent, in each direction, among which ends of subgoals are looked for.
        self.register_buffer("reach", torch.tensor(min(spec.reach or 1, self._farthest)))
        self.termination = nn.Sequential(
            nn.Flatten(),
            nn.Linear(channels * (2 * spec.ending + 1) ** 2, spec.hidden),
            nn.ReLU(),
            nn.Linear(spec.hidden, n_subgoals),
        )
        for layer in self.modules():
            if isinstance(layer, nn.Conv2d | nn.Linear):
                draw_weights(layer, rng)
        for same in (gate, self.source):  # at first, all pixels have the same gate and the same share of the attention
            nn.init.zeros_(same.weight)
        nn.init.constant_(gate.bias, _OPEN)  # type: ignore[arg-type]  # this layer has a bias
        nn.init.constant_(self.near[2].bias, _FAINT)  # type: ignore[arg-type]  # a list of modules has no layer types

    def find_agent(self, transitions: Transitions, rng: torch.Generator) -> None:
        """Learn to find the agent, and where each action moves it, from transitions."""
        self.finder.requires_grad_(True).fit(transitions, rng)
        self.finder.requires_grad_(False)
        self.displacements = self.finder.displacements(transitions)

    def look_as_far_as(self, chosen: torch.Tensor, ended: torch.Tensor) -> None:
        """Look for ends of subgoals as far from the agent as subgoals ended, unless `FieldSpec.reach` says how far.

        Args:
            chosen: the pictures in which subgoals were chosen, float32[N, C, rows, columns].
            ended: the pictures in which they ended.
        """
        if self.spec.reach is None:
            moved = (self.finder.find(ended) - self.finder.find(chosen)).abs().max()
            self.reach = moved.clamp(1, self._farthest)

    def forward(self, x: torch.Tensor) -> dict[str, torch.Tensor]:
        """Return all outputs for pictures float32[B, C, rows, columns].

        `hi` float32[B, subgoals]: logits of mu. `lo` float32[B, subgoals, actions]: logits of each pi_g.
        `seen` float32[B, subgoals]: how likely it is that the subgoal ends in the pixel where this is likeliest.
        `termination` float32[B, subgoals]: logits of each beta_g. `flat` float32[B, actions]: logits of a flat policy.
        """
        spec, agent, reach = self.spec, self.finder.find(x), int(self.reach)
        # All that fields are made of is float64: a gradient on the way back to it can be far beyond float32.
        gates = self.passed(x)
        source = torch.softmax(_SHARP_SOURCE * self.source(x).double().flatten(1), 1).view_as(gates)
        task = self._spread(gates, source, spec.far)
        patch, near_gates, near_task = (_around(one, agent, reach) for one in (x, gates, task))
        ends = near_gates * torch.sigmoid(self._ends(patch).double())  # a subgoal ends only where one can pass
        both = torch.cat([ends, ends * near_task], 1)
        subgoals = self._spread(near_gates.expand_as(both), both, min(2 * reach + _DETOUR, spec.far))
        lo, hi = subgoals.chunk(2, 1)
        return {
            "hi": torch.log(hi[:, :, reach, reach] + self._least).float(),
            "lo": self._climb(lo[:, :, reach - 1 : reach + 2, reach - 1 : reach + 2]),
            "seen": ends.flatten(2).amax(2).float(),
            "termination": self.termination(_around(x, agent, spec.ending)),
            "flat": self._climb(_around(task, agent, 1)).squeeze(1),
        }

    def passed(self, x: torch.Tensor) -> torch.Tensor:
        """Return how easily each pixel is passed, float64[B, 1, rows, columns] between 0 and 1."""
        return torch.sigmoid(-_SHARP_GATES * self.gates(x).double())

    def _ends(self, patch: torch.Tensor) -> torch.Tensor:
        """Return the logits of each subgoal's ends float32[B, subgoals, side, side] around the agent."""
        first, second, third = self.near
        place, ends_place = (self._around_middle(one, patch.shape[3] // 2) for one in (self.place, self.ends_place))
        seen = functional.relu(second(functional.relu(first(patch))) + place)
        return torch.add(third(seen), ends_place)

    def _around_middle(self, x: torch.Tensor, reach: int) -> torch.Tensor:
        span = slice(self._farthest - reach, self._farthest + reach + 1)
        return x[:, span, span]

    def _spread(self, gates: torch.Tensor, source: torch.Tensor, steps: int) -> torch.Tensor:
        """Spread fields float64[B, K, rows, columns]."""
        weights = self.spec.gain * self.displacements.mean(0)
        return spread(gates.flatten(0, 1), source.flatten(0, 1), weights, steps).view_as(source)

    def _climb(self, around: torch.Tensor) -> torch.Tensor:
        """Return the logits of actions float32[B, K, actions], given fields float64[B, K, 3, 3] around the agent."""
        return torch.log(around.flatten(2) @ self.displacements.double().T + self._least).float()


def _around(x: torch.Tensor, agent: torch.Tensor, reach: int) -> torch.Tensor:
    """Return the pixels [B, C, side, side] around the agent's int64[B, 2] row and column; 0 outside the picture."""
    padded = functional.pad(x, (reach, reach, reach, reach)).permute(0, 2, 3, 1)
    span = torch.arange(2 * reach + 1, device=x.device)
    rows, columns = (agent[:, one, None] + span for one in (0, 1))
    every = torch.arange(len(x), device=x.device)[:, None, None]
    return padded[every, rows[:, :, None], columns[:, None, :]].permute(0, 3, 1, 2)
