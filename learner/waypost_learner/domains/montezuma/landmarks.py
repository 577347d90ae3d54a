"""The paper's detectors: a landmark is reached when at least 30 % of the pixels in its box have changed.

The boxes are those of the authors' code. A picture does not always tell enough, so the game's memory is asked too: the
key's box also changes while the figure stands in front of the key, and the door's while the figure waits at the shut
door.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

SIZE = 84
SHARE = 0.3  # of the pixels in a box

Grey = NDArray[np.uint8]


@dataclass(frozen=True)
class Box:
    """A box of a picture with 84 x 84 pixels; the right and the lower end are outside."""

    left: int
    top: int
    right: int
    bottom: int

    @property
    def shares(self) -> tuple[float, float, float, float]:
        """The left, upper, right and lower side, as shares of the picture."""
        return self.left / SIZE, self.top / SIZE, self.right / SIZE, self.bottom / SIZE

    def changed(self, grey: Grey, before: Grey) -> bool:
        """Return whether at least 30 % of the pixels in the box differ between two pictures uint8[84, 84]."""
        part = slice(self.top, self.bottom), slice(self.left, self.right)
        return bool((grey[part] != before[part]).mean() >= SHARE)


STAIR, KEY, DOOR = Box(69, 68, 73, 71), Box(7, 41, 11, 45), Box(70, 20, 73, 35)


def small(screen: Grey) -> Grey:
    """Return a grey screen uint8[210, 160] as uint8[84, 84]."""
    return np.asarray(Image.fromarray(screen).resize((SIZE, SIZE), Image.Resampling.BILINEAR))
