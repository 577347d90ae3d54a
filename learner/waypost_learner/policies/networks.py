"""The network of Table 1, its sizes being values of a preset; and a plain one for domains that are not pictures."""

from dataclasses import dataclass

import torch
from torch import nn
from torch.nn import functional

from waypost.domain import Grid


@dataclass(frozen=True)
class NetworkSpec:
    """Table 1: blocks of two 3x3 convolutions and a 2x2 max-pool, one fully connected layer, the output layer."""

    channels: tuple[int, ...] = (32, 64)
    hidden: int = 256


@dataclass(frozen=True)
class PlanningSpec:
    """A network that plans ways through the places that a view shows."""

    grid: Grid
    horizon: int  # how many choices ahead it looks
    features: int  # of a place


class Dropout(nn.Module):
    """Dropout that draws from a generator of its own, so that networks trained side by side stay reproducible."""

    def __init__(self, rate: float, rng: torch.Generator) -> None:
        super().__init__()
        self.rate, self._rng = rate, rng
        self._kept = round(256 * (1 - rate))

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Zero entries at the rate and scale the others up, in training only."""
        if not self.training or self.rate == 0:
            return x
        # A random byte an entry is four times quicker to draw than a Bernoulli variable; it rounds the rate to 1/256.
        kept = _random_bytes(x, self._rng) < self._kept
        return x * kept * (256 / self._kept)


def _random_bytes(like: torch.Tensor, rng: torch.Generator) -> torch.Tensor:
    """Return uint8 of the shape, the memory layout and the device of a tensor."""
    words = torch.empty(-(-like.numel() // 8), dtype=torch.int64).random_(-(2**63), None, generator=rng)
    return words.view(torch.uint8).to(like.device).as_strided(like.shape, like.stride())


def build_network(
    observation_shape: tuple[int, ...],
    outputs: int,
    spec: NetworkSpec | PlanningSpec,
    dropout: float,
    rng: torch.Generator,
) -> nn.Module:
    """Return the network for observations of a shape: (channels, rows, columns) for pictures, (features,) for vectors.

    Dropout comes after each pool and after the fully connected layer; a network that plans has none.

    Raises:
        ValueError: observations of another shape.
    """
    if isinstance(spec, PlanningSpec):
        return PlanningNet(observation_shape[0], outputs, spec, rng)
    if len(observation_shape) == 3:
        return ConvNet(observation_shape, outputs, spec, dropout, rng)
    if len(observation_shape) == 1:
        return DenseNet(observation_shape[0], outputs, spec, dropout, rng)
    raise ValueError(f"no network for observations of shape {observation_shape}; use (C, rows, columns) or (features,)")


class ConvNet(nn.Sequential):
    """Maps float32[B, C, rows, columns] to logits float32[B, outputs].

    Weights and dropout are drawn from `rng` alone.
    """

    def __init__(
        self, observation_shape: tuple[int, ...], outputs: int, spec: NetworkSpec, dropout: float, rng: torch.Generator
    ) -> None:
        channels, rows, columns = observation_shape
        layers: list[nn.Module] = []
        for width in spec.channels:
            layers += [
                nn.Conv2d(channels, width, 3, padding="same"),
                nn.ReLU(),
                nn.Conv2d(width, width, 3, padding="valid"),
                nn.MaxPool2d(2),
                nn.ReLU(),  # after the pool it does the same to a quarter of the entries
                Dropout(dropout, rng),
            ]
            channels, rows, columns = width, (rows - 2) // 2, (columns - 2) // 2
        layers += [
            nn.Flatten(),
            nn.Linear(channels * rows * columns, spec.hidden),
            nn.ReLU(),
            Dropout(dropout, rng),
            nn.Linear(spec.hidden, outputs),
        ]
        super().__init__(*layers)
        _initialize(layers, rng)
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]  # torch's stub lacks this form


class DenseNet(nn.Sequential):
    """Maps float32[B, features] to logits float32[B, outputs] through two layers of `spec.hidden`."""

    def __init__(self, features: int, outputs: int, spec: NetworkSpec, dropout: float, rng: torch.Generator) -> None:
        layers: list[nn.Module] = [
            nn.Linear(features, spec.hidden),
            nn.ReLU(),
            nn.Linear(spec.hidden, spec.hidden),
            nn.ReLU(),
            Dropout(dropout, rng),
            nn.Linear(spec.hidden, outputs),
        ]
        super().__init__(*layers)
        _initialize(layers, rng)


class PlanningNet(nn.Module):
    """Maps float32[B, C, rows, columns] to the values float32[B, outputs] of the choices where the agent is.

    By what its patch shows, each place has a cost of each choice there. Soft value iteration over the places makes
    values of choices of these costs: value iteration networks (Tamar et al. 2016) with the moves given by the domain
    and costs that depend on the place. The agent's place is in the middle of the picture.

    Where to end is no choice of the grid's, ending has a cost all the same; if one more output is asked for, it is the
    logit of beta_g, of ending rather than going on.
    """

    def __init__(self, channels: int, outputs: int, spec: PlanningSpec, rng: torch.Generator) -> None:
        super().__init__()
        self.moves = [move for move in spec.grid.moves if move is not None]  # ending comes last
        self.outputs, self.terminates, self.horizon = outputs, outputs > len(spec.grid.moves), spec.horizon
        self.places = nn.Conv2d(channels, spec.features, spec.grid.patch, spec.grid.stride)
        self.costs = nn.Conv2d(spec.features, len(self.moves) + 1, 1)
        _initialize([self.places, self.costs], rng)

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Plan.

        What is iterated is exp(V), which makes each round a sum of products: exp(V) <- sum over choices of
        exp(-cost) times exp(V) of where it leads.
        """
        passable = torch.sigmoid(-self.costs(functional.relu(self.places(x))))  # exp(-cost), cost = softplus
        moving, ending = passable[:, :-1], passable[:, -1]
        reached = ending
        for _ in range(self.horizon - 1):
            reached = (moving * self._ahead(reached)).sum(1) + ending
        row, column = (size // 2 for size in ending.shape[1:])
        here = torch.cat([(moving * self._ahead(reached))[:, :, row, column], ending[:, None, row, column]], 1)
        if self.terminates:
            going_on = here[:, :-1].sum(1, keepdim=True)
            return torch.cat([_log(here[:, :-1]), _log(here[:, -1:]) - _log(going_on)], 1)
        return _log(here)[:, : self.outputs]

    def _ahead(self, reached: torch.Tensor) -> torch.Tensor:
        """Return what is reached by each move, float32[B, moves, rows, columns]: nothing beyond the picture."""
        rows, columns = reached.shape[1:]
        padded = functional.pad(reached, (1, 1, 1, 1))
        return torch.stack([padded[:, 1 + r : 1 + r + rows, 1 + c : 1 + c + columns] for r, c in self.moves], 1)


def _log(x: torch.Tensor) -> torch.Tensor:
    """Return the logarithm; what costs more than 80 is all one, as 32-bit floats have nothing much smaller."""
    return torch.log(x.clamp(min=1e-35))


def _initialize(layers: list[nn.Module], rng: torch.Generator) -> None:
    """Draw Glorot's initial weights, the default of the authors' framework."""
    for layer in layers:
        if isinstance(layer, nn.Conv2d | nn.Linear):
            assert layer.bias is not None
            nn.init.xavier_uniform_(layer.weight, generator=rng)
            nn.init.zeros_(layer.bias)
