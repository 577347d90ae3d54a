"""Derives more training data from labels and demonstrations in a maze: labels of other tasks on the same path.

Relabeling is not part of the paper, and the `paper` preset does not use it. It assumes that paths are reversible and
that parts of shortest paths are shortest paths.
"""

from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise

import numpy as np
from numpy.typing import NDArray

from waypost.domains import FlatRelabeled, Relabeled
from waypost.trajectory import Action, Segment, State, Subgoal, Trajectory
from waypost_learner.domains.maze.env import AGENT, LAVA, TARGET, TRAIL
from waypost_learner.domains.maze.maze import GO_TO_TARGET, MOVES, PITCH, Cell, Room, cell_of, room_beside, room_of

OPPOSITE = 1  # direction ^ OPPOSITE is the opposite direction


def relabeled(trajectory: Trajectory, good_subgoals: Sequence[Subgoal]) -> Iterator[Relabeled]:
    """Yield labels of other tasks: from each place on a labeled path to each other place on it, in both directions.

    A part of a shortest path is a shortest path, and so is its reverse. If the episode took detours within rooms, a
    label's path may not be the shortest, but it is never longer than the learner's path.
    """
    lava = trajectory[0].start.observation[1] == LAVA
    for cells, subgoals in _labeled_paths(trajectory, good_subgoals, lava):
        for i, here in enumerate(cells):
            for j, target in enumerate(cells):
                if j != i:
                    yield _start_observation(lava, here, target), subgoals[i] if j > i else subgoals[i - 1] ^ OPPOSITE
            for target in _other_cells_of_room(lava, here):
                yield _start_observation(lava, here, target), GO_TO_TARGET


def relabeled_actions(trajectory: Trajectory, good_actions: Sequence[Action]) -> Iterator[FlatRelabeled]:
    """Yield labels of other tasks for a flat learner: from each cell on a labeled path to each other cell on it.

    A labeled path is a part of the trajectory in which the learner did what the label says. It is used in both
    directions. Like the views of mu, the observations have no trail but the agent's own cell.
    """
    lava = trajectory[0].start.observation[1] == LAVA
    for path in _good_paths(trajectory, good_actions, lava):
        for i, here in enumerate(path):
            for j, target in enumerate(path):
                if here != target:
                    step = path[i + 1] if j > i else path[i - 1]
                    yield _start_observation(lava, here, target), _action_between(here, step)


def retraced(demonstration: Trajectory) -> Iterator[Segment]:
    """Yield segments of other tasks: the way back, room by room, and the way to each cell as if it were the target.

    The segment to a cell begins where the path enters the cell's room. The path is used in both directions. The trail
    in the observations contains the path up to the current cell. Only the path after the last lava is used.
    """
    lava = demonstration[0].start.observation[1] == LAVA
    forward = [cell_of(demonstration[0].start.view)]
    forward += [cell_of(state.view) for segment in demonstration for state in segment.states[1:]]
    if lava[forward[-1]]:
        forward.pop()
    forward = forward[max((i + 1 for i, cell in enumerate(forward) if lava[cell]), default=0) :]
    backward = forward[::-1]
    for visit, beyond in pairwise(_room_visits(backward)):
        yield from _segment_to(lava, backward[: beyond[0] + 1], visit[0], backward[-1], _action_at(backward, beyond[0]))
    for path in (forward, backward):
        for entered, *others in _room_visits(path):
            for cell in others:
                yield from _segment_to(lava, path[: cell + 1], entered, path[cell], GO_TO_TARGET)


def _room_visits(path: Sequence[Cell]) -> list[list[int]]:
    """Return the indices of the path's cells in its first room, in its second room, and so on."""
    inside = [i for i, cell in enumerate(path) if room_of(cell) is not None]
    return [list(visit) for _, visit in groupby(inside, lambda i: room_of(path[i]))]


