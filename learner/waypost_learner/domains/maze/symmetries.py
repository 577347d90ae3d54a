"""Defines the rotations and reflections of a maze, and their effect on subgoals and actions."""

import numpy as np
from numpy.typing import NDArray

from waypost.domains import Symmetry
from waypost_learner.domains.maze.maze import GO_TO_TARGET, MOVES


def symmetries() -> tuple[Symmetry, ...]:
    """Return the seven symmetries of the square, without the identity."""
    return tuple(_symmetry(turns, mirror) for mirror in (False, True) for turns in range(4) if turns or mirror)


def _symmetry(turns: int, mirror: bool) -> Symmetry:
    """Return the symmetry: mirror left and right (if `mirror`), then `turns` quarter turns counterclockwise."""

    def observe(observation: NDArray[np.float32]) -> NDArray[np.float32]:
        picture = observation[:, :, ::-1] if mirror else observation
        return np.ascontiguousarray(np.rot90(picture, turns, axes=(1, 2)))

    def direction(move: tuple[int, int]) -> int:
        row, column = move
        column = -column if mirror else column
        for _ in range(turns):
            row, column = -column, row
        return MOVES.index((row, column))

    actions = tuple(direction(move) for move in MOVES)
    return Symmetry(observe, (*actions, GO_TO_TARGET), actions)
