"""Presets: every value that fixes how a run learns, in one readable file each."""

import json
from dataclasses import fields, is_dataclass, replace
from typing import Any

from learner.presets.base import Preset
from learner.presets.demo import DEMO
from learner.presets.lean import LEAN
from learner.presets.paper import PAPER

PRESETS = {"demo": DEMO, "lean": LEAN, "paper": PAPER}


def find_preset(name: str, values: str | None = None) -> Preset:
    """Return a preset, with other values where some are given: "relabeling=false train_hi.batch=32".

    Raises:
        ValueError: there is no preset or no value of that name; the message lists those that exist.
    """
    if name not in PRESETS:
        raise ValueError(f"there is no preset {name!r}; those that exist are: {', '.join(sorted(PRESETS))}")
    changes: dict[str, Any] = {}
    for assignment in (values or "").split():
        path, _, text = assignment.partition("=")
        *groups, last = path.split(".")
        into: dict[str, Any] = changes
        for group in groups:
            into = into.setdefault(group, _Group())
            if not isinstance(into, _Group):
                raise ValueError(f"{group!r} is given twice, as a value and as a group of values")
        into[last] = _value(assignment, text)
    preset: Preset = _changed(PRESETS[name], changes)
    return preset


class _Group(dict[str, Any]):
    """Changes to a group of values."""


def _changed(spec: Any, changes: dict[str, Any]) -> Any:
    """Return a specification with these values replaced, all at once."""
    known = [field.name for field in fields(spec)]
    for name, value in changes.items():
        if name not in known:
            raise ValueError(f"there is no value {name!r}; those that exist are: {', '.join(known)}")
        before = getattr(spec, name)
        if is_dataclass(before) != isinstance(value, _Group):
            raise ValueError(f"{name!r} is {'a group of values' if is_dataclass(before) else 'no group of values'}")
        if isinstance(value, _Group):
            changes[name] = _changed(before, value)
        elif before is not None and value is not None and not isinstance(value, int | float | type(before)):
            raise ValueError(f"{name!r} is {before!r} in the preset; {value!r} cannot stand in its place")
    return replace(spec, **changes)


def _value(assignment: str, text: str) -> Any:
    try:
        value = json.loads(text)
    except json.JSONDecodeError:
        raise ValueError(f"{assignment!r} gives no value: write NAME=VALUE, as in relabeling=false") from None
    return tuple(value) if isinstance(value, list) else value
