"""What a preset fixes."""

from dataclasses import dataclass

from learner.networks import NetworkSpec
from learner.policies import TrainSpec
from learner.rollout import Choosing


@dataclass(frozen=True)
class Preset:
    """The values of a run."""

    warm_start: int  # episodes of Algorithm 1 before an interactive algorithm begins
    network: NetworkSpec
    train_hi: TrainSpec
    train_lo: TrainSpec
    train_flat: TrainSpec
    choosing: Choosing
    symmetries: bool = False  # whether each label is also learned from in the domain's other symmetries
