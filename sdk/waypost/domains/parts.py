"""Defines what a domain may provide beside `Domain`: an expert, pictures, ways to replay, and structure.

Each part is a small protocol. A domain provides a part if it has the members of the protocol. Where a run would use a
part that the domain does not provide, `waypost train` says so and the run's configuration keeps what was used instead.
"""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, Protocol, get_args, runtime_checkable

import gymnasium
import numpy as np
from numpy.typing import NDArray

from waypost.domains.contract import Domain
from waypost.trajectory import Action, Observation, Outcome, Segment, Subgoal, Trajectory

# --- the expert


class Oracle(Protocol):
    """The computed expert of a domain. It needs only JSON views, so it can answer in any process.

    `instance`, `origin` and `state` are JSON views. `origin` is the state in which the subgoal was chosen.
    """

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[Subgoal]:
        """Return mu*(s): every optimal subgoal in `state`, the preferred one first."""

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Sequence[Action]:
        """Return pi*_g(s): every optimal action in `state` toward `subgoal`, the preferred one first.

        The sequence is empty where nothing helps anymore, such as in a fall.
        """

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> bool:
        """Return beta*_g(s): whether `subgoal` is accomplished in `state`."""

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the whole task is accomplished in `state`."""


@runtime_checkable
class Predicting(Protocol):
    """An oracle that knows which state follows an action. It can give a demonstration without an environment."""

    def successor(self, instance: Any, state: Any, action: Action) -> Any:
        """Return the view of the state after `action`."""


@runtime_checkable
class Solved(Protocol):
    """A domain with an oracle. Without one, people must answer."""

    oracle: Oracle | None


@runtime_checkable
class Reopened(Protocol):
    """A domain whose instances can be made from their JSON views. Its oracle can give demonstrations by acting."""

    def instance_from(self, view: Any) -> Any:
        """Return the instance that `instance_view` showed as `view`."""


@runtime_checkable
class Computed(Protocol):
    """A domain whose oracle looks up data that was computed once (`waypost domain build`)."""

    def build(self, file: Path, progress: Callable[[str, int, int], None]) -> None:
        """Compute the data and write it to a file.

        Args:
            file: the file to write.
            progress: to be called with what is being computed, how much of it is done, and how much there is.
        """


# --- what people see


@runtime_checkable
class Pictured(Protocol):
    """A domain with pictures of its states. The web app shows them if it has no renderer for the domain."""

    def frame(self, env: gymnasium.Env[Any, Any]) -> NDArray[np.uint8]:
        """Return a picture of the current state of `env`, uint8[rows, columns, 3], at most 4,096 pixels per side."""


Box = tuple[float, float, float, float]
"""The left, upper, right and lower side of a box in a picture, as shares of its width and height: 0 to 1."""


@runtime_checkable
class Landmarked(Protocol):
    """A domain whose pictures show where subgoals are. The web app frames them, and a click there chooses one."""

    def landmarks(self, instance: Any, state: Any) -> Mapping[Subgoal, Box]:
        """Return the boxes of the subgoals that have a place in the picture of a state; both are JSON views."""


@runtime_checkable
class ActionLandmarked(Protocol):
    """A domain whose pictures show where actions lead. A click there in the web app chooses the action."""

    def action_landmarks(self, instance: Any, state: Any) -> Mapping[Action, Box]:
        """Return the boxes of the actions that lead to a place in the picture of a state; both are JSON views.

        Leave out actions that have no place, or that are never right there: a box that says little is in the way.
        """


@runtime_checkable
class Rendered(Protocol):
    """A domain that the web app draws itself."""

    renderer: str  # the name of the renderer in the web app


# --- how a trajectory is carried out again

Replay = Literal["actions", "snapshots", "recorded"]
"""How to return to a state of a past trajectory. It is needed for pictures, and for demonstrations in the web app.

