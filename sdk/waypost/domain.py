"""What a domain brings, so that everything else works on it: the contract for plug-in authors.

A domain is found through the entry-point group `waypost.domains`. It supplies a gymnasium environment, its names and
horizons, JSON views of instances and states, and (optionally) an oracle of a few functions from which all six verbs of
the paper are derived (`learner/experts/oracle.py`). `learner/domains/corridor.py` is the smallest complete example.
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
    """The longest segment, hierarchical trajectory and episode (H_LO, H_HI, H_FULL)."""

    lo: int
    hi: int
    full: int


@dataclass(frozen=True)
class InstanceSets:
    """Environment instances to train on, and unseen ones to test on."""

    train: Sequence[Any]
    test: Sequence[Any]
    vary: Callable[[Any, np.random.Generator], Any] | None = None  # changes a training instance each time it is drawn


@dataclass(frozen=True)
class Symmetry:
    """A change of the picture under which labels stay right: what is north becomes east, and so on."""

    observe: Callable[[NDArray[np.float32]], NDArray[np.float32]]  # the changed observation
    subgoals: tuple[Subgoal, ...]  # what each subgoal becomes
    actions: tuple[Action, ...]  # what each action becomes


@dataclass(frozen=True)
class Grid:
    """How a picture shows places, so that ways through them can be planned."""

    patch: int  # pixels on a side of the square that shows one place
    stride: int  # pixels from one place to the next
    moves: tuple[
        tuple[int, int] | None, ...
    ]  # where each choice leads, in places (down, right); None, the last: it ends


@dataclass(frozen=True)
class View:
    """The part of an observation that a policy is given: what its choices depend on, from where it stands."""

    shape: tuple[int, ...]
    observe: Callable[[NDArray[np.float32]], NDArray[np.float32]]
    grid: Grid | None = None  # how it shows places; the agent's is in the middle


class Oracle(Protocol):
    """The computed expert of a domain. It sees JSON views only, so it can answer from anywhere."""

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[Subgoal]:
        """Return every optimal subgoal in `state`, the preferred one first."""

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Sequence[Action]:
        """Return every optimal action in `state` toward `subgoal`, chosen in `origin`, the preferred one first."""

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> bool:
        """Return whether `subgoal`, chosen in `origin`, is accomplished in `state`."""

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the whole task is accomplished in `state`."""

    def successor(self, instance: Any, state: Any, action: Action) -> Any:
        """Return the state after `action`."""


class Domain(Protocol):
    """A domain. `subgoals` and `actions` give the names; everywhere else they are numbers in that order."""

    name: str
    subgoals: tuple[str, ...]
    actions: tuple[str, ...]
    renderer: str
    horizons: Horizons
    observation_shape: tuple[int, ...]
    symmetries: tuple[Symmetry, ...]  # beside the identity; () if there are none
    oracle: Oracle | None

    def make_env(self) -> gymnasium.Env[Any, Any]:
        """Return a new environment; `reset(options={"instance": instance})` starts a given instance."""

    def instances(self, name: str) -> InstanceSets:
        """Return the instances called `name`, or those of a file.

        Raises:
            ValueError: no such set, or a file that is none; the message says what is wrong and what exists.
        """

    def instance_view(self, instance: Any) -> Any:
        """Return the JSON view of an instance."""

    def state_view(self, env: gymnasium.Env[Any, Any]) -> Any:
        """Return the JSON view of the state that `env` is in."""

    def succeeded(self, env: gymnasium.Env[Any, Any]) -> bool:
        """Return whether the task is accomplished in the state that `env` is in."""

    def outcome(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Outcome | None:
        """Return how `subgoal`, chosen in `origin`, has ended in `state`; None while it is under way.

        It is what reinforcement learning of subgoals is given (Algorithm 3): terminal(s; g), success(s; g), and from
        both the pseudo-reward. Origin and state are JSON views. Imitation does without: it learns terminations.
        """


Relabeled = tuple[NDArray[np.float32], Subgoal]
"""An observation, and a good subgoal there."""


@runtime_checkable
class Pictured(Protocol):
    """A domain that also brings pictures of its states, so that the page can show it without a renderer of its own."""

    def frame(self, env: gymnasium.Env[Any, Any]) -> NDArray[np.uint8]:
        """Return the picture of the state that `env` is in, uint8[rows, columns, 3]; at most 4,096 on a side."""


@runtime_checkable
class Structured(Protocol):
    """A domain that also tells a learner of its structure; the preset says how much of it a learner uses."""

    hi_view: View  # what subgoals are chosen by
    lo_view: View  # what actions and terminations toward a subgoal are chosen by
    flat_view: View  # what actions are chosen by without subgoals

    def place(self, state: Any) -> Hashable:
        """Return where a state is, as far as a choice of subgoals goes; `state` is its JSON view."""

    def relabeled(self, trajectory: Trajectory, good_subgoals: Sequence[Subgoal]) -> Iterable[Relabeled]:
        """Return what labels of a trajectory say of other tasks, begun and ended elsewhere on its way.

        It may assume what Algorithm 2 does not: that ways can be gone back, say.
        """

    def retraced(self, demonstration: Trajectory) -> Iterable[Segment]:
        """Return what a demonstration shows of other tasks: segments as an expert would carry them out.

        It may assume as much as `relabeled`.
        """


def find_domain(name: str) -> Domain:
    """Return the domain called `name`.

    Raises:
        ValueError: there is none; the message lists those that exist.
    """
    found = {entry.name: entry for entry in entry_points(group="waypost.domains")}
    if name not in found:
        raise ValueError(f"there is no domain {name!r}; installed are: {', '.join(sorted(found))}")
    domain: Domain = found[name].load()()
    return domain
