"""The figure's states and how actions connect them, found by breadth-first search in the emulator.

The skull is kept away from the figure, so that it plays no part.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.montezuma.game import ACTIONS, DOOR_REWARD, SKULL_RANGE, Game, Memory
from waypost_learner.domains.montezuma.landmarks import STAIR, small
from waypost_learner.domains.montezuma.table import node_of

DIES, OPENS_DOOR = -1, -2
_MIDDLE = 77  # the figure's x in the middle of the room
_HIGHEST = 175  # the figure's y up to which the skull can touch it

Progress = Callable[[int, int], None]
"""Called with how much is done, and of how much."""


@dataclass(frozen=True)
class Graph:
    """The nodes that the figure can reach, and the node after each action."""

    nodes: NDArray[np.uint8]  # [nodes, 8], as in `Table`
    at_stair: NDArray[np.bool_]  # [nodes], whether the detector sees the figure at the stair
    after: NDArray[np.int32]  # [nodes, actions]: a node, or DIES, or OPENS_DOOR
    snapshots: dict[int, bytes]  # of the emulator, in the nodes near the floor without the key


def explore(progress: Progress) -> Graph:
    """Return the graph of all nodes that can be reached from the start."""
    game = Game()
    empty = small(game.grey())
    nodes, snapshots, at_stair = [_node(game.memory())], [game.snapshot()], [False]
    places, near_floor, after = {nodes[0]: 0}, list[int](), list[list[int]]()
    while len(after) < len(nodes):
        here, following = snapshots[len(after)], list[int]()
        for action in range(len(ACTIONS)):
            game.restore(here)
            keep_skull_away(game)
            reward, memory = game.act(action), game.memory()
            node = _node(memory)
            if memory.dying or reward == DOOR_REWARD:
                following.append(DIES if memory.dying else OPENS_DOOR)
                continue
            if node not in places:
                places[node] = len(nodes)
                if memory.y <= _HIGHEST and not memory.key:
                    near_floor.append(len(nodes))
                nodes.append(node)
                snapshots.append(game.snapshot())
                at_stair.append(STAIR.changed(small(game.grey()), empty))
            following.append(places[node])
        after.append(following)
        progress(len(after), len(nodes))
    table = np.frombuffer(b"".join(nodes), np.uint8).reshape(len(nodes), -1)
    kept = {place: snapshots[place] for place in near_floor}
    return Graph(table, np.array(at_stair), np.array(after, np.int32), kept)


def _node(memory: Memory) -> bytes:
    return node_of(memory.x, memory.y, memory.motion, memory.key)


def keep_skull_away(game: Game) -> None:
    """Put the skull to the other side of the room."""
    game.place_skull(SKULL_RANGE[-1] if game.memory().x < _MIDDLE else SKULL_RANGE[0], 0)
