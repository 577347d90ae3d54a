"""In which phases of the skull an action is deadly, measured in the emulator for every node near the floor."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.montezuma.expert.graph import DIES, Graph
from waypost_learner.domains.montezuma.game import ACTIONS, Game
from waypost_learner.domains.montezuma.table import KEY, PHASES, X, skull_at

_SKULL_OFFSET = 32  # between the skull's x and the figure's
_NEAR = 16  # how far the skull may be from the figure; measured: it touches up to a distance of 12
_MARGIN = 1  # phases; the picture of the skull, which decides, may be a pixel away from its place in memory

Deadly = NDArray[np.bool_]


def measure(graph: Graph, node: int, game: Game) -> Deadly:
    """Return bool[actions, phases], whether the skull kills the figure during an action in a node near the floor."""
    deadly = np.zeros((len(ACTIONS), PHASES), bool)
    for phase in range(PHASES):
        if abs(skull_at(phase)[0] + _SKULL_OFFSET - int(graph.nodes[node, X])) <= _NEAR:
            deadly[:, phase] = _deadly_actions(game, graph, node, phase)
    return deadly


def everywhere(graph: Graph, measured: Mapping[int, Deadly]) -> Deadly:
    """Return bool[nodes, actions, phases] from what was measured near the floor, with a margin around it.

    The key changes nothing about the skull, so what was measured without the key holds with it too.
    """
    deadly = np.zeros((len(graph.nodes), len(ACTIONS), PHASES), bool)
    without_key = {bytes(graph.nodes[node, :KEY]): node for node in measured}
    for place, node in enumerate(graph.nodes):
        same = without_key.get(bytes(node[:KEY]))
        if same is not None:
            deadly[place] = measured[same]
    with_margin: Deadly = np.any([np.roll(deadly, shift, axis=2) for shift in range(-_MARGIN, _MARGIN + 1)], axis=0)
    return with_margin


def _deadly_actions(game: Game, graph: Graph, node: int, phase: int) -> list[bool]:
    """Return whether each action is deadly. Actions that lead to the same node are tried once."""
    found: dict[int, bool] = {DIES: False}  # deadly without the skull: the graph says so
    for action, after in enumerate(graph.after[node].tolist()):
        if after not in found:
            game.restore(graph.snapshots[node])
            game.place_skull(*skull_at(phase))
            game.act(action)
            found[after] = game.memory().dying
    return [found[after] for after in graph.after[node].tolist()]
