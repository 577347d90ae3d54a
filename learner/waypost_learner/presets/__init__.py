"""Presets: every value that fixes how a run learns, in one readable file each."""

import json
from dataclasses import is_dataclass, replace
from typing import Any, get_type_hints

from pydantic import TypeAdapter, ValidationError

from waypost_learner.presets.base import Preset
from waypost_learner.presets.lean import LEAN
from waypost_learner.presets.paper import PAPER

Changes = dict[str, "str | Changes"]
"""Values by name, as JSON, and groups of them."""

PRESETS = {"lean": LEAN, "paper": PAPER}


def find_preset(name: str, values: str | None = None) -> Preset:
    """Return a preset, with other values where some are given: "relabeling=false train_hi.batch=32".

    Raises:
        ValueError: there is no preset or no value of that name; the message lists those that exist.
    """
    if name not in PRESETS:
        raise ValueError(f"there is no preset {name!r}; those that exist are: {', '.join(sorted(PRESETS))}")
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
    preset: Preset = _changed(PRESETS[name], changes)
    return preset


def _changed(spec: Any, changes: Changes) -> Any:
    """Return a specification with these values replaced, all at once."""
    types = get_type_hints(type(spec))
    new: dict[str, Any] = {}
    for name, value in changes.items():
        if name not in types:
            raise ValueError(f"there is no value {name!r}; those that exist are: {', '.join(types)}")
        before = getattr(spec, name)
        if is_dataclass(before) != isinstance(value, dict):
            raise ValueError(f"{name!r} is {'a group of values' if is_dataclass(before) else 'no group of values'}")
        new[name] = _changed(before, value) if isinstance(value, dict) else _read(name, types[name], before, value)
    return replace(spec, **new)


def _read(name: str, of: Any, before: Any, text: str) -> Any:
    try:
        return TypeAdapter(of).validate_json(text, strict=True)
    except ValidationError:
        example = f"write {name}=VALUE, a JSON value as {json.dumps(before)} is"
        raise ValueError(f"{text!r} is no value for {name!r}: {example}") from None
