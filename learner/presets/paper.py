"""The paper's setting: section 6.1, the appendix, Table 1, and the authors' values where the text is silent."""

from learner.dqn import DqnSpec
from learner.networks import NetworkSpec
from learner.policies import TrainSpec
from learner.presets.base import Preset
from learner.rollout import Choosing

PAPER = Preset(
    warm_start=200,
    network=NetworkSpec(channels=(32, 64), hidden=256),
    train_hi=TrainSpec(learning_rate=5e-4, batch=32, passes=4, least=1024, most=6144, dropout=0.5),
    train_lo=TrainSpec(learning_rate=5e-4, batch=32, passes=1, least=1024, most=1024, dropout=0.5),
    train_flat=TrainSpec(learning_rate=5e-4, batch=32, passes=1, least=1024, most=8192, dropout=0.5),
    train_hi_hybrid=TrainSpec(learning_rate=5e-4, batch=32, passes=1, least=128, most=2048, dropout=0.5),
    dqn=DqnSpec(),
    h_hi=14,
    choosing=Choosing(temperature=0.1, termination_threshold=0.9),
)
