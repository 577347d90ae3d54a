"""Presets: every value that fixes how a run learns, in one readable file each."""

from dataclasses import dataclass

from learner.networks import ConvSpec
from learner.policies import TrainSpec
from learner.rollout import Choosing


@dataclass(frozen=True)
class Preset:
    """The values of a run."""

    warm_start: int  # episodes of Algorithm 1 before an interactive algorithm begins
    network: ConvSpec
    train_hi: TrainSpec
    train_lo: TrainSpec
    choosing: Choosing
