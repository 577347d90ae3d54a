"""Networks: convolutional ones for pictures, and one for vectors. `planning.py` has the one that plans."""

from dataclasses import dataclass
from typing import Literal

import torch
from torch import nn

from waypost_learner.policies.device import draw_weights
from waypost_learner.policies.planning import PlanningNet, PlanningSpec


@dataclass(frozen=True)
class Convolution:
    """One convolution, followed by a ReLU."""

    channels: int
    kernel: int  # side of the square, in pixels
    stride: int = 1
    padding: Literal["same", "valid"] = "valid"
    pool: bool = False  # whether a 2x2 max-pool and dropout follow


def blocks(*channels: int) -> tuple[Convolution, ...]:
    """Return the convolutions of Table 1: blocks of two 3x3 convolutions and a 2x2 max-pool, with these channels."""
    return tuple(
        one
        for width in channels
        for one in (Convolution(width, 3, padding="same"), Convolution(width, 3, padding="valid", pool=True))
    )


@dataclass(frozen=True)
class NetworkSpec:
    """The layers of a network for pictures: convolutions, then one hidden layer. For vectors: two hidden layers."""

    convolutions: tuple[Convolution, ...] = blocks(32, 64)
    hidden: int = 256  # units of a hidden layer
    # The standard deviation of its initial weights, which are then normal (Table 2); Glorot's method if None.
    hidden_std: float | None = None
    # Multiplies pictures, which are fractions of 255. With 255, a network reads bytes, as in the authors' code.
    scale: float = 1.0


class Dropout(nn.Module):
    """Dropout with its own random generator, so that networks trained in parallel stay reproducible."""

    def __init__(self, rate: float, rng: torch.Generator) -> None:
        super().__init__()
        self.rate, self._rng = rate, rng
        self._kept = round(256 * (1 - rate))

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """In training, return x with entries zeroed at the rate and the others scaled up; otherwise return x."""
        if not self.training or self.rate == 0:
            return x
        # Random bytes are four times faster to draw than Bernoulli variables. They round the rate to 1/256.
        kept = _random_bytes(x, self._rng) < self._kept
        return x * kept * (256 / self._kept)


def _random_bytes(like: torch.Tensor, rng: torch.Generator) -> torch.Tensor:
    """Return random uint8 with the shape, memory layout and device of a tensor."""
    words = torch.empty(-(-like.numel() // 8), dtype=torch.int64).random_(-(2**63), None, generator=rng)
    return words.view(torch.uint8).to(like.device).as_strided(like.shape, like.stride())


def build_network(
    observation_shape: tuple[int, ...],
    outputs: int,
    spec: NetworkSpec | PlanningSpec,
    dropout: float,
    rng: torch.Generator,
) -> nn.Module:
    """Return a new network.

    Args:
        observation_shape: (channels, rows, columns) for pictures, (features,) for vectors.
        outputs: the number of logits.
        spec: the kind and the sizes of the network.
        dropout: the rate after each pool and after the fully connected layer; networks that plan have no dropout.
        rng: draws initial weights and dropout.

    Raises:
        ValueError: the shape is neither a picture's nor a vector's.
    """
    if isinstance(spec, PlanningSpec):
        return PlanningNet(observation_shape[0], outputs, spec, rng)
    if len(observation_shape) == 3:
        return ConvNet(observation_shape, outputs, spec, dropout, rng)
    if len(observation_shape) == 1:
        return DenseNet(observation_shape[0], outputs, spec, dropout, rng)
    raise ValueError(f"no network for observations of shape {observation_shape}; use (C, rows, columns) or (features,)")


class ConvNet(nn.Sequential):
    """Maps pictures float32[B, C, rows, columns] to logits float32[B, outputs] (Tables 1 and 2)."""

    def __init__(
        self, observation_shape: tuple[int, ...], outputs: int, spec: NetworkSpec, dropout: float, rng: torch.Generator
    ) -> None:
        channels, rows, columns = observation_shape
        layers: list[nn.Module] = []
        for one in spec.convolutions:
            layers.append(nn.Conv2d(channels, one.channels, one.kernel, one.stride, one.padding))
            if one.pool:
                layers += [nn.MaxPool2d(2), nn.ReLU(), Dropout(dropout, rng)]  # ReLU of a quarter of the entries
            else:
                layers.append(nn.ReLU())
            channels, rows, columns = one.channels, _side(rows, one), _side(columns, one)
        hidden = nn.Linear(channels * rows * columns, spec.hidden)
        layers += [nn.Flatten(), hidden, nn.ReLU(), Dropout(dropout, rng), nn.Linear(spec.hidden, outputs)]
        super().__init__(*layers)
        _initialize(layers, rng)
        if spec.hidden_std is not None:
            nn.init.normal_(hidden.weight, std=spec.hidden_std, generator=rng)
        self.scale = spec.scale
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]  # torch's stub lacks this form

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Return the logits of pictures."""
        x = x if self.scale == 1 else x * self.scale
        for layer in self:
            x = layer(x)
        return x


def _side(pixels: int, one: Convolution) -> int:
    """Return the side of a picture after a convolution."""
    after = pixels if one.padding == "same" else (pixels - one.kernel) // one.stride + 1
    return after // 2 if one.pool else after


class DenseNet(nn.Sequential):
    """Maps vectors float32[B, features] to logits float32[B, outputs] through two layers of `spec.hidden` units."""

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


def _initialize(layers: list[nn.Module], rng: torch.Generator) -> None:
    """Draw initial weights with Glorot's method, the default of the authors' framework, and set biases to 0."""
    for layer in layers:
        if isinstance(layer, nn.Conv2d | nn.Linear):
            draw_weights(layer, rng)
