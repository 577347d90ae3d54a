"""Defines the values of a preset, in groups, and how to replace single values by name."""

from dataclasses import dataclass, field, fields, replace
from typing import Any

from pydantic import TypeAdapter, ValidationError

from waypost_learner.gates.gate import LAZY, GateSpec
from waypost_learner.policies.domain_use import NOTHING_DECLARED, DomainUse
from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.fields.field_net import FieldSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.networks import NetworkSpec
from waypost_learner.presets.monitoring import EVERY_EPISODE, Monitoring
from waypost_learner.rollout.rollout import RolloutSpec


@dataclass(frozen=True)
class Training:
    """The networks and how each of them is trained."""

    network: NetworkSpec  # of policies that do not plan
    train_hi: TrainSpec  # of mu
    train_lo: TrainSpec  # of each pi_g
    train_flat: TrainSpec  # of a flat policy
    train_hi_hybrid: TrainSpec  # of mu where each pi_g is a Q-function, which takes many more episodes
    dqn: DqnSpec  # of Q-functions
    # One network for all policies instead, if all imitate and observations are pictures; one for each if None.
    fields: FieldSpec | None = None
    train_shared: TrainSpec = field(default_factory=TrainSpec)  # of that network
    # Whether pi_g and flat policies imitate what they did themselves where the expert passed it. This costs nothing.
    from_passed: bool = False
    # Other values of the Q-functions of single subgoals, by the subgoal's name, such as {"stair": {"least": 1000}}.
    dqn_of: dict[str, dict[str, Any]] = field(default_factory=dict)

    def dqn_for(self, subgoal: str | None) -> DqnSpec:
        """Return the values of a subgoal's Q-function, or of the others if None.

        Raises:
            ValueError: `dqn_of` has a name that is no value of a Q-function, or a value of another type.
        """
        changes = self.dqn_of.get(subgoal or "", {})
        unknown = changes.keys() - vars(self.dqn).keys()
        try:
            if not unknown:
                return TypeAdapter(DqnSpec).validate_python({**vars(self.dqn), **changes})
        except ValidationError as error:
            raise ValueError(f"dqn_of gives {subgoal!r} a value of a wrong type: {changes}") from error
        raise ValueError(f"a Q-function has no value {min(unknown)!r}; the values are: {', '.join(vars(self.dqn))}")


@dataclass(frozen=True)
class Preset:
    """The values of a run. Names of values are unique across the groups `rollouts`, `training` and `use`."""

    warm_start: int  # episodes of demonstrations before an interactive algorithm begins
    warm_start_hybrid: int = field(default=0, kw_only=True)  # the same where each pi_g is a Q-function
    rollouts: RolloutSpec
    training: Training
    use: DomainUse = NOTHING_DECLARED  # what is used of the domain's declarations
    monitoring: Monitoring = EVERY_EPISODE  # which episodes the expert inspects
    gate: GateSpec = LAZY  # what hg-gated asks

    def with_values(self, **values: Any) -> "Preset":
        """Return the preset with other values, given by name, such as `with_values(relabeling=False)`.

        Raises:
            ValueError: no value has this name, or the values contradict each other.
        """
        groups = groups_by_value(self)
        changes: dict[str, dict[str, Any]] = {}
        for name, value in values.items():
            if name not in groups:
                raise ValueError(f"there is no value {name!r}; the values are: {', '.join(groups)}")
            changes.setdefault(groups[name], {})[name] = value
        top = changes.pop("", {})
        return replace(self, **top, **{group: replace(getattr(self, group), **new) for group, new in changes.items()})


_GROUPS = ("rollouts", "training", "use")


def groups_by_value(preset: Preset) -> dict[str, str]:
    """Return the group of each value by the value's name; "" for values of the preset itself."""
    found: dict[str, str] = {}
    for one in fields(preset):
        if one.name in _GROUPS:
            found |= {value.name: one.name for value in fields(getattr(preset, one.name))}
        else:
            found[one.name] = ""
    return found


def value_of(preset: Preset, name: str) -> Any:
    """Return the value with this name, from any group."""
    group = groups_by_value(preset)[name]
    return getattr(getattr(preset, group) if group else preset, name)
