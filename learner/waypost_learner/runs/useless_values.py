"""Refuse values that a user sets with `--values` and that the run would ignore."""

from collections.abc import Iterator
from typing import Any

from waypost.domains import Centered, Cropped, FlatRelabeling, Placed, Relabeling, Retracing, Viewed, symmetries_of
from waypost_learner.algorithms import ALGORITHMS, Algorithm
from waypost_learner.algorithms.learner import Learner
from waypost_learner.policies.planning import PlanningSpec
from waypost_learner.presets import Changes, parse_values
from waypost_learner.presets.base import value_of
from waypost_learner.runs.config import TrainConfig

_SWITCHES = frozenset(
    {
        "centered",
        "crop",
        "from_passed",
        "h_hi",
        "h_hi_tests",
        "h_lo",
        "h_lo_hybrid",
        "planning",
        "relabeling",
        "repeat_penalty",
        "symmetries",
        "tied",
        "views",
        "monitoring.share",
    }
)
"""Values that may be set to false, 0 or null even if they have no effect."""


def refuse_useless_values(config: TrainConfig, algorithm: Algorithm, learner: Learner) -> None:
    """Refuse `--values` that have no effect with this algorithm, this domain and the other values.

    Raises:
        ValueError: a value has no effect; the message says why.
    """
    reasons = _reasons(config, algorithm, learner)
    for name in _leaves(parse_values(config.values)):
        reason = next((reasons[one] for one in _prefixes(name) if one in reasons), None)
        if reason is not None and not _is_off(name, learner):
            raise ValueError(f"{name} has no effect: {reason}; leave it out of --values")


def _reasons(config: TrainConfig, algorithm: Algorithm, learner: Learner) -> dict[str, str]:
    """Return why values have no effect here, by the name of a value or of a group of values."""
    name, monitored = config.algorithm, ", ".join(name for name, one in ALGORITHMS.items() if one.monitored)
    levels, domain, preset = algorithm.levels, learner.domain, learner.preset
    planned = {key for key in learner.learned if isinstance(learner.views[key].network, PlanningSpec)}
    hi = not (levels.flat or levels.q_hi)
    own = learner.shared is None  # whether each policy has its own network
    shared = "all policies share one network (fields)"
    checks = {
        "warm_start": (
            algorithm.interactive and not levels.q_lo,
            f"{name} has no warm start, or takes warm_start_hybrid",
        ),
        "warm_start_hybrid": (algorithm.interactive and levels.q_lo, f"{name} has no warm start, or takes warm_start"),
        "h_hi": (not levels.flat, f"{name} has no subgoals"),
        "h_hi_tests": (not levels.flat, f"{name} has no subgoals"),
        "h_lo": (
            not levels.flat and not (levels.q_lo and preset.rollouts.h_lo_hybrid),
            f"{name} has no subgoals, or takes h_lo_hybrid",
        ),
        "h_lo_hybrid": (levels.q_lo and not levels.flat, f"{name} has no Q-function of a subgoal"),
        "repeat_penalty": (
            not levels.flat and isinstance(domain, Placed),
            f"{name} has no subgoals, or the domain {domain.name!r} declares no places",
        ),
        "choosing": (levels.imitating, f"{name} chooses epsilon-greedily (dqn.epsilon)"),
        "choosing.termination_threshold": (not levels.flat and not levels.q_lo, f"{name} has no beta_g"),
        "fields": (
            not levels.reinforced and len(domain.observation_shape) == 3,
            f"{name} has a Q-function, or the domain {domain.name!r} shows no pictures",
        ),
        "train_shared": (not own, "its policies share no network (fields)"),
        "network": (own and planned < learner.learned.keys(), f"all its networks plan (planning), or {shared}"),
        "train_hi": (
            hi and own and not levels.q_lo,
            f"{name} has no mu that imitates, trains it with train_hi_hybrid, or {shared}",
        ),
        "train_hi_hybrid": (hi and levels.q_lo, f"{name} has no mu that imitates beside Q-functions"),
        "train_lo": (own and not levels.flat and not levels.q_lo, f"{name} has no pi_g that imitates, or {shared}"),
        "train_flat": (
            own and levels.flat and not levels.q_lo,
            f"{name} has no flat policy that imitates, or {shared}",
        ),
        "from_passed": (
            algorithm.monitored and not levels.q_lo,
            f"in {name} the expert passes nothing that a policy could imitate",
        ),
        "dqn": (levels.reinforced, f"{name} has no Q-function"),
        "dqn_of": (levels.q_lo and not levels.flat, f"{name} has no Q-function of a subgoal"),
        "dqn.exploration": (
            levels.q_lo and not levels.flat and isinstance(domain, Placed),
            f"{name} has no Q-function of a subgoal, or the domain {domain.name!r} declares no places",
        ),
        "dqn.discount_per": (levels.q_hi, f"{name} has no Q-function of a meta-controller"),
        "dqn.pseudo": (levels.q_lo and not levels.flat, f"{name} has no Q-function of a subgoal"),
        "symmetries": (
            bool(symmetries_of(domain)) and (levels.imitating or preset.use.tied),
            f"{name} has no policy that imitates, or the domain {domain.name!r} has no symmetries",
        ),
        "tied": (
            any(view.symmetry is not None for view in learner.views.values()),
            f"{name} has no subgoals, or none in the domain {domain.name!r} are equal up to a symmetry",
        ),
        "views": (own and isinstance(domain, Viewed), f"the domain {domain.name!r} declares no views, or {shared}"),
        "centered": (
            own and isinstance(domain, Centered) and ((levels.imitating and not levels.q_lo) or not preset.use.views),
            f"{name} has no policy that imitates actions, the domain {domain.name!r} declares no centered view, "
            f"or {shared}",
        ),
        "crop": (
            own and isinstance(domain, Cropped) and not levels.flat,
            f"{name} has no subgoals, or the domain {domain.name!r} declares no crop, or {shared}",
        ),
        "planning": (bool(planned), f"no policy of {name} has a view of the domain {domain.name!r} that shows places"),
        "relabeling": (
            levels.imitating and isinstance(domain, FlatRelabeling if levels.flat else Relabeling | Retracing),
            f"{name} has no policy that imitates, or the domain {domain.name!r} declares no relabeling for it",
        ),
        "monitoring": (
            algorithm.monitored and not config.redraw,
            f"only {monitored} are monitored, and only without --redraw",
        ),
        "gate": (algorithm.gated, f"{name} asks without a gate, unlike hg-gated"),
        "monitoring.rate": (preset.monitoring.share < 1, "monitoring.share is 1"),
        "monitoring.confidence": (preset.monitoring.share < 1, "monitoring.share is 1"),
    }
    return {value: reason for value, (has_effect, reason) in checks.items() if not has_effect}


def _leaves(changes: Changes, above: str = "") -> Iterator[str]:
    """Yield the full names of assigned values, such as "train_hi.batch"."""
    for name, change in changes.items():
        if isinstance(change, str):
            yield above + name
        else:
            yield from _leaves(change, f"{above}{name}.")


def _prefixes(name: str) -> Iterator[str]:
    """Yield "a", "a.b" and "a.b.c" of "a.b.c"."""
    words = name.split(".")
    return (".".join(words[:n]) for n in range(1, len(words) + 1))


def _is_off(name: str, learner: Learner) -> bool:
    first, *rest = name.split(".")
    value: Any = value_of(learner.preset, first)
    for word in rest:
        value = getattr(value, word)
    return name in _SWITCHES and not value
