"""Small and quick, for `waypost demo` and rehearsals: half the paper's network, a fraction of its demonstrations."""

from learner.dqn import DqnSpec
from learner.networks import NetworkSpec
from learner.policies import TrainSpec
from learner.presets.base import Preset
from learner.rollout import Choosing

DEMO = Preset(
    warm_start=20,
    network=NetworkSpec(channels=(16, 32), hidden=128),
    train_hi=TrainSpec(learning_rate=1e-3, batch=32, passes=2, most=4096, dropout=0.3),
    train_lo=TrainSpec(learning_rate=1e-3, batch=32, passes=1, least=2048, dropout=0.3),
    train_flat=TrainSpec(learning_rate=1e-3, batch=32, passes=1, least=2048, most=4096, dropout=0.3),
    train_hi_hybrid=TrainSpec(learning_rate=1e-3, batch=32, passes=1, least=512, most=1024, dropout=0.3),
    dqn=DqnSpec(),
    choosing=Choosing(temperature=0.1, termination_threshold=0.9),
    symmetries=True,
)
