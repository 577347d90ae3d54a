"""The paper's setting: section 6.1, the appendix, Table 1, and the authors' values where the text is silent."""

from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import NetworkSpec
from waypost_learner.presets.base import Preset
from waypost_learner.rollout.rollout import Choosing

# Table 1's network is trained with Adam at 5e-4 (TrainSpec's defaults, with the authors' batch of 32).
PAPER = Preset(
    warm_start=200,
    network=NetworkSpec(channels=(32, 64), hidden=256),
    train_hi=TrainSpec(passes=4, least=1024, most=6144, dropout=0.5, every_episode=True),
    train_lo=TrainSpec(passes=1, least=1024, most=1024, dropout=0.5),
    train_flat=TrainSpec(passes=1, least=1024, most=6144, dropout=0.5, every_episode=True),
    train_hi_hybrid=TrainSpec(passes=1, least=128, most=512, dropout=0.5),
    dqn=DqnSpec(),
    h_hi=14,
    choosing=Choosing(temperature=0.1, termination_threshold=0.9),
)
