"""What an algorithm can ask: the paper's six verbs (section 3), and what comes back.

An algorithm yields one of these and receives the answer named in its docstring. Who answers, where, and what it costs
is none of its business.
"""

from dataclasses import dataclass

from waypost.trajectory import Action, Segment, State, Subgoal, Trajectory
from waypost_learner.policies.datasets import LoLabels


@dataclass(frozen=True)
class HierDemo:
    """HierDemo(s): the expert's own hierarchical trajectory from s. Answer: `Trajectory`.

    For a flat learner it is one segment without a subgoal.
    """

    state: State
    flat: bool = False


@dataclass(frozen=True)
class InspectFull:
    """Inspect_FULL(tau_FULL): was the overall goal accomplished? Answer: `bool`, True for Pass."""

    trajectory: Trajectory


@dataclass(frozen=True)
class LabelHi:
    """Label_HI(tau_HI): a good subgoal at each s_h. Answer: `tuple[Subgoal, ...]`.

    An expert returns the learner's own choice where it is as good as any. Of an episode from its start, or of a part,
    with what came `before`.
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
