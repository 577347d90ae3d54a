"""The paper's four subgoals, in the order of the task, and when each is reached."""

from typing import Any

from waypost.trajectory import Subgoal
from waypost_learner.domains.montezuma import landmarks

SUBGOALS = ("stair", "key", "stair_back", "door")
STAIR, KEY, STAIR_BACK, DOOR = range(4)
LANDMARKS = {STAIR: landmarks.STAIR, KEY: landmarks.KEY, STAIR_BACK: landmarks.STAIR, DOOR: landmarks.DOOR}


def reached(state: Any, subgoal: Subgoal) -> bool:
    """Return whether a subgoal is reached in a state, given by its JSON view."""
    return bool(
        {
            STAIR: state["at_stair"] and not state["key"],
            KEY: state["key"] or state["door_open"],
            STAIR_BACK: state["at_stair"] and state["key"],
            DOOR: state["door_open"],
        }[subgoal]
    )
