"""Defines the views of the maze: the part of an observation that each policy sees, and the places in it.

Views are not part of the paper, and the `paper` preset does not use them.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from waypost.domains import Grid, View
from waypost_learner.domains.maze.env import LAVA, TRAIL
from waypost_learner.domains.maze.maze import MOVES, PITCH, ROOMS, SIZE, Cell, walls

Picture = NDArray[np.float32]

_ROOM_GRID = Grid(patch=PITCH + 1, stride=PITCH, moves=(*MOVES, None))
_CELL_GRID = Grid(patch=3, stride=1, moves=MOVES)
_HI_SIDE = PITCH * (2 * ROOMS - 1) + 1  # pixels per side: all rooms that can surround the agent's room
_REACH = 5  # cells from the agent to the farthest visible cell, which is one step behind a wall of its room
_WALL_CELLS = np.array([cells for *_, cells in walls()])  # [24, 3, 2], possible door cells
_STEP_THROUGH = np.array([np.subtract(second, first) for first, second, _ in walls()])[:, None]  # [24, 1, 2]
# [24, 6, 2], the cells on both sides of each wall
_CELLS_BESIDE = np.concatenate([_WALL_CELLS - _STEP_THROUGH, _WALL_CELLS + _STEP_THROUGH], 1)


def _maze_around_room(observation: Picture) -> Picture:
    """Return the maze centered on the agent's room, float32[3, 29, 29], without the trail.

    Outside of the maze there is lava. If a wall has several doors, only the nearest are shown.
    """
    row, column = _agent_cell(observation)
    top, left = (PITCH * (ROOMS - 1 - min(place // PITCH, ROOMS - 1)) for place in (row, column))
    seen = _lava_picture(_HI_SIDE)
    picture = _with_nearest_doors(observation)
    seen[:, top : top + SIZE, left : left + SIZE] = np.where(picture == TRAIL, np.float32(0), picture)
    return seen


def _room_around_agent(observation: Picture) -> Picture:
    """Return the cells of the agent's room and one step behind its walls, float32[3, 11, 11], centered on the agent.

    If the agent is in a door, show the cells beside the door. All other cells are lava. If a wall has several doors,
    only the nearest are shown.
    """
    agent = _agent_cell(observation)
    rows, columns = (slice(*_visible_span(place)) for place in agent)
    seen = _lava_picture(SIZE + 2 * _REACH)
    seen[:, _REACH:-_REACH, _REACH:-_REACH][:, rows, columns] = _with_nearest_doors(observation)[:, rows, columns]
    (top, left), side = agent, 2 * _REACH + 1
    return np.ascontiguousarray(seen[:, top : top + side, left : left + side])


def _maze_around_agent(observation: Picture) -> Picture:
    """Return the maze centered on the agent, float32[3, 33, 33]. Outside of the maze there is lava."""
    row, column = _agent_cell(observation)
    seen = _lava_picture(2 * SIZE - 1)
    seen[:, SIZE - 1 - row : 2 * SIZE - 1 - row, SIZE - 1 - column : 2 * SIZE - 1 - column] = observation
    return seen


def _cells_around_agent(observation: Picture) -> Picture:
    """Return the cells up to five steps from the agent in each direction, float32[3, 11, 11], centered on the agent."""
    around = slice(SIZE - 1 - _REACH, SIZE + _REACH)
    return np.ascontiguousarray(_maze_around_agent(observation)[:, around, around])


def _with_nearest_doors(observation: Picture) -> Picture:
    """Return the observation with only the doors of each wall that are nearest to the agent; the others become lava.

    Two doors remain if both are equally near. So a maze with several doors per wall looks like a maze with at most one,
    and a policy trained on such mazes applies to it. The path can become a few steps longer, if another door is nearer
    to the target. A wall with lava beside it keeps all its doors, because the nearest door may not be reachable.
    """
    doors = observation[1][*_WALL_CELLS.T].T != LAVA
    if doors.sum(1).max() <= 1:
        return observation
    distances = np.where(doors, np.abs(_WALL_CELLS - _agent_cell(observation)).sum(2), 2 * SIZE)
    free = (observation[1][*_CELLS_BESIDE.T] != LAVA).all(0)
    hidden = doors & free[:, None] & (distances > distances.min(1, keepdims=True))
    seen = observation.copy()
    seen[1][*_WALL_CELLS[hidden].T] = LAVA
    return seen


def _visible_span(place: int) -> tuple[int, int]:
    """Return the visible rows (or columns) for an agent in row `place`: the first, and the one after the last."""
    if place % PITCH == 0:
        return place - 1, place + 2
    wall = PITCH * (place // PITCH)
    return max(wall - 1, 0), min(wall + PITCH + 2, SIZE)


HI_VIEW = View((3, _HI_SIDE, _HI_SIDE), _maze_around_room, _ROOM_GRID)
LO_VIEW = View((3, 2 * _REACH + 1, 2 * _REACH + 1), _room_around_agent, _CELL_GRID)
FLAT_VIEW = View((3, 2 * SIZE - 1, 2 * SIZE - 1), _maze_around_agent)
CENTERED_VIEW = FLAT_VIEW
FLAT_GRID = replace(_CELL_GRID, agent=0)
CROP_VIEW = View(LO_VIEW.shape, _cells_around_agent)


def _agent_cell(observation: Picture) -> Cell:
    row, column = np.unravel_index(int(observation[0].argmax()), observation[0].shape)
    return int(row), int(column)


def _lava_picture(size: int) -> Picture:
    picture = np.zeros((3, size, size), np.float32)
    picture[1] = LAVA
    return picture
