"""Defines the interface of a domain, for authors of plug-ins.

Waypost finds domains through the entry-point group `waypost.domains`. A domain supplies a gymnasium environment, names
of subgoals and actions, horizons, and JSON views of instances and states. It can also supply an oracle of five
functions; `waypost_learner.experts.oracle` answers all six queries of the paper with them. The smallest complete
example is `waypost_learner.domains.corridor`.
"""

from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass
from importlib.metadata import entry_points
from typing import Any, Protocol, runtime_checkable

import gymnasium
import numpy as np
from numpy.typing import NDArray

from waypost.trajectory import Action, Outcome, Segment, Subgoal, Trajectory


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


@dataclass(frozen=True)
class Symmetry:
    """A transformation of observations, subgoals and actions that keeps labels correct, such as a rotation."""

    observe: Callable[[NDArray[np.float32]], NDArray[np.float32]]  # returns the transformed observation
    subgoals: tuple[Subgoal, ...]  # for each subgoal, the transformed one
    actions: tuple[Action, ...]  # for each action, the transformed one


@dataclass(frozen=True)
class Grid:
    """Where a view shows places and where each choice leads, so that a network can plan paths over places."""

    patch: int  # side of the square that shows one place, in pixels
    stride: int  # distance from one place to the next, in pixels
    # For each choice, the move (down, right) in places. None, only for the last choice, means that it ends the path.
    moves: tuple[tuple[int, int] | None, ...]


@dataclass(frozen=True)
class View:
    """The part of an observation that a policy sees: everything that its choices depend on, centered on the agent."""

    shape: tuple[int, ...]  # of the view, such as (channels, rows, columns)
    observe: Callable[[NDArray[np.float32]], NDArray[np.float32]]  # returns the view of an observation
    grid: Grid | None = None  # the places in the view; the agent's place is in the middle


class Oracle(Protocol):
    """The computed expert of a domain. It needs only JSON views, so it can answer in any process.

    `instance`, `origin` and `state` are JSON views. `origin` is the state in which the subgoal was chosen.
    """

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[Subgoal]:
        """Return mu*(s): every optimal subgoal in `state`, the preferred one first."""

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Sequence[Action]:
        """Return pi*_g(s): every optimal action in `state` toward `subgoal`, the preferred one first."""

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> bool:
        """Return beta*_g(s): whether `subgoal` is accomplished in `state`."""

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the whole task is accomplished in `state`."""

    def successor(self, instance: Any, state: Any, action: Action) -> Any:
        """Return the view of the state after `action`."""


class Domain(Protocol):
    """A domain. Subgoals and actions are numbers; their names are in `subgoals` and `actions`, in this order."""

    name: str
    subgoals: tuple[str, ...]
    actions: tuple[str, ...]
    renderer: str  # the renderer of the web app
    horizons: Horizons
    observation_shape: tuple[int, ...]
    symmetries: tuple[Symmetry, ...]  # without the identity
    oracle: Oracle | None  # None if people must answer

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

    def outcome(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Outcome | None:
        """Return whether `subgoal`, chosen in `origin`, was reached or has failed in `state`; None if it has not ended.

        Only reinforcement learning of subpolicies uses this function (Algorithm 3): it defines terminal(s; g),
        success(s; g) and the pseudo-reward. `origin` and `state` are JSON views.
        """


Relabeled = tuple[NDArray[np.float32], Subgoal]
"""An observation and a good subgoal for it."""


@runtime_checkable
class Pictured(Protocol):
    """A domain with pictures of its states. The web app shows them if it has no renderer for the domain."""

    def frame(self, env: gymnasium.Env[Any, Any]) -> NDArray[np.uint8]:
        """Return a picture of the current state of `env`, uint8[rows, columns, 3], at most 4,096 pixels per side."""


@runtime_checkable
class Structured(Protocol):
    """A domain that also describes its structure to the learner. The preset defines which parts a learner uses."""

    hi_view: View  # for choosing subgoals
    lo_view: View  # for choosing actions and terminations toward a subgoal
    flat_view: View  # for choosing actions without subgoals

    def place(self, state: Any) -> Hashable:
        """Return the place of a state, such as its room; `state` is a JSON view.

        The repeat penalty discourages the learner from choosing the same subgoal in the same place again.
        """

    def relabeled(self, trajectory: Trajectory, good_subgoals: Sequence[Subgoal]) -> Iterable[Relabeled]:
        """Return labels of other tasks that follow from the HI labels of a trajectory.

        These tasks begin and end elsewhere on its path. The function may assume more than Algorithm 2, for example
        that paths are reversible.
        """

    def retraced(self, demonstration: Trajectory) -> Iterable[Segment]:
        """Return segments of other tasks that follow from a demonstration, as an expert would execute them.

        The function may make the same assumptions as `relabeled`.
        """


def find_domain(name: str) -> Domain:
    """Return the domain with this name.

    Raises:
        ValueError: no installed domain has this name; the message lists the installed domains.
    """
    found = {entry.name: entry for entry in entry_points(group="waypost.domains")}
    if name not in found:
        raise ValueError(f"there is no domain {name!r}; the installed domains are: {', '.join(sorted(found))}")
    domain: Domain = found[name].load()()
    return domain
