"""The best actions in every node and phase, by value iteration.

A value is the expected discount at the end of the task, where the figure slips: with a small probability a random
action replaces the chosen one. So the plan keeps a distance from dangers. The four subgoals are planned from the last
to the first: the end of a subgoal has the value of the next subgoal there.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.montezuma.expert.collisions import Deadly
from waypost_learner.domains.montezuma.expert.graph import OPENS_DOOR, Graph
from waypost_learner.domains.montezuma.game import ACTIONS
from waypost_learner.domains.montezuma.table import KEY, PHASES, Table

_DISCOUNT = 0.999  # per step
_SLIPS = 0.05
_ENOUGH = 1e-6  # the largest change of a value after which the iteration ends
# How many steps more than the best action a good one may cost. With a whole step, waiting would always be good.
_TOLERANCE = 0.5
# The good action that the expert shows: the first of these. So similar states have the same labels.
_PREFERRED = [
    ACTIONS.index(name) for name in ("right", "left", "up", "down", "noop", "jump_right", "jump_left", "jump")
]

Values = NDArray[np.float32]


@dataclass(frozen=True)
class _Leg:
    """The part of the graph that belongs to one subgoal."""

    places: NDArray[np.intp]  # its nodes
    after: NDArray[np.intp]  # [its nodes, actions], numbers in `places`; 0 where the subgoal ends or the figure dies
    goes_on: NDArray[np.bool_]  # [its nodes, actions, phases], whether the figure lives and the subgoal goes on
    gains: Values  # [its nodes, actions, phases], the value at the end of the subgoal if the action ends it

    def q(self, values: Values) -> Values:
        """Return the values of actions, given those of nodes."""
        following = self.gains + self.goes_on * np.roll(values, -1, axis=1)[self.after]
        return np.asarray(_DISCOUNT * following, np.float32)


def plan(graph: Graph, deadly: Deadly) -> Table:
    """Return the table of good actions."""
    with_key = graph.nodes[:, KEY] > 0
    nothing = np.zeros((len(graph.nodes), PHASES), np.float32)
    door = _leg(graph, deadly, with_key, ~with_key, nothing, opening=1)
    to_door = _solved(graph, door)
    back = _leg(graph, deadly, with_key, with_key & graph.at_stair, to_door)
    to_stair_back = _solved(graph, back)
    key = _leg(graph, deadly, ~with_key, with_key, to_stair_back)
    to_key = _solved(graph, key)
    stair = _leg(graph, deadly, ~with_key, ~with_key & graph.at_stair, to_key)
    to_stair = _solved(graph, stair)

    good, best = (np.zeros((2, *nothing.shape), np.uint8) for _ in range(2))
    for number, leg, values in ((0, stair, to_stair), (0, back, to_stair_back), (1, key, to_key), (1, door, to_door)):
        q = leg.q(values[leg.places])
        highest = q.max(axis=1, keepdims=True)
        near = (q >= _DISCOUNT**_TOLERANCE * highest) & (highest > _ENOUGH)
        good[number, leg.places] = np.packbits(near.transpose(0, 2, 1), axis=2, bitorder="little")[:, :, 0]
        best[number, leg.places] = np.array(_PREFERRED)[near[:, _PREFERRED].argmax(axis=1)]
    direct = np.where(with_key[:, None], to_door, to_key)
    through = np.where(with_key[:, None], to_stair_back, to_stair)
    by_stair = (through >= _DISCOUNT * direct) & ~graph.at_stair[:, None]
    return Table(graph.nodes, good, best, by_stair)


def _leg(
    graph: Graph,
    deadly: Deadly,
    inside: NDArray[np.bool_],
    ends: NDArray[np.bool_],
    beyond: Values,
    opening: float = 0,
) -> _Leg:
    """Return the leg of a subgoal.

    Args:
        graph: the graph.
        deadly: where the skull kills.
        inside: bool[nodes], the nodes in which the subgoal is pursued.
        ends: bool[nodes], the nodes in which it ends.
        beyond: the values of the next subgoal.
        opening: the value of opening the door.
    """
    places = np.flatnonzero(inside)
    numbers = np.full(len(graph.nodes), -1)
    numbers[places] = np.arange(len(places))
    after = graph.after[places]
    known = np.maximum(after, 0)
    arrives, opens = (after >= 0) & ends[known], after == OPENS_DOOR
    goes_on = (after >= 0) & ~arrives & (numbers[known] >= 0)
    lives = ~deadly[places]
    gains = np.zeros((len(places), len(ACTIONS), PHASES), np.float32)
    gains[arrives] = np.roll(beyond[after[arrives]], -1, axis=1)
    gains[opens] = opening
    return _Leg(places, np.where(goes_on, numbers[known], 0), goes_on[:, :, None] & lives, gains * lives)


def _solved(graph: Graph, leg: _Leg) -> Values:
    """Return the values float32[nodes, phases] of a leg's nodes; 0 in the others."""
    values, change = np.zeros((len(leg.places), PHASES), np.float32), 1.0
    while change > _ENOUGH:
        q = leg.q(values)
        new: Values = (1 - _SLIPS) * q.max(axis=1) + _SLIPS * q.mean(axis=1)
        change, values = float(np.abs(new - values).max(initial=0)), new
    everywhere = np.zeros((len(graph.nodes), PHASES), np.float32)
    everywhere[leg.places] = values
    return everywhere
