"""What the maze tells a learner of its structure: where to look, and which places there are.

None of it is the paper's, and the `paper` preset uses none.
"""

import numpy as np
from numpy.typing import NDArray

from waypost.domain import Grid, View
from waypost_learner.domains.maze.env import LAVA, TRAIL
from waypost_learner.domains.maze.maze import MOVES, ROOMS, SIZE, Cell, walls

Picture = NDArray[np.float32]

_ROOMS = Grid(patch=ROOMS + 1, stride=ROOMS, moves=(*MOVES, None))
_CELLS = Grid(patch=3, stride=1, moves=MOVES)
_ACROSS = ROOMS * (2 * ROOMS - 1) + 1  # pixels, with the agent's room in the middle of all that can be around it
_REACH = 5  # cells: a room, its walls and what is just behind them
_WALLS = np.array([cells for *_, cells in walls()])  # [24, 3, 2], where each wall can have doors
_THROUGH = np.array([np.subtract(second, first) for first, second, _ in walls()])[:, None]  # [24, 1, 2], one step
_BESIDE = np.concatenate([_WALLS - _THROUGH, _WALLS + _THROUGH], 1)  # [24, 6, 2], the cells on both sides of each wall


def _whole(observation: Picture) -> Picture:
    """Return the maze around the agent's room, float32[3, 29, 29], without the trail; beyond the maze there is lava.

    Of several doors in a wall, only the nearest are seen.
    """
    row, column = _agent(observation)
    top, left = (ROOMS * (ROOMS - 1 - min(place // ROOMS, ROOMS - 1)) for place in (row, column))
    seen = _lava(_ACROSS)
    picture = _with_nearest_doors(observation)
    seen[:, top : top + SIZE, left : left + SIZE] = np.where(picture == TRAIL, np.float32(0), picture)
    return seen


def _near(observation: Picture) -> Picture:
    """Return the cells around the agent, float32[3, 11, 11], as far as they are of its room, or just behind its walls.

    Of what is beyond a door in which the agent stands, the first cells are seen. What is farther is lava. Of several
    doors in a wall, only the nearest are seen.
    """
    agent = _agent(observation)
    rows, columns = (slice(*_extent(place)) for place in agent)
    seen = _lava(SIZE + 2 * _REACH)
    seen[:, _REACH:-_REACH, _REACH:-_REACH][:, rows, columns] = _with_nearest_doors(observation)[:, rows, columns]
    (top, left), side = agent, 2 * _REACH + 1
    return np.ascontiguousarray(seen[:, top : top + side, left : left + side])


def _all(observation: Picture) -> Picture:
    """Return the maze around the agent, float32[3, 33, 33]; beyond it there is lava."""
    row, column = _agent(observation)
    seen = _lava(2 * SIZE - 1)
    seen[:, SIZE - 1 - row : 2 * SIZE - 1 - row, SIZE - 1 - column : 2 * SIZE - 1 - column] = observation
    return seen


def _with_nearest_doors(observation: Picture) -> Picture:
    """Return the maze with lava in all doors of a wall but that nearest to the agent, or those, if two are as near.

    So every maze looks as those do whose walls have one door at most, and what was learned of these holds. It costs a
    few steps where another door would have been nearer the target. A wall with lava beside it keeps all its doors, as
    who can reach one of them might not reach the others.
    """
    doors = observation[1][*_WALLS.T].T != LAVA
    if doors.sum(1).max() <= 1:
        return observation
    distances = np.where(doors, np.abs(_WALLS - _agent(observation)).sum(2), 2 * SIZE)
    free = (observation[1][*_BESIDE.T] != LAVA).all(0)
    hidden = doors & free[:, None] & (distances > distances.min(1, keepdims=True))
    seen = observation.copy()
    seen[1][*_WALLS[hidden].T] = LAVA
    return seen


def _extent(place: int) -> tuple[int, int]:
    """Return the first row (or column) seen from one, and the first that is not."""
    if place % ROOMS == 0:
        return place - 1, place + 2
    wall = ROOMS * (place // ROOMS)
    return max(wall - 1, 0), min(wall + ROOMS + 2, SIZE)


HI_VIEW = View((3, _ACROSS, _ACROSS), _whole, _ROOMS)
LO_VIEW = View((3, 2 * _REACH + 1, 2 * _REACH + 1), _near, _CELLS)
FLAT_VIEW = View((3, 2 * SIZE - 1, 2 * SIZE - 1), _all)  # no grid: a hundred steps ahead take too long to plan


def _agent(observation: Picture) -> Cell:
    row, column = np.unravel_index(int(observation[0].argmax()), observation[0].shape)
    return int(row), int(column)


def _lava(size: int) -> Picture:
    picture = np.zeros((3, size, size), np.float32)
    picture[1] = LAVA
    return picture
