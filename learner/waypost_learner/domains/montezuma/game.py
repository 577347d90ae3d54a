"""The game in the Arcade Learning Environment, without sticky actions (paper, appendix).

The package `ale-py` emulates the game and has its ROM (`pip install 'waypost[atari]'`).
"""

from dataclasses import dataclass

import numpy as np
from ale_py import Action, ALEInterface, ALEState, LoggerMode, roms
from numpy.typing import NDArray

ACTIONS = ("noop", "jump", "up", "right", "left", "down", "jump_right", "jump_left")
_EMULATED = (
    Action.NOOP,
    Action.FIRE,
    Action.UP,
    Action.RIGHT,
    Action.LEFT,
    Action.DOWN,
    Action.RIGHTFIRE,
    Action.LEFTFIRE,
)
FRAME_SKIP = 4
DOOR_REWARD = 300
SKULL_RANGE = range(22, 73)  # where the skull rolls, in its own coordinate

# Addresses of the game's memory, found by comparing the memory with the screen.
_X, _Y, _SKULL_X, _SKULL_DIRECTION, _INVENTORY, _DYING = 42, 43, 47, 51, 65, 55
_MOTION = (86, 88, 89, 56, 53)  # the phase of a jump, how deep a fall is, and what the figure does

Grey = NDArray[np.uint8]
"""A grey screen, uint8[210, 160]."""
Picture = NDArray[np.uint8]
"""A screen in colors, uint8[210, 160, 3]."""

ALEInterface.setLoggerMode(LoggerMode.Error)


@dataclass(frozen=True)
class Memory:
    """What the game's memory says about the room. In almost every state, the next step depends on nothing else."""

    x: int
    y: int  # larger is higher
    motion: tuple[int, ...]  # five bytes: the phase of a jump, how deep a fall is, and what the figure does
    key: bool  # whether the figure has the key
    skull: tuple[int, int]  # the skull's x, and 8 if it rolls to the right, else 0
    dying: bool  # whether the figure has just lost its life


class Game:
    """The emulator in the first room.

    Args:
        frame_skip: the frames for which an action is held.
    """

    def __init__(self, frame_skip: int = FRAME_SKIP) -> None:
        self._ale = ALEInterface()
        self._ale.setInt("random_seed", 0)
        self._ale.setFloat("repeat_action_probability", 0.0)
        self._ale.setInt("frame_skip", frame_skip)
        rom = roms.get_rom_path("montezuma_revenge")
        assert rom is not None, "ale-py contains this game"
        self._ale.loadROM(rom)
        self._ale.reset_game()
        self._lives = self._ale.lives()
        self._start = self.snapshot()
        # The emulator draws no screen when it returns to a snapshot.
        self._first_grey: Grey = self._ale.getScreenGrayscale()
        self._first_picture: Picture = self._ale.getScreenRGB()
        self._at_start = True

    def reset(self) -> None:
        """Return to the start."""
        self.restore(self._start)
        self._at_start = True

    def act(self, action: int) -> int:
        """Hold an action for `frame_skip` frames; return the sum of their rewards."""
        self._at_start = False
        return int(self._ale.act(_EMULATED[action]))

    def grey(self) -> Grey:
        """Return the grey screen. After `restore` it is wrong until the next action."""
        return self._first_grey if self._at_start else self._ale.getScreenGrayscale()

    def picture(self) -> Picture:
        """Return the screen in colors. After `restore` it is wrong until the next action."""
        return self._first_picture if self._at_start else self._ale.getScreenRGB()

    def memory(self) -> Memory:
        """Return what the game's memory says."""
        ram = self._ale.getRAM()
        return Memory(
            int(ram[_X]),
            int(ram[_Y]),
            tuple(int(ram[address]) for address in _MOTION),
            bool(ram[_INVENTORY]),
            (int(ram[_SKULL_X]), int(ram[_SKULL_DIRECTION])),
            bool(ram[_DYING]) or self._ale.lives() < self._lives,
        )

    def place_skull(self, x: int, direction: int) -> None:
        """Move the skull: its x, and 8 if it rolls to the right, else 0."""
        self._ale.setRAM(_SKULL_X, x)
        self._ale.setRAM(_SKULL_DIRECTION, direction)

    def snapshot(self) -> bytes:
        """Return the whole state of the emulator."""
        return bytes(self._ale.cloneState().serialize())

    def restore(self, snapshot: bytes) -> None:
        """Return to a snapshot of any game."""
        self._at_start = False
        self._ale.restoreState(ALEState(snapshot))
