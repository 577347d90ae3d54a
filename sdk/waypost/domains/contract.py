"""Defines what every domain provides. Everything else that a domain may provide is in `parts`.

`waypost.domain(...)` makes a domain from a Gymnasium environment. A class with these members is a domain too.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import gymnasium
import numpy as np


@dataclass(frozen=True)
class Horizons:
    """The maximum lengths H_LO, H_HI and H_FULL."""

    lo: int  # actions in a segment
    hi: int  # segments in a hierarchical trajectory
    full: int  # actions in an episode


@dataclass(frozen=True)
class InstanceSets:
    """Environment instances for training, and unseen ones for tests."""

    train: Sequence[Any]
    test: Sequence[Any]
    vary: Callable[[Any, np.random.Generator], Any] | None = (
        None  # applied to a training instance each time it is drawn
    )


@runtime_checkable
class Domain(Protocol):
    """A domain. Subgoals and actions are numbers; their names are in `subgoals` and `actions`, in this order."""

    name: str
    subgoals: tuple[str, ...]
    actions: tuple[str, ...]
    horizons: Horizons
    observation_shape: tuple[int, ...]  # (channels, rows, columns) of pictures, (features,) of vectors

    def make_env(self) -> gymnasium.Env[Any, Any]:
        """Return a new environment; `reset(options={"instance": instance})` starts a given instance."""

    def instances(self, name: str) -> InstanceSets:
        """Return the set of instances with this name, or the instances of a file.

        Raises:
            ValueError: the name is unknown, or the file is not valid; the message lists the known names.
        """

    def instance_view(self, instance: Any) -> Any:
        """Return the JSON view of an instance."""

    def state_view(self, env: gymnasium.Env[Any, Any]) -> Any:
        """Return the JSON view of the current state of `env`."""

    def succeeded(self, env: gymnasium.Env[Any, Any]) -> bool:
        """Return whether the task is accomplished in the current state of `env`."""


MEMBERS = (
    "name",
    "subgoals",
    "actions",
    "horizons",
    "observation_shape",
    "make_env",
    "instances",
    "instance_view",
    "state_view",
    "succeeded",
)
"""The members of a `Domain`."""
