"""Builds the network of Table 1 from torch's layers, for the libraries that are compared with ours."""

from collections.abc import Sequence

import torch
from torch import nn


def table_1(shape: Sequence[int], channels: Sequence[int], hidden: int, dropout: float) -> nn.Sequential:
    """Return the network for pictures of a shape, without its output layer."""
    layers: list[nn.Module] = []
    width = shape[0]
    for wider in channels:
        layers += [nn.Conv2d(width, wider, 3, padding="same"), nn.ReLU(), nn.Conv2d(wider, wider, 3), nn.ReLU()]
        layers += [nn.MaxPool2d(2), nn.Dropout(dropout)]
        width = wider
    network = nn.Sequential(*layers, nn.Flatten(), nn.LazyLinear(hidden), nn.ReLU(), nn.Dropout(dropout))
    network(torch.zeros(1, *shape))
    return network
