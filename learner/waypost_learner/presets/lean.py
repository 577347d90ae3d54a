"""The preset `lean`: the paper's queries and prices at the least expert cost.

docs/lean.md says what each value saves.
"""

from waypost_learner.policies.domain_use import DomainUse
from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import NetworkSpec, blocks
from waypost_learner.presets.base import Preset, Training
from waypost_learner.rollout.rollout import RolloutSpec, SelectionSpec

_ROWS = 100 * 64  # in each call of Train: a small buffer is used for many passes
_IDLE_HI, _IDLE_LO = 200 * 64, 400 * 64  # LO labels are rare, so pi_g is trained in few episodes
_HYBRID_ROWS = 20 * 64

LEAN = Preset(
    warm_start=3,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.1, termination_threshold=0.5), repeat_penalty=3.0),
    training=Training(
        network=NetworkSpec(blocks(16, 32), hidden=128),  # where the domain declares no places
        train_hi=TrainSpec(5e-3, 64, least=_ROWS, most=_ROWS, idle=_IDLE_HI, dropout=0.0, averaging=0.995, bf16=False),
        train_lo=TrainSpec(
            1e-2, 64, least=_ROWS, most=_ROWS, idle=_IDLE_LO, dropout=0.0, weight_decay=0.1, averaging=0.995, bf16=False
        ),
        train_flat=TrainSpec(
            5e-3, 64, least=_ROWS, most=_ROWS, idle=_IDLE_HI, dropout=0.0, averaging=0.995, bf16=False
        ),  # as mu, because a flat policy plans as mu does
        train_hi_hybrid=TrainSpec(
            5e-3, 64, least=_HYBRID_ROWS, most=_HYBRID_ROWS, dropout=0.0, averaging=0.995, bf16=False
        ),
        dqn=DqnSpec(),
    ),
    use=DomainUse(symmetries=True, tied=True, views=True, planning=32, relabeling=True),
)
