"""What a preset fixes."""

from dataclasses import dataclass

from learner.dqn import DqnSpec
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
    train_hi_hybrid: TrainSpec  # mu's where subpolicies learn by reinforcement, over many more episodes
    dqn: DqnSpec
    choosing: Choosing
    h_hi: int | None = None  # most subgoals of an episode; the domain's number if None
    symmetries: bool = False  # whether each label is also learned from in the domain's other symmetries
