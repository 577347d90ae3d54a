"""What labels and demonstrations of a maze say of other tasks on the same way.

None of it is the paper's, and the `paper` preset uses none. It takes for granted that ways can be gone back, and that
parts of shortest ways are shortest.
"""

from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from waypost.domain import Relabeled
from waypost.trajectory import Action, Segment, State, Subgoal, Trajectory
from waypost_learner.domains.maze.env import AGENT, LAVA, TARGET, TRAIL
from waypost_learner.domains.maze.maze import GO_TO_TARGET, MOVES, ROOMS, Cell, Room, cell_of, room_beside, room_of

BACK = 1  # flips the number of a direction to that of its opposite


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


def _rooms(segment: Segment) -> list[Room | None]:
    """Return the rooms that a segment went through, in order; where lava is before a door, it may be a way around."""
    way = [cell_of(state.view) for state in segment.states]
    return [room_of(way[first]) for first, *_ in _stays(way)]


def _others(lava: NDArray[np.bool_], here: Cell) -> list[Cell]:
    """Return the other free cells of a cell's room."""
    top, left = (ROOMS * (place // ROOMS) for place in here)
    room = [(top + row, left + column) for row in (1, 2, 3) for column in (1, 2, 3)]
    return [cell for cell in room if cell != here and not lava[cell]]


def _picture(lava: NDArray[np.bool_], agent: Cell, target: Cell) -> NDArray[np.float32]:
    """Return the observation of an episode that begins."""
    picture = np.zeros((3, *lava.shape), np.float32)
    picture[1][lava] = LAVA
    picture[1][agent] = TRAIL
    picture[0][agent] = AGENT
    picture[2][target] = TARGET
    return picture
