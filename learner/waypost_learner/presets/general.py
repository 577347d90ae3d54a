"""The preset `general`: one network for all policies, which is told nothing but the domain's symmetries.

docs/general.md says how it learns and what it reached.
"""

from dataclasses import replace

from waypost_learner.policies.domain_use import DomainUse
from waypost_learner.policies.fields.field_net import FieldSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.presets.lean import LEAN
from waypost_learner.rollout.rollout import RolloutSpec, SelectionSpec

GENERAL = replace(
    LEAN,
    warm_start=3,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.1, termination_threshold=0.5)),
    training=replace(
        LEAN.training,
        fields=FieldSpec(),
        train_shared=TrainSpec(
            1e-2,
            64,
            least=8 * 64,
            most=8 * 64,
            idle=120 * 64,
            dropout=0.0,
            weight_decay=0.01,
            averaging=0.99,
            bf16=False,
        ),
    ),
    use=DomainUse(symmetries=True),
)