- "actions": carry out the same actions on the same instance again. The environment must then do the same.
- "snapshots": restore a snapshot of the environment (`Restorable`). The environment may be random.
- "recorded": the environment cannot return. Pictures are taken while the learner acts.
"""


@runtime_checkable
class Replayed(Protocol):
    """A domain that says how its trajectories are carried out again. Without this part it is by "actions"."""

    replay: Replay


@runtime_checkable
class Restorable(Protocol):
    """A domain whose environments can return to an earlier state."""

    def snapshot(self, env: gymnasium.Env[Any, Any]) -> Any:
        """Return the whole state of `env`."""

    def restore(self, env: gymnasium.Env[Any, Any], snapshot: Any) -> None:
        """Bring `env` to the state of a snapshot. It may come from another environment of the same instance."""


# --- how subgoals end, for reinforcement learning


@runtime_checkable
class Ending(Protocol):
    """A domain that says how subgoals end. Reinforcement learning of subpolicies needs it (Algorithm 3)."""

    def outcome(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Outcome | None:
        """Return whether `subgoal`, chosen in `origin`, was reached or has failed in `state`; None if it has not ended.

        It defines terminal(s; g), success(s; g) and the pseudo-reward. `origin` and `state` are JSON views.
        """


# --- how often to test


@runtime_checkable
class Tested(Protocol):
    """A domain that says how often to test the policies. Without this part there is a test after every episode."""

    test_every: int  # episodes from one test rollout to the next


# --- structure


@dataclass(frozen=True)
class Symmetry:
    """A transformation of observations, subgoals and actions that keeps labels correct, such as a rotation."""

    observe: Callable[[Any], Any]  # maps an observation to the transformed one
    subgoals: tuple[Subgoal, ...]  # for each subgoal, the transformed one
    actions: tuple[Action, ...]  # for each action, the transformed one


@dataclass(frozen=True)
class Grid:
    """Where a view shows places and where each choice leads, so that a network can plan paths over places."""

    patch: int  # side of the square that shows one place, in pixels
    stride: int  # distance from one place to the next, in pixels
    # For each choice, the move (down, right) in places. None, only for the last choice, means that it ends the path.
    moves: tuple[tuple[int, int] | None, ...]
    # The channel whose highest value is where the agent is; None: the agent's place is in the middle of the view.
    agent: int | None = None


@dataclass(frozen=True)
class View:
    """The part of an observation that a policy sees: everything that its choices depend on, centered on the agent."""

    shape: tuple[int, ...]  # of the view, such as (channels, rows, columns)
    observe: Callable[[Any], Any]  # returns the view of an observation
    grid: Grid | None = None  # the places in the view


@runtime_checkable
class Symmetric(Protocol):
    """A domain with symmetries."""

    symmetries: tuple[Symmetry, ...]  # without the identity


@runtime_checkable
class Viewed(Protocol):
    """A domain that says which part of an observation each policy needs."""

    hi_view: View  # for choosing subgoals
    lo_view: View  # for choosing actions and terminations toward a subgoal
    flat_view: View  # for choosing actions without subgoals


@runtime_checkable
class Gridded(Protocol):
    """A domain whose whole observations show places, over which a flat policy plans instead of those of its view."""

    flat_grid: Grid  # with the agent's channel


@runtime_checkable
class Centered(Protocol):
    """A domain that knows where the agent is in an observation."""

    centered_view: View  # with the agent in the middle


@runtime_checkable
class Cropped(Protocol):
    """A domain that knows how much around the agent matters for the actions toward a subgoal."""

    crop_view: View  # for choosing actions and terminations toward a subgoal, with the agent in the middle


@runtime_checkable
class Placed(Protocol):
    """A domain whose states have places."""

    def place(self, state: Any) -> Hashable:
        """Return the place of a state, such as its room; `state` is a JSON view.

        The repeat penalty discourages the learner from choosing the same subgoal in the same place again. Q-functions
        that explore go back to places where they seldom were.
        """


Relabeled = tuple[Observation, Subgoal]
"""An observation and a good subgoal for it."""

FlatRelabeled = tuple[Observation, Action]
"""An observation and a good action for it, toward the task's end."""


@runtime_checkable
class Relabeling(Protocol):
    """A domain in which labels of one task give labels of other tasks."""

    def relabeled(self, trajectory: Trajectory, good_subgoals: Sequence[Subgoal]) -> Iterable[Relabeled]:
        """Return labels of other tasks that follow from the HI labels of a trajectory.

        These tasks begin and end elsewhere on its path. The function may assume more than Algorithm 2, for example
        that paths are reversible.
        """


@runtime_checkable
class Retracing(Protocol):
    """A domain in which demonstrations of one task give demonstrations of other tasks."""

    def retraced(self, demonstration: Trajectory) -> Iterable[Segment]:
        """Return segments of other tasks that follow from a demonstration, as an expert would execute them.

        The function may make the same assumptions as `relabeled`.
        """


@runtime_checkable
class FlatRelabeling(Protocol):
    """A domain in which a flat learner's labels of one task give labels of other tasks."""

    def relabeled_actions(self, trajectory: Trajectory, good_actions: Sequence[Action]) -> Iterable[FlatRelabeled]:
        """Return labels of other tasks that follow from the labels of a full trajectory.

        The function may make the same assumptions as `relabeled`.
        """


# --- the parts of a domain, with what holds without them


def oracle_of(domain: Domain) -> Oracle | None:
    """Return the domain's oracle; None if people must answer."""
    return domain.oracle if isinstance(domain, Solved) else None


def renderer_of(domain: Domain) -> str:
    """Return the name of the domain's renderer: its own name if it declares none."""
    return domain.renderer if isinstance(domain, Rendered) else domain.name


def replay_of(domain: Domain) -> Replay:
    """Return how trajectories of the domain are carried out again.

    Raises:
        ValueError: the domain declares a way that does not exist, or snapshots that it does not provide.
    """
    replay = domain.replay if isinstance(domain, Replayed) else "actions"
    if replay not in get_args(Replay):
        raise ValueError(f"replay is {replay!r}; it must be one of: {', '.join(get_args(Replay))}")
    if replay == "snapshots" and not isinstance(domain, Restorable):
        raise ValueError('replay is "snapshots", but the domain has no functions snapshot(env) and restore(env, ...)')
    return replay


def symmetries_of(domain: Domain) -> tuple[Symmetry, ...]:
    """Return the domain's symmetries, without the identity."""
    return domain.symmetries if isinstance(domain, Symmetric) else ()


def interval_of_tests(domain: Domain) -> int:
    """Return the number of episodes from one test rollout to the next."""
    return domain.test_every if isinstance(domain, Tested) else 1
