"""Finds presets by name, and replaces single values of a preset by name. Each preset has its own file."""

import json
from dataclasses import asdict, is_dataclass, replace
from typing import Any, get_type_hints

from pydantic import TypeAdapter, ValidationError

from waypost_learner.presets import montezuma
from waypost_learner.presets.base import Preset, groups_by_value, value_of
from waypost_learner.presets.general import GENERAL
from waypost_learner.presets.lean import LEAN
from waypost_learner.presets.paper import PAPER
from waypost_learner.presets.told import refuse_more_than, told_at_most

Changes = dict[str, "str | Changes"]
"""New values as JSON texts, by name; values of a group are nested."""

PRESETS = {"lean": LEAN, "paper": PAPER, "general": GENERAL}
PRESETS_OF = {("montezuma", "lean"): montezuma.LEAN, ("montezuma", "paper"): montezuma.PAPER}
"""The presets of single domains, by domain and name, where they differ from `PRESETS`."""


def find_preset(name: str, values: str | None = None, domain: str | None = None, told: str | None = None) -> Preset:
    """Return a preset in which `values`, such as "relabeling=false train_hi.batch=32", replace its own values.

    Args:
        name: the preset's name.
        values: the values to replace; none if None.
        domain: the name of the domain, which may have its own preset of this name.
        told: the level of what the learner is told (`waypost_learner.presets.told`); what the preset uses if None.

    Raises:
        ValueError: no preset, value or level has this name (the message lists the names), a text is no value of its
            type, the values contradict each other, or they use more of the domain than the level allows.
    """
    if name not in PRESETS:
        raise ValueError(f"there is no preset {name!r}; the presets are: {', '.join(sorted(PRESETS))}")
    preset = PRESETS_OF.get((domain or "", name), PRESETS[name])
    if told is not None:
        preset = told_at_most(preset, told)
    groups = groups_by_value(preset)
    new: dict[str, Any] = {}
    for value, text in parse_values(values).items():
        if value in groups:
            owner = getattr(preset, groups[value]) if groups[value] else preset
            new[value] = _changed(value, get_type_hints(type(owner))[value], value_of(preset, value), text)
        else:
            new[value] = None  # `with_values` refuses it and lists the names
    preset = preset.with_values(**new)
    if told is not None:
        refuse_more_than(told, preset)
    return preset


def parse_values(values: str | None) -> Changes:
    """Return the assignments in a text such as "relabeling=false train_hi.batch=32", nested by their names.

    Raises:
        ValueError: a name is given both as a value and as a group of values.
    """
    changes: Changes = {}
    for assignment in (values or "").split():
        path, _, text = assignment.partition("=")
        *groups, last = path.split(".")
        into = changes
        for group in groups:
            below = into.setdefault(group, {})
            if isinstance(below, str):
                raise ValueError(f"{group!r} is given twice, as a value and as a group of values")
            into = below
        into[last] = text
    return changes


def _changed(name: str, of: Any, before: Any, change: str | Changes) -> Any:
    """Return the new value of a name: parsed from JSON, or a group with some of its values replaced."""
    if is_dataclass(before) != isinstance(change, dict):
        raise ValueError(f"{name!r} is {'a group of values' if is_dataclass(before) else 'no group of values'}")
    if isinstance(change, str):
        return _parsed(name, of, before, change)
    types = get_type_hints(type(before))
    unknown = [value for value in change if value not in types]
    if unknown:
        raise ValueError(f"there is no value {unknown[0]!r}; the values are: {', '.join(types)}")
    return replace(
        before,
        **{one: _changed(f"{name}.{one}", types[one], getattr(before, one), text) for one, text in change.items()},
    )


def _parsed(name: str, of: Any, before: Any, text: str) -> Any:
    try:
        return TypeAdapter(of).validate_json(text, strict=True)
    except ValidationError:
        example = f"write {name}=VALUE, a JSON value such as {json.dumps(before, default=asdict)}"
        raise ValueError(f"{text!r} is no value for {name!r}: {example}") from None
