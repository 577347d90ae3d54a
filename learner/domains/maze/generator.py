"""Draws mazes (paper, appendix "Creating Maze Navigation Environments").

`random`: start and goal are any two different cells, doors are added one at a time (a random wall between two rooms, a
random cell of it) until start and goal are connected; the maze is kept if their shortest path is at least 40 steps.

`corners`: start and goal are two different corner cells, as in the main text ("from one corner of the maze") and in the
authors' stored mazes, whose door cells were drawn anew after the layout was accepted, so that paths are a little
shorter and longer than 40 (docs/paper.md, deviation 2).
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from learner.domains.maze.maze import SIZE, Cell, Maze, Room, closed_rooms, distances_from, room_of, walls

SHORTEST_PATH = 40
TRAIN_MAZES = TEST_MAZES = 1_000
KINDS = ("random", "corners")

_WALLS = tuple(walls())
_CORNERS: tuple[Cell, ...] = ((1, 1), (1, SIZE - 2), (SIZE - 2, 1), (SIZE - 2, SIZE - 2))
_ROOM_CELLS = tuple((r, c) for r in range(SIZE) for c in range(SIZE) if room_of((r, c)) is not None)
# Every step from room to room takes at most 7 moves and the last room 4, so fewer rooms cannot make a long path.
_FEWEST_CROSSINGS = (SHORTEST_PATH - 4) // 7


@cache
def maze_set(kind: str, seed: int = 0) -> tuple[tuple[Maze, ...], tuple[Maze, ...]]:
    """Return 1,000 training and 1,000 test mazes, the same for the same kind and seed, all different."""
    rng = np.random.default_rng([KINDS.index(kind), seed])
    mazes: dict[bytes, Maze] = {}
    while len(mazes) < TRAIN_MAZES + TEST_MAZES:
        maze = draw_maze(kind, rng)
        mazes[maze.lava.tobytes() + repr((maze.start, maze.goal)).encode()] = maze
    drawn = tuple(mazes.values())
    return drawn[:TRAIN_MAZES], drawn[TRAIN_MAZES:]


def draw_maze(kind: str, rng: np.random.Generator) -> Maze:
    """Draw until a maze is accepted (about one draw in fifty is)."""
    while True:
        start, goal = _ends(kind, rng)
        doors = _doors(start, goal, rng)
        if _crossings(doors, start, goal) < _FEWEST_CROSSINGS:
            continue
        lava = _with_doors(doors)
        if distances_from(lava, start)[goal] < SHORTEST_PATH:
            continue
        if kind == "corners":
            lava = _with_doors({wall: int(rng.integers(3)) for wall in doors})
        return Maze(lava, start, goal)


def _ends(kind: str, rng: np.random.Generator) -> tuple[Cell, Cell]:
    cells = _CORNERS if kind == "corners" else _ROOM_CELLS
    start, goal = rng.choice(len(cells), size=2, replace=False)
    return cells[start], cells[goal]


def _doors(start: Cell, goal: Cell, rng: np.random.Generator) -> dict[int, int]:
    """Open walls in random order until start and goal are connected; return wall -> which of its three cells."""
    leader = {(i, j): (i, j) for i in range(4) for j in range(4)}

    def find(room: Room) -> Room:
        while leader[room] != room:
            room = leader[room]
        return room

    first, last = room_of(start), room_of(goal)
    assert first is not None
    assert last is not None
    doors: dict[int, int] = {}
    for wall, cell in zip(
        rng.permutation(len(_WALLS)).tolist(), rng.integers(3, size=len(_WALLS)).tolist(), strict=True
    ):
        if find(first) == find(last):
            break
        one, other, _ = _WALLS[wall]
        leader[find(one)] = find(other)
        doors[wall] = cell
    return doors


def _crossings(doors: dict[int, int], start: Cell, goal: Cell) -> int:
    """Return how many doors the shortest chain of rooms from start to goal passes."""
    neighbours: dict[Room, list[Room]] = {}
    for wall in doors:
        one, other, _ = _WALLS[wall]
        neighbours.setdefault(one, []).append(other)
        neighbours.setdefault(other, []).append(one)
    first, last = room_of(start), room_of(goal)
    seen, frontier, crossings = {first}, [first], 0
    while last not in seen:
        crossings += 1
        frontier = [n for room in frontier if room for n in neighbours.get(room, ()) if n not in seen]
        seen.update(frontier)
    return crossings


def _with_doors(doors: dict[int, int]) -> NDArray[np.bool_]:
    lava = closed_rooms()
    for wall, cell in doors.items():
        lava[_WALLS[wall][2][cell]] = False
    return lava
