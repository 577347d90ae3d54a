"""Small views of the room for `lean`: where the last two pictures differ from the empty room.

They tell the learner what the background is. The figure, the skull and the missing key remain. The centered view also
tells where the figure is.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from waypost.domains import View
from waypost_learner.domains.montezuma.game import ACTIONS, Game
from waypost_learner.domains.montezuma.landmarks import SIZE, small

FRAMES_SEEN = 2
HALF = SIZE // 2
FLOOR = 60  # the first row in which the skull rolls
SKULL, FIGURE = (5, 5), (10, 6)  # rows and columns

Picture = NDArray[np.uint8]


def small_view(observation: Picture) -> Picture:
    """Return the view uint8[2, 42, 42] of an observation uint8[4, 84, 84]: the room in half the resolution."""
    return _halved(changed(observation))


def centered_view(observation: Picture) -> Picture:
    """Return the view uint8[4, 42, 42] of an observation uint8[4, 84, 84].

    The first two pictures show the surroundings of the figure in full resolution, the others the room in half of it.
    """
    differing = changed(observation)
    row, column = figure_at(differing[-1])
    padded = np.pad(differing, ((0, 0), (HALF // 2, HALF // 2), (HALF // 2, HALF // 2)))
    around = padded[:, row : row + HALF, column : column + HALF]
    return np.concatenate([around, _halved(differing)])


def figure_at(differing: Picture) -> tuple[int, int]:
    """Return the row and the column of the figure in a picture uint8[84, 84] of what differs from the empty room.

    The skull is the brightest spot above the floor. Apart from it, and from things that change where they are, the
    figure is the brightest spot.
    """
    row, column = _brightest(differing[FLOOR:], SKULL)
    others = differing * _free()
    others[FLOOR + row - 2 : FLOOR + row + 7, max(0, column - 2) : column + 7] = 0  # the skull and a margin
    row, column = _brightest(others, FIGURE)
    return row + FIGURE[0] // 2, column + FIGURE[1] // 2


def changed(observation: Picture) -> Picture:
    """Return how much the last two pictures differ from the empty room, uint8[2, 84, 84]."""
    seen, room = observation[-FRAMES_SEEN:], _empty_room()
    return np.maximum(seen, room) - np.minimum(seen, room)


def _halved(differing: Picture) -> Picture:
    rows = np.maximum(differing[:, ::2], differing[:, 1::2])  # ten times faster than a maximum over axes
    return np.maximum(rows[:, :, ::2], rows[:, :, 1::2])


def _brightest(picture: Picture, size: tuple[int, int]) -> tuple[int, int]:
    """Return the upper left corner of the brightest box of this size."""
    rows, columns = size
    sums = np.pad(picture.cumsum(0, dtype=np.int64).cumsum(1), ((1, 0), (1, 0)))
    boxes = sums[rows:, columns:] - sums[:-rows, columns:] - sums[rows:, :-columns] + sums[:-rows, :-columns]
    row, column = np.unravel_index(boxes.argmax(), boxes.shape)
    return int(row), int(column)


@cache
def _free() -> Picture:
    """Return 0 where things change and stay where they are, else 1, uint8[84, 84]."""
    free = np.ones((SIZE, SIZE), np.uint8)
    free[:19] = 0  # the score, and what the figure carries
    free[38:47, 5:13] = 0  # the key
    free[54:57, 30:53] = 0  # the belt
    return free


@cache
def _empty_room() -> Picture:
    """Return the room without the figure and the skull, uint8[84, 84]: what most of three pictures show."""
    game, pictures = Game(), list[Picture]()
    for _ in range(3):
        pictures.append(small(game.grey()))
        for _ in range(12):
            game.act(ACTIONS.index("down"))  # the figure climbs down the ladder in the middle
    room: Picture = np.median(pictures, axis=0).astype(np.uint8)
    return room


SMALL_VIEW = View((FRAMES_SEEN, HALF, HALF), small_view)
CENTERED_VIEW = View((2 * FRAMES_SEEN, HALF, HALF), centered_view)
