"""Runs behavioral cloning of the `imitation` library on Table 1's network, for `bench/training.py`.

The network is the features extractor of stable-baselines3 without more layers (`net_arch=[]`); its action layer is the
output layer. Data, batch size, optimizer and learning rate are the same as ours. But a step does more than ours: it
also computes a value layer, which is not trained; the loss has an entropy term (weight 1e-3) and computes the L2 norm
of all weights (weight 0); and the torch DataLoader collates each batch row by row, including the next observations. It
uses 32-bit floats, and its log is off.
"""

from collections.abc import Callable, Sequence
from pathlib import Path

import gymnasium
import numpy as np
import torch
from imitation.algorithms.bc import BC
from imitation.data.types import Transitions
from imitation.util import logger
from network import table_1
from stable_baselines3.common.policies import ActorCriticPolicy
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor

PACKAGES = ("imitation", "stable-baselines3", "torch")


class Features(BaseFeaturesExtractor):
    """The network of Table 1 without its output layer."""

    def __init__(self, space: gymnasium.Space, channels: Sequence[int], hidden: int, dropout: float) -> None:
        super().__init__(space, hidden)
        self.layers = table_1(space.shape, channels, hidden, dropout)

    def forward(self, observations: torch.Tensor) -> torch.Tensor:
        """Map float32[B, C, rows, columns] to float32[B, hidden]."""
        return self.layers(observations)


def start(data: str, choices: int, batch: int, learning_rate: float, **network: object) -> Callable[[int], None]:
    """Return a function that trains for a number of batches."""
    torch.set_num_threads(1)
    rows = np.load(data)
    observations, labels = rows["observations"], rows["labels"]
    observed = gymnasium.spaces.Box(-1.0, 1.0, observations.shape[1:], np.float32)
    chosen = gymnasium.spaces.Discrete(choices)
    unused = {"infos": np.array([{}] * len(labels)), "next_obs": observations, "dones": np.ones(len(labels), bool)}
    policy = ActorCriticPolicy(
        observed,
        chosen,
        lambda _: learning_rate,
        net_arch=[],
        features_extractor_class=Features,
        features_extractor_kwargs=network,
    )
    policy.set_training_mode(True)
    cloning = BC(
        observation_space=observed,
        action_space=chosen,
        rng=np.random.default_rng(0),
        policy=policy,
        demonstrations=Transitions(observations, labels, **unused),
        batch_size=batch,
        optimizer_kwargs={"lr": learning_rate},
        device="cpu",
        custom_logger=logger.configure(Path(data).parent, []),
    )
    return lambda batches: cloning.train(n_batches=batches, progress_bar=False)
