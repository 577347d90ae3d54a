"""The presets `lean` and `paper` for the domain `montezuma` (section 6.2, the appendix and Table 2)."""

from dataclasses import replace

from waypost_learner.policies.domain_use import DomainUse
from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import Convolution, NetworkSpec
from waypost_learner.presets.base import Preset, Training
from waypost_learner.presets.monitoring import Monitoring
from waypost_learner.rollout.experience import PseudoReward
from waypost_learner.rollout.rollout import RolloutSpec, SelectionSpec

# The small network learns in seconds from the few thousand labels that there are.
_SMALL = TrainSpec(1e-3, 64, least=100 * 64, most=100 * 64, dropout=0.0, averaging=0.99, bf16=False)
_SMALL_LO = replace(_SMALL, dropout=0.3)

# A subgoal takes the expert about 45 actions. Segments that an expert may label end at 80, because all of a failed
# segment is labeled. A Q-function gets more time: waiting for the skull to go is better than dying by it.
LEAN = Preset(
    warm_start=5,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.0, termination_threshold=0.9), h_hi=6, h_lo=80, h_lo_hybrid=200),
    training=Training(
        network=NetworkSpec((Convolution(16, 6, 4), Convolution(32, 3, 2)), hidden=128),
        train_hi=_SMALL,
        train_lo=_SMALL_LO,
        train_flat=_SMALL_LO,
        train_hi_hybrid=_SMALL,
        dqn=DqnSpec(
            batch=32,
            update_every=1,
            discount=0.99,
            ahead=10,
            target_every=500,
            least=500,
            # One random action can be the figure's death, so attempts succeed often only if such actions are rare.
            epsilon=((0, 0.3), (3_000, 0.05), (8_000, 0.01), (12_000, 0.002)),
            pseudo=PseudoReward(reached=1.0, failed=-0.5, step=0.0),
            stop_above=0.9,
            margin=0.2,
            symmetries=False,
            bf16=False,
        ),
        from_passed=True,
    ),
    use=DomainUse(views=True, centered=True),
    warm_start_hybrid=10,
    monitoring=Monitoring(share=0.05),
)

PAPER = Preset(
    warm_start=0,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.0, termination_threshold=0.9), h_hi=4),
    training=Training(
        network=NetworkSpec(
            (Convolution(32, 8, 4), Convolution(64, 4, 2), Convolution(64, 3)), hidden=512, hidden_std=0.01, scale=255
        ),
        train_hi=TrainSpec(dropout=0.0),
        train_lo=TrainSpec(dropout=0.0),
        train_flat=TrainSpec(dropout=0.0),
        train_hi_hybrid=TrainSpec(dropout=0.0, least=128, most=512),
        dqn=DqnSpec(
            learning_rate=1e-4,
            optimizer="rmsprop",
            batch=128,
            discount=0.99,
            terminal="episode",
            target_every=500,  # 2,000 steps, as an update comes every fourth
            beta_updates=125_000,
            capacity=500_000,
            least=20_000,
            epsilon=((0, 1.0), (200_000, 0.02)),
            pseudo=PseudoReward(reached=1.0, failed=-1.0, step=0.0),
            from_success=True,
            stop_above=0.9,
            relearn=False,
            symmetries=False,
            bf16=False,  # a step more costs 1 % of a value (the discount), which bf16 hardly resolves
        ),
        dqn_of={"stair": {"least": 1_000, "target_every": 250, "epsilon": ((0, 1.0), (50_000, 0.02))}},
    ),
)
