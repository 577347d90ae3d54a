"""Defines the maze and its geometry (paper, section 6.1 and appendix).

A maze has 17 x 17 cells: 4 x 4 rooms of 3 x 3 cells, with walls of lava. A cell is (row, column). Rows and columns
0, 4, 8, 12 and 16 are the wall lines. A free cell of an inner wall line is a *door* and belongs to no room. So a
segment that leaves a room ends on the first cell of the next room, one step behind the door.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

SIZE = 17  # cells per side
ROOMS = 4  # rooms per side
PITCH = 4  # cells from one wall line to the next

Cell = tuple[int, int]
Room = tuple[int, int]

ACTIONS = ("up", "down", "left", "right")
SUBGOALS = ("north", "south", "west", "east", "go_to_target")
GO_TO_TARGET = 4
# Action i and subgoal i have the same direction: up is north, down is south, left is west, right is east.
MOVES: tuple[Cell, ...] = ((-1, 0), (1, 0), (0, -1), (0, 1))


@dataclass(frozen=True, eq=False)
class Maze:
    """One environment instance."""

    lava: NDArray[np.bool_]  # [17, 17]
    start: Cell
    goal: Cell

    def to_json(self) -> dict[str, Any]:
        """Return the JSON view, which the web app draws and from which experts answer."""
        rows = ["".join("#" if lava else "." for lava in row) for row in self.lava]
        return {"rows": rows, "start": list(self.start), "goal": list(self.goal)}

    @classmethod
    def from_json(cls, view: Any) -> "Maze":
        """Return the maze of a JSON view.

        Raises:
            ValueError: the view does not describe a maze.
        """
        try:
            lava = np.array([[cell == "#" for cell in row] for row in view["rows"]], dtype=bool)
            maze = cls(lava, cell_of(view["start"]), cell_of(view["goal"]))
        except (KeyError, TypeError, ValueError) as error:
            raise ValueError(f"not a maze: {error!r}") from error
        if lava.shape != (SIZE, SIZE):
            raise ValueError(f"a maze must have {SIZE} rows of {SIZE} cells; this one has shape {lava.shape}")
        return maze


def cell_of(view: Any) -> Cell:
    """Return the cell of a state's JSON view, which begins with its row and column.

    Raises:
        ValueError: the cell is outside the maze, or the view has no two numbers.
    """
    row, column = view[:2]
    if not (0 <= row < SIZE and 0 <= column < SIZE):
        raise ValueError(f"({row}, {column}) is outside the maze")
    return int(row), int(column)


def moved(cell: Cell, action: int) -> Cell:
    """Return the cell after one step from `cell`."""
    (row, column), (d_row, d_column) = cell, MOVES[action]
    return row + d_row, column + d_column


def room_of(cell: Cell) -> Room | None:
    """Return the room of a cell, or None for a cell of a wall line (a door or lava)."""
    row, column = cell
    if row % PITCH == 0 or column % PITCH == 0:
        return None
    return row // PITCH, column // PITCH


def room_beside(cell: Cell, direction: int) -> Room | None:
    """Return the neighbor of a cell's room in a direction; for a door, the room behind it. None if there is no room."""
    room, (d_row, d_column) = room_of(cell), MOVES[direction]
    if room is None:
        return room_of(moved(cell, direction))
    row, column = room[0] + d_row, room[1] + d_column
    return (row, column) if 0 <= row < ROOMS and 0 <= column < ROOMS else None


def wall_beside(cell: Cell, direction: int) -> list[Cell]:
    """Return the three possible door cells of the wall that bounds a cell's room in a direction.

    For a door, this is the door's own wall in the two directions that lead through it, and [] in the other two.
    """
    line, along = cell if direction in (0, 1) else cell[::-1]
    if along % PITCH == 0:  # a door whose wall is parallel to the direction
        return []
    wall = line if line % PITCH == 0 else PITCH * (line // PITCH + direction % 2)
    places = [(wall, PITCH * (along // PITCH) + k) for k in (1, 2, 3)]
    return places if direction in (0, 1) else [place[::-1] for place in places]


def walls() -> Iterator[tuple[Room, Room, tuple[Cell, ...]]]:
    """Yield the 24 walls between neighboring rooms: both rooms, and the three cells where a door can be."""
    for i in range(ROOMS):
        for j in range(ROOMS):
            row, column = PITCH * i, PITCH * j
            if i + 1 < ROOMS:
                yield (i, j), (i + 1, j), tuple((row + PITCH, column + k) for k in (1, 2, 3))
            if j + 1 < ROOMS:
                yield (i, j), (i, j + 1), tuple((row + k, column + PITCH) for k in (1, 2, 3))


def closed_rooms() -> NDArray[np.bool_]:
    """Return the lava of a maze without doors, bool[17, 17]."""
    line: NDArray[np.bool_] = np.arange(SIZE) % PITCH == 0
    return np.logical_or.outer(line, line)


def distances_from(lava: NDArray[np.bool_], source: Cell) -> NDArray[np.int16]:
    """Return int16[17, 17], the steps from `source` to each cell, -1 if there is no path (breadth-first search)."""
    if lava[source]:
        return np.full((SIZE, SIZE), -1, np.int16)
    unseen, blocked = -1, -2
    distances = (
        np.where(lava, blocked, unseen).ravel().tolist()
    )  # a list indexed by cell number is faster than an array
    reached = [SIZE * source[0] + source[1]]
    distances[reached[0]] = 0
    for cell in reached:
        for neighbor in (cell - SIZE, cell + SIZE, cell - 1, cell + 1):
            if distances[neighbor] == unseen:
                distances[neighbor] = distances[cell] + 1
                reached.append(neighbor)
    return np.array(distances, np.int16).clip(min=-1).reshape(SIZE, SIZE)
