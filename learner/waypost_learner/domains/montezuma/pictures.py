"""Pictures of the room for people: the screen in its usual shape, with a box around each landmark."""

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.montezuma.game import Picture
from waypost_learner.domains.montezuma.landmarks import DOOR, KEY, SIZE, STAIR

_WIDTH, _HEIGHT = 320, 210  # the game's pixels are twice as wide as they are high
_COLOR = (255, 255, 255)


def framed(screen: Picture) -> NDArray[np.uint8]:
    """Return a screen uint8[210, 160, 3] as uint8[210, 320, 3] with the landmarks' boxes."""
    picture = np.repeat(screen, _WIDTH // screen.shape[1], axis=1)
    for box in (STAIR, KEY, DOOR):
        left, right = (round(x * _WIDTH / SIZE) for x in (box.left, box.right))
        top, bottom = (round(y * _HEIGHT / SIZE) for y in (box.top, box.bottom))
        picture[[top, bottom], left : right + 1] = _COLOR
        picture[top : bottom + 1, [left, right]] = _COLOR
    return picture
