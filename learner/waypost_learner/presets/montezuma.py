"""The presets `lean` and `paper` for the domain `montezuma` (section 6.2, the appendix and Table 2)."""

from waypost_learner.policies.domain_use import DomainUse
from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import Convolution, NetworkSpec
from waypost_learner.presets.base import Preset, Training
from waypost_learner.rollout.rollout import RolloutSpec, SelectionSpec

_ROWS = 100 * 64

LEAN = Preset(
    warm_start=5,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.0, termination_threshold=0.5), h_hi=8, h_lo=80),
    training=Training(
        network=NetworkSpec((Convolution(16, 6, 4), Convolution(32, 3, 2)), hidden=128),
        train_hi=TrainSpec(1e-3, 64, least=_ROWS, most=_ROWS, dropout=0.0, averaging=0.99, bf16=False),
        train_lo=TrainSpec(1e-3, 64, least=_ROWS, most=_ROWS, dropout=0.0, averaging=0.99, bf16=False),
        train_flat=TrainSpec(1e-3, 64, least=_ROWS, most=_ROWS, dropout=0.0, averaging=0.99, bf16=False),
        train_hi_hybrid=TrainSpec(1e-3, 64, least=_ROWS, most=_ROWS, dropout=0.0, averaging=0.99, bf16=False),
        dqn=DqnSpec(),
    ),
    use=DomainUse(views=True),
)

PAPER = Preset(
    warm_start=0,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.0, termination_threshold=0.9)),
    training=Training(
        network=NetworkSpec(
            (Convolution(32, 8, 4), Convolution(64, 4, 2), Convolution(64, 3)), hidden=512, hidden_std=0.01
        ),
        train_hi=TrainSpec(),
        train_lo=TrainSpec(),
        train_flat=TrainSpec(),
        train_hi_hybrid=TrainSpec(),
        dqn=DqnSpec(),
    ),
)
