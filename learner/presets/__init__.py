"""Presets: every value that fixes how a run learns, in one readable file each."""

from learner.presets.base import Preset
from learner.presets.demo import DEMO
from learner.presets.paper import PAPER

PRESETS = {"demo": DEMO, "paper": PAPER}


def find_preset(name: str) -> Preset:
    """Return a preset.

    Raises:
        ValueError: there is none of that name; the message lists those that exist.
    """
    if name not in PRESETS:
        raise ValueError(f"there is no preset {name!r}; those that exist are: {', '.join(sorted(PRESETS))}")
    return PRESETS[name]
