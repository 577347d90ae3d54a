"""The preset `paper`: section 6.1, the appendix and Table 1, with the authors' code where the text gives no value."""

from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import NetworkSpec, blocks
from waypost_learner.presets.base import Preset, Training
from waypost_learner.rollout.rollout import RolloutSpec, SelectionSpec

# Table 1's network is trained with Adam at 5e-4 and the authors' batch of 32: the defaults of TrainSpec.
PAPER = Preset(
    warm_start=200,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.1, termination_threshold=0.9), h_hi=14),
    training=Training(
        network=NetworkSpec(blocks(32, 64), hidden=256),
        train_hi=TrainSpec(passes=4, least=1024, most=6144, dropout=0.5, every_episode=True),
        train_lo=TrainSpec(passes=1, least=1024, most=1024, dropout=0.5),
        train_flat=TrainSpec(passes=1, least=1024, most=6144, dropout=0.5, every_episode=True),
        train_hi_hybrid=TrainSpec(passes=1, least=128, most=512, dropout=0.5),
        dqn=DqnSpec(),
    ),
)
