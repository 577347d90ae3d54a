"""The preset `lean` for the domain `montezuma`."""

from dataclasses import replace

from waypost_learner.policies.domain_use import DomainUse
from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import Convolution, NetworkSpec
from waypost_learner.presets.base import Preset, Training
from waypost_learner.rollout.rollout import RolloutSpec, SelectionSpec

# The small network learns in seconds from the few thousand labels that there are.
_SMALL = TrainSpec(1e-3, 64, least=100 * 64, most=100 * 64, dropout=0.0, averaging=0.99, bf16=False)
_SMALL_LO = replace(_SMALL, dropout=0.3)

# A subgoal takes the expert about 45 actions. Segments end at 80, because an expert labels all of a failed segment.
LEAN = Preset(
    warm_start=5,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.0, termination_threshold=0.9), h_hi=8, h_lo=80),
    training=Training(
        network=NetworkSpec((Convolution(16, 6, 4), Convolution(32, 3, 2)), hidden=128),
        train_hi=_SMALL,
        train_lo=_SMALL_LO,
        train_flat=_SMALL_LO,
        train_hi_hybrid=_SMALL,
        dqn=DqnSpec(),
    ),
    use=DomainUse(views=True),
)
