"""The queries of the algorithms: the paper's six verbs (section 3).

An algorithm yields a query and receives an answer of the type that the query's docstring names. It does not know who
answers, where, or at what price.
"""

from dataclasses import dataclass

from waypost.trajectory import Action, Segment, State, Subgoal, Trajectory
from waypost_learner.policies.labels import LoLabels


@dataclass(frozen=True)
class HierDemo:
    """HierDemo(s): the expert's own hierarchical trajectory from s. Answer: `Trajectory`.

    If `flat`, it is one segment without a subgoal. If s is not the start of the episode, it comes after the segments
    `before`. There are at most `max_segments`, each of at most H_LO actions; H_HI, of any length, if None.
    """

    state: State
    flat: bool = False
    before: Trajectory = ()
    max_segments: int | None = None


@dataclass(frozen=True)
class InspectFull:
    """Inspect_FULL(tau_FULL): was the overall goal accomplished? Answer: `bool`, True for Pass."""

    trajectory: Trajectory


@dataclass(frozen=True)
class LabelHi:
    """Label_HI(tau_HI): a good subgoal at each s_h. Answer: `tuple[Subgoal, ...]`.

    Where the learner's own choice is as good as the best, the expert returns it. The trajectory is an episode from its
    start, or a part of one that comes after the segments `before`.
    """

    trajectory: Trajectory
    before: Trajectory = ()


@dataclass(frozen=True)
class InspectLo:
    """Inspect_LO(tau; g): did the segment accomplish its subgoal? Answer: `bool`, True for Pass."""

    segment: Segment
    before: Trajectory = ()


@dataclass(frozen=True)
class LabelLo:
    """Label_LO(tau; g): a good action and termination at each state of the segment. Answer: `LoLabels`."""

    segment: Segment
    before: Trajectory = ()


@dataclass(frozen=True)
class LabelFull:
    """Label_FULL(tau_FULL): a good action at each state. Answer: `tuple[Action, ...]`."""

    trajectory: Trajectory


Query = HierDemo | InspectFull | LabelHi | InspectLo | LabelLo | LabelFull
Answer = bool | tuple[Subgoal, ...] | tuple[Action, ...] | LoLabels | Trajectory
