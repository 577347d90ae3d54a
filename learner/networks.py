"""The network of Table 1, its sizes being values of a preset."""

from dataclasses import dataclass

import torch
from torch import nn


@dataclass(frozen=True)
class ConvSpec:
    """Table 1: blocks of two 3x3 convolutions and a 2x2 max-pool, one fully connected layer, the output layer."""

    channels: tuple[int, ...] = (32, 64)
    hidden: int = 256
    dropout: float = 0.5  # after each pool and after the fully connected layer, the authors' value


class Dropout(nn.Module):
    """Dropout that draws from a generator of its own, so that networks trained side by side stay reproducible."""

    def __init__(self, rate: float, rng: torch.Generator) -> None:
        super().__init__()
        self.rate, self._rng = rate, rng

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Zero entries at the rate and scale the others up, in training only."""
        if not self.training or self.rate == 0:
            return x
        kept = torch.empty_like(x).bernoulli_(1 - self.rate, generator=self._rng)
        return x * kept.div_(1 - self.rate)


class ConvNet(nn.Sequential):
    """Maps float32[B, C, rows, columns] to logits float32[B, outputs].

    Weights and dropout are drawn from `rng` alone.
    """

    def __init__(self, observation_shape: tuple[int, ...], outputs: int, spec: ConvSpec, rng: torch.Generator) -> None:
        channels, rows, columns = observation_shape
        layers: list[nn.Module] = []
        for width in spec.channels:
            layers += [
                nn.Conv2d(channels, width, 3, padding="same"),
                nn.ReLU(),
                nn.Conv2d(width, width, 3, padding="valid"),
                nn.ReLU(),
                nn.MaxPool2d(2),
                Dropout(spec.dropout, rng),
            ]
            channels, rows, columns = width, (rows - 2) // 2, (columns - 2) // 2
        layers += [
            nn.Flatten(),
            nn.Linear(channels * rows * columns, spec.hidden),
            nn.ReLU(),
            Dropout(spec.dropout, rng),
            nn.Linear(spec.hidden, outputs),
        ]
        super().__init__(*layers)
        for layer in layers:  # Glorot's initialization, the default of the authors' framework
            if isinstance(layer, nn.Conv2d | nn.Linear):
                assert layer.bias is not None
                nn.init.xavier_uniform_(layer.weight, generator=rng)
                nn.init.zeros_(layer.bias)
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]  # torch's stub lacks this form