def _segment_to(
    lava: NDArray[np.bool_], path: Sequence[Cell], first: int, target: Cell, subgoal: Subgoal
) -> Iterator[Segment]:
    """Yield the path from its cell `first` on as one segment toward a subgoal, in a maze with this target.

    Yield nothing if the path passes the target before its end, because the episode would end there.
    """
    if target in path[:-1]:
        return
    states, picture = [], _start_observation(lava, path[0], target)
    for i, cell in enumerate(path):
        picture[0], picture[1][cell] = 0, TRAIL
        picture[0][cell] = AGENT
        if i >= first:
            states.append(State(picture.copy(), list(cell)))
    actions = tuple(_action_at(path, i) for i in range(first + 1, len(path)))
    yield Segment(subgoal, tuple(states), actions, terminated=True)


def _action_at(path: Sequence[Cell], i: int) -> Action:
    """Return the action that leads to the i-th cell of a path."""
    return _action_between(path[i - 1], path[i])


def _action_between(cell: Cell, to: Cell) -> Action:
    """Return the action that leads from a cell to the cell beside it."""
    return MOVES.index((to[0] - cell[0], to[1] - cell[1]))


def _good_paths(
    trajectory: Trajectory, good_actions: Sequence[Action], lava: NDArray[np.bool_]
) -> Iterator[list[Cell]]:
    """Yield the cells of each longest part of a trajectory in which every action was good."""
    segments = [(segment.states[:-1], segment.actions) for segment in trajectory]
    cells = [cell_of(state.view) for states, _ in segments for state in states]
    cells.append(cell_of(trajectory[-1].states[-1].view))
    taken = [action for _, actions in segments for action in actions]
    path = cells[:1]
    for action, good, there in zip(taken, good_actions, cells[1:], strict=True):
        if action == good and there != path[-1] and not lava[there]:
            path.append(there)
        else:
            yield path
            path = [there]
    yield path


def _labeled_paths(
    trajectory: Trajectory, good_subgoals: Sequence[Subgoal], lava: NDArray[np.bool_]
) -> Iterator[tuple[list[Cell], list[Subgoal]]]:
    """Yield each sequence of successive good subgoals that were reached: the cells where they began, and the subgoals.

    The last cell of a sequence is where its last subgoal ended.
    """
    cells: list[Cell] = []
    subgoals: list[Subgoal] = []
    for segment, good in zip(trajectory, good_subgoals, strict=True):
        here, there = cell_of(segment.start.view), cell_of(segment.states[-1].view)
        if room_of(here) is None:  # the learner chose a subgoal in a door by mistake
            continue
        cells.append(here)
        arrived = room_of(there) is not None and not lava[there]
        if (
            segment.subgoal == good != GO_TO_TARGET
            and arrived
            and _rooms_visited(segment)[1:] == [room_beside(here, good)]
        ):
            subgoals.append(good)
        else:
            yield cells, subgoals
            cells, subgoals = [], []
    if cells:
        yield [*cells, there], subgoals


def _rooms_visited(segment: Segment) -> list[Room | None]:
    """Return the rooms of a segment in order. If lava blocks a door, the path may lead through other rooms."""
    path = [cell_of(state.view) for state in segment.states]
    return [room_of(path[first]) for first, *_ in _room_visits(path)]


def _other_cells_of_room(lava: NDArray[np.bool_], here: Cell) -> list[Cell]:
    """Return the other free cells of a cell's room."""
    top, left = (PITCH * (place // PITCH) for place in here)
    room = [(top + row, left + column) for row in (1, 2, 3) for column in (1, 2, 3)]
    return [cell for cell in room if cell != here and not lava[cell]]


def _start_observation(lava: NDArray[np.bool_], agent: Cell, target: Cell) -> NDArray[np.float32]:
    """Return the first observation of an episode, float32[3, 17, 17]."""
    picture = np.zeros((3, *lava.shape), np.float32)
    picture[1][lava] = LAVA
    picture[1][agent] = TRAIL
    picture[0][agent] = AGENT
    picture[2][target] = TARGET
    return picture
