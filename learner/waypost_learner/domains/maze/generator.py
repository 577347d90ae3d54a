"""Draws random mazes (paper, appendix "Creating Maze Navigation Environments").

`random`: start and goal are any two different cells of rooms. Doors are added one at a time, each in a random wall and
a random cell of it, until start and goal are connected. The maze is accepted if their shortest path has at least 40
steps.

`corners`: start and goal are two different corner cells, as in the main text ("from one corner of the maze") and in the
authors' stored mazes. As in these, the door cells are drawn again after the maze was accepted, so the shortest path can
be a little shorter or longer than 40 steps, and a training maze gets new door cells each time it is used
(docs/paper.md, deviation 2).

About one in fifty drawn mazes is accepted, so 2,048 are drawn at once. The first axis of most arrays is the draw.
"""

from collections.abc import Iterator
from functools import cache

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.maze.maze import PITCH, ROOMS, SIZE, Maze, closed_rooms, room_of, walls

SHORTEST_PATH = 40  # steps
TRAIN_MAZES = TEST_MAZES = 1_000
KINDS = ("random", "corners")
DRAWS = 2_048  # mazes drawn at once

_CORNERS = ((1, 1), (1, SIZE - 2), (SIZE - 2, 1), (SIZE - 2, SIZE - 2))
_ROOM_CELLS = tuple((r, c) for r in range(SIZE) for c in range(SIZE) if room_of((r, c)) is not None)
_WALL_ROOMS = np.array([[ROOMS * i + j for i, j in rooms] for *rooms, _ in walls()])  # [24, 2], room numbers
_WALL_CELLS = np.array([cells for *_, cells in walls()])  # [24, 3, 2], possible door cells

Cells = NDArray[np.int64]  # [draws, 2]
Lavas = NDArray[np.bool_]  # [draws, 17, 17]


@cache
def maze_set(kind: str, seed: int = 0) -> tuple[tuple[Maze, ...], tuple[Maze, ...]]:
    """Return 1,000 training and 1,000 test mazes, all different. The same kind and seed give the same mazes."""
    mazes: dict[bytes, Maze] = {}
    for maze in draw_mazes(kind, np.random.default_rng([KINDS.index(kind), seed])):
        mazes[maze.lava.tobytes() + repr((maze.start, maze.goal)).encode()] = maze
        if len(mazes) == TRAIN_MAZES + TEST_MAZES:
            break
    drawn = tuple(mazes.values())
    return drawn[:TRAIN_MAZES], drawn[TRAIN_MAZES:]


def draw_mazes(kind: str, rng: np.random.Generator) -> Iterator[Maze]:
    """Yield accepted mazes, without end."""
    cells = np.array(_CORNERS if kind == "corners" else _ROOM_CELLS)
    while True:
        first = rng.integers(len(cells), size=DRAWS)
        start, goal = cells[first], cells[(first + rng.integers(1, len(cells), size=DRAWS)) % len(cells)]
        opened = _opened_walls(start, goal, rng)
        lava = _with_doors(opened, rng)
        kept = ~_connected_within(SHORTEST_PATH - 1, lava, start, goal)
        if kind == "corners":
            lava = _with_doors(opened, rng)
        for drawn, s, g in zip(lava[kept], start[kept].tolist(), goal[kept].tolist(), strict=True):
            yield Maze(drawn, tuple(s), tuple(g))


def with_doors_redrawn(maze: Maze, rng: np.random.Generator) -> Maze:
    """Return the maze with each door moved to a random one of the three cells of its wall."""
    lava = closed_rooms()
    for *_, cells in walls():
        if not all(maze.lava[cell] for cell in cells):
            lava[cells[rng.integers(3)]] = False
    return Maze(lava, maze.start, maze.goal)


def _opened_walls(start: Cells, goal: Cells, rng: np.random.Generator) -> NDArray[np.bool_]:
    """Open walls in random order until start and goal are connected, and return bool[draws, 24]: which walls are open.

    For each pair of rooms, compute when they become connected. This is a minimax path problem, which the
    Floyd-Warshall algorithm solves.
    """
    times = rng.random((DRAWS, len(_WALL_ROOMS)), np.float32)  # the time at which each wall opens: a random order
    # The time at which two rooms become connected. The draws are the last axis here, for speed.
    connected = np.full((ROOMS**2, ROOMS**2, DRAWS), 2, np.float32)
    connected[*_WALL_ROOMS.T] = connected[*_WALL_ROOMS.T[::-1]] = times.T
    for via in range(ROOMS**2):
        np.minimum(connected, np.maximum(connected[:, via, None], connected[via]), out=connected)
    first, last = (ROOMS * rooms[:, 0] + rooms[:, 1] for rooms in (start // PITCH, goal // PITCH))
    enough = np.where(first == last, 0, connected[first, last, np.arange(DRAWS)])
    opened: NDArray[np.bool_] = times <= enough[:, None]
    return opened


def _with_doors(opened: NDArray[np.bool_], rng: np.random.Generator) -> Lavas:
    """Return mazes with a door in a random one of the three cells of each opened wall."""
    lava = np.tile(closed_rooms(), (DRAWS, 1, 1))
    draw, wall = opened.nonzero()
    rows, columns = _WALL_CELLS[wall, rng.integers(3, size=len(wall))].T
    lava[draw, rows, columns] = False
    return lava


def _connected_within(steps: int, lava: Lavas, start: Cells, goal: Cells) -> NDArray[np.bool_]:
    """Return bool[draws]: whether start and goal are connected by a path of at most `steps` steps."""
    draws = np.arange(DRAWS)
    reached = np.zeros_like(lava)
    reached[draws, *start.T] = True
    free, cells = ~lava.ravel(), reached.ravel()  # all mazes in one row, for speed: outer walls separate them
    for _ in range(steps):
        before = cells.copy()
        for distance in (1, SIZE):
            cells[distance:] |= before[:-distance]
            cells[:-distance] |= before[distance:]
        cells &= free
    arrived: NDArray[np.bool_] = reached[draws, *goal.T]
    return arrived
