"""What the maze tells a learner of its structure: where to look, which places there are, what else a label says.

None of it is the paper's, and the `paper` preset uses none.
"""

from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from learner.domains.base import Grid, Relabeled, View
from learner.domains.maze.env import AGENT, LAVA, TARGET, TRAIL
from learner.domains.maze.maze import GO_TO_TARGET, MOVES, ROOMS, SIZE, Cell, Room, cell_of, room_beside, room_of, walls
from learner.types import Action, Segment, State, Subgoal, Trajectory

Picture = NDArray[np.float32]

_ROOMS = Grid(patch=ROOMS + 1, stride=ROOMS, moves=(*MOVES, None))
_CELLS = Grid(patch=3, stride=1, moves=MOVES)
_ACROSS = ROOMS * (2 * ROOMS - 1) + 1  # pixels, with the agent's room in the middle of all that can be around it
BACK = 1  # flips the number of a direction to that of its opposite
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


def relabeled(trajectory: Trajectory, good_subgoals: Sequence[Subgoal]) -> Iterator[Relabeled]:
    """Yield what is right on the way from each place of a labeled way to each other one, there and back.

    A part of a shortest way is a shortest way, and so is the way back. An episode that strayed from it, but for rooms
    that the expert found wrong, says what is no longer than the way it went.
    """
    lava = trajectory[0].start.observation[1] == LAVA
    for cells, subgoals in _ways(trajectory, good_subgoals, lava):
        for i, here in enumerate(cells):
            for j, target in enumerate(cells):
                if j != i:
                    yield _picture(lava, here, target), subgoals[i] if j > i else subgoals[i - 1] ^ BACK
            for target in _others(lava, here):
                yield _picture(lava, here, target), GO_TO_TARGET


def retraced(demonstration: Trajectory) -> Iterator[Segment]:
    """Yield the way of a demonstration gone back, room by room, and the way to each of its cells as to a target.

    A cell is a target of who has come into its room, there and back. The trail is of all that was gone until then.
    """
    lava = demonstration[0].start.observation[1] == LAVA
    there = [cell_of(demonstration[0].start.view)]
    there += [cell_of(state.view) for segment in demonstration for state in segment.states[1:]]
    if lava[there[-1]]:
        there.pop()
    back = there[::-1]
    for stay, beyond in pairwise(_stays(back)):
        yield from _gone(lava, back[: beyond[0] + 1], stay[0], back[-1], _action(back, beyond[0]))
    for way in (there, back):
        for entered, *others in _stays(way):
            for cell in others:
                yield from _gone(lava, way[: cell + 1], entered, way[cell], GO_TO_TARGET)


def _stays(way: Sequence[Cell]) -> list[list[int]]:
    """Return where on a way it is in its first room, in its second, and so on."""
    inside = [i for i, cell in enumerate(way) if room_of(cell) is not None]
    return [list(stay) for _, stay in groupby(inside, lambda i: room_of(way[i]))]


def _gone(
    lava: NDArray[np.bool_], way: Sequence[Cell], first: int, target: Cell, subgoal: Subgoal
) -> Iterator[Segment]:
    """Yield the last part of a way to a target, as a segment; nothing if the target lies on the way: it ends there."""
    if target in way[:-1]:
        return
    states, picture = [], _picture(lava, way[0], target)
    for i, cell in enumerate(way):
        picture[0], picture[1][cell] = 0, TRAIL
        picture[0][cell] = AGENT
        if i >= first:
            states.append(State(picture.copy(), list(cell)))
    actions = tuple(_action(way, i) for i in range(first + 1, len(way)))
    yield Segment(subgoal, tuple(states), actions, terminated=True)


def _action(way: Sequence[Cell], i: int) -> Action:
    """Return the step to the i-th cell of a way."""
    (row, column), (to_row, to_column) = way[i - 1], way[i]
    return MOVES.index((to_row - row, to_column - column))


def _ways(
    trajectory: Trajectory, good_subgoals: Sequence[Subgoal], lava: NDArray[np.bool_]
) -> Iterator[tuple[list[Cell], list[Subgoal]]]:
    """Yield the cells where good subgoals began that were carried out one after the other, with the last one's end."""
    cells: list[Cell] = []
    subgoals: list[Subgoal] = []
    for segment, good in zip(trajectory, good_subgoals, strict=True):
        here, there = cell_of(segment.start.view), cell_of(segment.states[-1].view)
        if room_of(here) is None:  # chosen in a door, by mistake
            continue
        cells.append(here)
        arrived = room_of(there) is not None and not lava[there]
        if segment.subgoal == good != GO_TO_TARGET and arrived and _rooms(segment)[1:] == [room_beside(here, good)]:
            subgoals.append(good)
        else:
            yield cells, subgoals
            cells, subgoals = [], []
    if cells:
        yield [*cells, there], subgoals


def _rooms(segment: Segment) -> list[Room]:
    """Return the rooms that a segment went through, in order; where lava is before a door, it may be a way around."""
    rooms = [room_of(cell_of(state.view)) for state in segment.states]
    return [room for room, _ in groupby(room for room in rooms if room is not None)]


def _others(lava: NDArray[np.bool_], here: Cell) -> list[Cell]:
    """Return the other free cells of a cell's room."""
    top, left = (ROOMS * (place // ROOMS) for place in here)
    room = [(top + row, left + column) for row in (1, 2, 3) for column in (1, 2, 3)]
    return [cell for cell in room if cell != here and not lava[cell]]


def _picture(lava: NDArray[np.bool_], agent: Cell, target: Cell) -> Picture:
    """Return the observation of an episode that begins."""
    picture = np.zeros((3, *lava.shape), np.float32)
    picture[1][lava] = LAVA
    picture[1][agent] = TRAIL
    picture[0][agent] = AGENT
    picture[2][target] = TARGET
    return picture


def _agent(observation: Picture) -> Cell:
    row, column = np.unravel_index(int(observation[0].argmax()), observation[0].shape)
    return int(row), int(column)


def _lava(size: int) -> Picture:
    picture = np.zeros((3, size, size), np.float32)
    picture[1] = LAVA
    return picture
