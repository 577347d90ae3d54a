"""The maze and its geometry (paper, section 6.1 and appendix): 17 x 17 cells, 4 x 4 rooms of 3 x 3, lava walls.

A cell is (row, column). Row and column lines 0, 4, 8, 12, 16 are walls; a free cell of an inner wall line is a *door*
and belongs to no room. So a segment that leaves a room ends on the first cell of the next one, the door being behind.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

SIZE = 17
ROOMS = 4

Cell = tuple[int, int]
Room = tuple[int, int]

ACTIONS = ("up", "down", "left", "right")
SUBGOALS = ("north", "south", "west", "east", "go_to_target")
GO_TO_TARGET = 4
# Action i moves where subgoal i leads: up is north, down is south, left is west, right is east.
MOVES: tuple[Cell, ...] = ((-1, 0), (1, 0), (0, -1), (0, 1))


@dataclass(frozen=True, eq=False)
class Maze:
    """One environment instance; `lava` is bool[17, 17]."""

    lava: NDArray[np.bool_]
    start: Cell
    goal: Cell

    def to_json(self) -> dict[str, Any]:
        """Return the JSON view the page draws and the oracle bot answers from."""
        rows = ["".join("#" if lava else "." for lava in row) for row in self.lava]
        return {"rows": rows, "start": list(self.start), "goal": list(self.goal)}

    @classmethod
    def from_json(cls, view: Any) -> "Maze":
        """Read `to_json` back.

        Raises:
            ValueError: the view is no maze.
        """
        try:
            lava = np.array([[cell == "#" for cell in row] for row in view["rows"]], dtype=bool)
            maze = cls(lava, cell_of(view["start"]), cell_of(view["goal"]))
        except (KeyError, TypeError, ValueError) as error:
            raise ValueError(f"not a maze: {error!r}") from error
        if lava.shape != (SIZE, SIZE):
            raise ValueError(f"a maze has {SIZE} rows of {SIZE} cells, this one is {lava.shape}")
        return maze


def cell_of(view: Any) -> Cell:
    """Read a state's JSON view, [row, column]."""
    row, column = view
    if not (0 <= row < SIZE and 0 <= column < SIZE):
        raise ValueError(f"({row}, {column}) lies outside the maze")
    return int(row), int(column)


def moved(cell: Cell, action: int) -> Cell:
    """Return the cell one step from `cell`."""
    (row, column), (d_row, d_column) = cell, MOVES[action]
    return row + d_row, column + d_column


def room_of(cell: Cell) -> Room | None:
    """Return the room of a cell, or None in a wall line (a door or lava)."""
    row, column = cell
    if row % ROOMS == 0 or column % ROOMS == 0:
        return None
    return row // ROOMS, column // ROOMS


def room_beside(cell: Cell, direction: int) -> Room | None:
    """Return the room on a side of a cell's room, or of a door; None where there is none."""
    room, (d_row, d_column) = room_of(cell), MOVES[direction]
    if room is None:
        return room_of(moved(cell, direction))
    row, column = room[0] + d_row, room[1] + d_column
    return (row, column) if 0 <= row < ROOMS and 0 <= column < ROOMS else None


def wall_beside(cell: Cell, direction: int) -> list[Cell]:
    """Return the three cells of the wall on a side of a cell's room; a door's own wall is beside it on two sides."""
    line, along = cell if direction in (0, 1) else cell[::-1]
    if along % ROOMS == 0:  # a door in a wall that runs the other way
        return []
    wall = line if line % ROOMS == 0 else ROOMS * (line // ROOMS + direction % 2)
    places = [(wall, ROOMS * (along // ROOMS) + k) for k in (1, 2, 3)]
    return places if direction in (0, 1) else [place[::-1] for place in places]


def walls() -> Iterator[tuple[Room, Room, tuple[Cell, ...]]]:
    """Yield the 24 walls between neighbouring rooms: both rooms, and the three cells where a door can be."""
    for i in range(ROOMS):
        for j in range(ROOMS):
            row, column = 4 * i, 4 * j
            if i + 1 < ROOMS:
                yield (i, j), (i + 1, j), tuple((row + 4, column + k) for k in (1, 2, 3))
            if j + 1 < ROOMS:
                yield (i, j), (i, j + 1), tuple((row + k, column + 4) for k in (1, 2, 3))


def closed_rooms() -> NDArray[np.bool_]:
    """Return the lava of a maze without doors, bool[17, 17]."""
    line: NDArray[np.bool_] = np.arange(SIZE) % ROOMS == 0
    return np.logical_or.outer(line, line)


def distances_from(lava: NDArray[np.bool_], source: Cell) -> NDArray[np.int16]:
    """Return int16[17, 17], the steps from `source` to each cell, -1 where no path leads (breadth-first)."""
    if lava[source]:
        return np.full((SIZE, SIZE), -1, np.int16)
    unseen, blocked = -1, -2
    distances = np.where(lava, blocked, unseen).ravel().tolist()  # a list, by cell number, is quicker than an array
    reached = [SIZE * source[0] + source[1]]
    distances[reached[0]] = 0
    for cell in reached:
        for neighbour in (cell - SIZE, cell + SIZE, cell - 1, cell + 1):
            if distances[neighbour] == unseen:
                distances[neighbour] = distances[cell] + 1
                reached.append(neighbour)
    return np.array(distances, np.int16).clip(min=-1).reshape(SIZE, SIZE)
