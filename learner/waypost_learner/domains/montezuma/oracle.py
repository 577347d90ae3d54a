"""The expert of the room. It looks up a table that was computed once from the emulator."""

from collections.abc import Sequence
from typing import Any

from waypost.trajectory import Action, Subgoal
from waypost_learner.domains.montezuma.subgoals import DOOR, KEY, STAIR, STAIR_BACK, reached
from waypost_learner.domains.montezuma.table import Table, shipped

_LEGS = {(STAIR, False): 0, (KEY, False): 1, (STAIR_BACK, True): 0, (DOOR, True): 1}  # by subgoal and key


class RoomOracle:
    """The oracle (`waypost.domains.Oracle`).

    An action is good if it costs at most half a step more than the best one. In states from which the figure can only
    die, no action is good.
    """

    @property
    def _table(self) -> Table:
        return shipped()

    def good_subgoals(self, instance: Any, state: Any) -> Sequence[Subgoal]:
        """Return the next landmark on the best way: the stair, until the figure has passed it, then the key or door."""
        del instance
        stair, behind = (STAIR_BACK, DOOR) if state["key"] else (STAIR, KEY)
        if state["at_stair"]:  # the table may not know it: the detector can see two pictures of one node differently
            return (behind,)
        node, phase = self._table.find(state)
        if not self._table.good[1, node, phase]:
            return stair, behind  # nothing helps anymore
        return (stair,) if self._table.by_stair[node, phase] else (behind,)

    def good_actions(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> Sequence[Action]:
        """Return the good actions toward a subgoal, the best one first; () if the figure can only die."""
        del instance, origin
        leg = _LEGS.get((subgoal, state["key"]))
        return () if leg is None or state["dying"] else self._table.actions(leg, *self._table.find(state))

    def reached(self, instance: Any, origin: Any, state: Any, subgoal: Subgoal) -> bool:
        """Return whether the figure is at the subgoal's landmark."""
        del instance, origin
        return reached(state, subgoal)

    def succeeded(self, instance: Any, state: Any) -> bool:
        """Return whether the door is open."""
        del instance
        return bool(state["door_open"])
