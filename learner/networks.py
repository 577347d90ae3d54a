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


class ConvNet(nn.Sequential):
    """Maps float32[B, C, rows, columns] to logits float32[B, outputs]."""

    def __init__(self, observation_shape: tuple[int, ...], outputs: int, spec: ConvSpec) -> None:
        channels, rows, columns = observation_shape
        layers: list[nn.Module] = []
        for width in spec.channels:
            layers += [
                nn.Conv2d(channels, width, 3, padding="same"),
                nn.ReLU(),
                nn.Conv2d(width, width, 3, padding="valid"),
                nn.ReLU(),
                nn.MaxPool2d(2),
                nn.Dropout(spec.dropout),
            ]
            channels, rows, columns = width, (rows - 2) // 2, (columns - 2) // 2
        layers += [
            nn.Flatten(),
            nn.Linear(channels * rows * columns, spec.hidden),
            nn.ReLU(),
            nn.Dropout(spec.dropout),
            nn.Linear(spec.hidden, outputs),
        ]
        super().__init__(*layers)
        self.to(memory_format=torch.channels_last)  # type: ignore[call-overload]  # torch's stub lacks this form
