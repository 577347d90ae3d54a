"""What a preset fixes."""

from dataclasses import dataclass

from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import NetworkSpec
from waypost_learner.presets.monitoring import EVERY_EPISODE, Monitoring
from waypost_learner.rollout.rollout import Choosing


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
    tied: bool = (
        False  # whether one network acts toward all subgoals that are one but for a symmetry; needs `symmetries`
    )
    # What is made of a domain's structure, where it tells of it (`learner.domains.base.Structured`):
    views: bool = False  # whether policies are given the domain's views, rather than all that there is to see
    planning: int | None = None  # where a view shows places, a network plans over them, by so many features of each
    repeat_penalty: float = 0.0  # off the logit of a subgoal, for each time it was chosen in the same place before
    relabeling: bool = False  # whether labels and demonstrations are also learned from as those of other tasks
    monitoring: Monitoring = EVERY_EPISODE  # which episodes the expert is asked about

    def __post_init__(self) -> None:
        """Refuse values that contradict each other.

        Raises:
            ValueError: tied policies without the symmetries through which they learn from each other's labels.
        """
        if self.tied and not self.symmetries:
            raise ValueError("tied=true needs symmetries=true: a policy learns through them what the other was taught")
