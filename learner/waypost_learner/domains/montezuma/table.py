"""The computed expert as a table: the good actions for each state of the figure and each place of the skull.

A node is a state of the figure: its place, its motion, and whether it has the key. The skull rolls to and fro in 102
steps whatever the figure does, so a state of the room is a node and a phase of the skull. `expert/` computes the table.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.montezuma.game import ACTIONS, SKULL_RANGE

FILE = Path(__file__).parent / "expert.npz"
PHASES = 2 * len(SKULL_RANGE)
X, KEY = 0, 7  # columns of `Table.nodes`
# How much a difference in each number of a node counts, in the search for the most similar node.
_WEIGHTS = np.array([4, 4, 8, 2, 0.1, 0.01, 0.5, 1_000])


@dataclass(frozen=True)
class Table:
    """Good actions by leg, node and phase. A leg leads to the stair (0), or from it to the key or the door (1)."""

    nodes: NDArray[np.uint8]  # [nodes, 8]: x, y, five bytes of motion, whether the figure has the key
    good: NDArray[np.uint8]  # [2, nodes, phases], one bit per action; 0 in states that cannot be saved
    best: NDArray[np.uint8]  # [2, nodes, phases], the best of the good actions
    by_stair: NDArray[np.bool_]  # [nodes, phases], whether the best way to the key or the door passes the stair

    def find(self, state: Any) -> tuple[int, int]:
        """Return the node and the phase of a state, given by its JSON view.

        About one state in a thousand of random play is not in the table; then the most similar node is returned.
        """
        node = node_of(state["x"], state["y"], state["motion"], state["key"])
        return self._place(node), phase_of(*state["skull"])

    def actions(self, leg: int, node: int, phase: int) -> list[int]:
        """Return the good actions, the best one first."""
        bits, best = int(self.good[leg, node, phase]), int(self.best[leg, node, phase])
        return sorted((a for a in range(len(ACTIONS)) if bits >> a & 1), key=lambda action: action != best)

    @cached_property
    def _places(self) -> dict[bytes, int]:
        """The place of each node in the table; the search for a similar node adds what it finds."""
        return {bytes(node): place for place, node in enumerate(self.nodes)}

    def _place(self, wanted: bytes) -> int:
        if wanted not in self._places:
            differences = np.abs(self.nodes.astype(int) - np.frombuffer(wanted, np.uint8).astype(int))
            self._places[wanted] = int((differences @ _WEIGHTS).argmin())
        return self._places[wanted]


def node_of(x: int, y: int, motion: Sequence[int], key: bool) -> bytes:
    """Return the node of a state: one byte for each of its numbers."""
    return bytes([x, y, *motion, key])


def phase_of(x: int, direction: int) -> int:
    """Return the phase of the skull, 0 to 101: first it rolls to the right, then to the left."""
    return x - SKULL_RANGE[0] if direction else len(SKULL_RANGE) + SKULL_RANGE[-1] - x


def skull_at(phase: int) -> tuple[int, int]:
    """Return the skull's x and direction in a phase."""
    to_left = phase - len(SKULL_RANGE)
    return (SKULL_RANGE[-1] - to_left, 0) if to_left >= 0 else (SKULL_RANGE[phase], 8)


@cache
def shipped() -> Table:
    """Return the table that the package contains."""
    return read(FILE)


def read(file: Path) -> Table:
    """Return the table in a file."""
    with np.load(file, allow_pickle=False) as found:
        return Table(found["nodes"], found["good"], found["best"], found["by_stair"])


def write(file: Path, table: Table) -> None:
    """Write a table to a file."""
    with file.open("wb") as out:  # given a name, numpy would add an ending to it
        np.savez_compressed(out, nodes=table.nodes, good=table.good, best=table.best, by_stair=table.by_stair)
