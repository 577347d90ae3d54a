"""Ours: the paper's questions, rules and prices, and the least expert cost. What each value buys: docs/lean.md."""

from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import NetworkSpec
from waypost_learner.presets.base import Preset
from waypost_learner.rollout.rollout import Choosing

_ROWS = 100 * 64  # of a round: small data is gone through again and again
_IDLE_HI, _IDLE_LO = 200 * 64, 400 * 64  # LO labels come seldom, so there are few rounds
_HYBRID_ROWS = 20 * 64

LEAN = Preset(
    warm_start=3,
    network=NetworkSpec(channels=(16, 32), hidden=128),  # where nothing is planned: flat policies
    planning=32,
    train_hi=TrainSpec(5e-3, 64, least=_ROWS, most=_ROWS, idle=_IDLE_HI, dropout=0.0, averaging=0.995, bf16=False),
    train_lo=TrainSpec(
        1e-2, 64, least=_ROWS, most=_ROWS, idle=_IDLE_LO, dropout=0.0, weight_decay=0.1, averaging=0.995, bf16=False
    ),
    train_flat=TrainSpec(1e-3, 64, least=_ROWS, most=_ROWS, dropout=0.2, averaging=0.995),
    train_hi_hybrid=TrainSpec(
        5e-3, 64, least=_HYBRID_ROWS, most=_HYBRID_ROWS, dropout=0.0, averaging=0.995, bf16=False
    ),
    dqn=DqnSpec(),
    choosing=Choosing(temperature=0.1, termination_threshold=0.5),
    symmetries=True,
    tied=True,
    views=True,
    repeat_penalty=3.0,
    relabeling=True,
)
