"""How an attempt at a subgoal can begin: with given actions, before its policy chooses."""

from dataclasses import dataclass

from waypost.trajectory import Action


@dataclass(frozen=True)
class Lead:
    """The actions with which an attempt begins."""

    actions: tuple[Action, ...] = ()
    whole: bool = False  # whether they are the whole attempt, so that its policy never chooses


NO_LEAD = Lead()
