"""A small view of the room for `lean`: where the last two pictures differ from the empty room.

It tells the learner what the background is. The figure, the skull and the missing key remain.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray

from waypost.domains import View
from waypost_learner.domains.montezuma.game import ACTIONS, Game
from waypost_learner.domains.montezuma.landmarks import SIZE, small

FRAMES_SEEN = 2
HALF = SIZE // 2


def small_view(observation: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the view uint8[2, 42, 42] of an observation uint8[4, 84, 84]."""
    seen, room = observation[-FRAMES_SEEN:], _empty_room()
    changed = np.maximum(seen, room) - np.minimum(seen, room)
    halved: NDArray[np.uint8] = changed.reshape(FRAMES_SEEN, HALF, 2, HALF, 2).max(axis=(2, 4))
    return halved


@cache
def _empty_room() -> NDArray[np.uint8]:
    """Return the room without the figure and the skull, uint8[84, 84]: what most of three pictures show."""
    game, pictures = Game(), list[NDArray[np.uint8]]()
    for _ in range(3):
        pictures.append(small(game.grey()))
        for _ in range(12):
            game.act(ACTIONS.index("down"))  # the figure climbs down the ladder in the middle
    room: NDArray[np.uint8] = np.median(pictures, axis=0).astype(np.uint8)
    return room


SMALL_VIEW = View((FRAMES_SEEN, HALF, HALF), small_view)
