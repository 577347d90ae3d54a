"""The levels of what a learner is told of its domain (`--told`), from nothing to all that the domain declares."""

from dataclasses import replace

from waypost_learner.policies.domain_use import NOTHING_DECLARED, DomainUse
from waypost_learner.policies.exploration import ExplorationSpec
from waypost_learner.presets.base import Preset

_SYMMETRIES = DomainUse(symmetries=True, tied=True)
_CENTERED = replace(_SYMMETRIES, centered=True)
_CROP = replace(_CENTERED, crop=True)

LEVELS = {"nothing": NOTHING_DECLARED, "symmetries": _SYMMETRIES, "centered": _CENTERED, "crop": _CROP}
"""The levels below `structure`, each with what is used of the domain: at each, also everything of the level before it.

- `nothing`: the observation.
- `symmetries`: under which changes of an observation labels stay right.
- `centered`: where the agent is. Every policy sees the observation with the agent in the middle.
- `crop`: which part of it matters for actions toward a subgoal.
"""
STRUCTURE = "structure"
"""The highest level: everything that the preset uses of what the domain declares."""


def told_at_most(preset: Preset, level: str) -> Preset:
    """Return the preset with what a level allows of the domain's declarations.

    Raises:
        ValueError: no level has this name; the message lists the names.
    """
    if level == STRUCTURE:
        return preset
    if level not in LEVELS:
        raise ValueError(f"there is no level {level!r} of what a learner is told; use {', '.join(LEVELS)}, {STRUCTURE}")
    dqn = replace(preset.training.dqn, symmetries=LEVELS[level].symmetries, exploration=ExplorationSpec())
    return replace(
        preset,
        use=LEVELS[level],
        rollouts=replace(preset.rollouts, repeat_penalty=0.0),  # it needs to know places, like exploration
        training=replace(preset.training, dqn=dqn),
    )


def level_of(preset: Preset, q_functions: bool) -> str:
    """Return the lowest level that allows what a preset uses of the domain's declarations.

    Args:
        preset: the preset.
        q_functions: whether the learner has Q-functions, which may learn experience in every symmetry.
    """
    used = preset.use
    if q_functions and preset.training.dqn.symmetries:
        used = replace(used, symmetries=True)
    if preset.training.fields is not None and preset.training.fields.reach is not None:
        used = replace(used, crop=True)  # how far away subgoals end: how much around the agent matters
    for level, allowed in LEVELS.items():
        within = all(not value or value == vars(allowed)[name] for name, value in vars(used).items())
        if within and not _uses_places(preset, q_functions):
            return level
    return STRUCTURE


def _uses_places(preset: Preset, q_functions: bool) -> bool:
    training = preset.training
    explores = training.dqn.exploration.wander or any("exploration" in one for one in training.dqn_of.values())
    return preset.rollouts.repeat_penalty > 0 or bool(q_functions and explores)


def refuse_more_than(level: str, preset: Preset) -> None:
    """Refuse a preset whose values use more of the domain's declarations than a level allows.

    Raises:
        ValueError: they use more; the message says what to write instead.
    """
    levels = [*LEVELS, STRUCTURE]
    used = level_of(preset, q_functions=True)
    if levels.index(used) > levels.index(level):
        raise ValueError(
            f"--values uses more of the domain than --told {level} allows: leave these values out, "
            f"or write --told {used}"
        )
