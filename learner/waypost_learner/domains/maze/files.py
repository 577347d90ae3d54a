"""Reads and writes maze sets as files.

A file is an `.npz` with `lava` bool[N, 17, 17], `start` int8[N, 2] and `goal` int8[N, 2]; cells are (row, column).
"""

import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.maze.maze import PITCH, SIZE, Maze, distances_from, room_of

_SHAPES: dict[str, tuple[int, ...]] = {"lava": (SIZE, SIZE), "start": (2,), "goal": (2,)}


def save_mazes(path: Path, mazes: list[Maze]) -> None:
    """Write mazes to a file."""
    np.savez_compressed(
        path,
        lava=np.stack([maze.lava for maze in mazes]),
        start=np.array([maze.start for maze in mazes], np.int8),
        goal=np.array([maze.goal for maze in mazes], np.int8),
    )


def load_mazes(path: Path) -> list[Maze]:
    """Return the mazes of a file.

    Raises:
        ValueError: the file is not a valid maze set; the message names the invalid array.
    """
    try:
        with path.open("rb") as stream:
            loaded = np.load(stream, allow_pickle=False)
            if not isinstance(loaded, np.lib.npyio.NpzFile):
                raise ValueError("a single array")
            arrays = {name: np.asarray(loaded[name]) for name in loaded.files}
    except FileNotFoundError as error:
        raise ValueError(f"there is no file {path}") from error
    except (OSError, EOFError, ValueError, zipfile.BadZipFile, zlib.error) as error:
        raise ValueError(f"{path} is no maze set: it must be an .npz file of plain arrays, without pickles") from error
    lava, start, goal = (_checked(path, arrays, name) for name in _SHAPES)
    if not len(lava):
        raise ValueError(f"{path} is an empty maze set: `lava` has no mazes")
    for name, array in (("start", start), ("goal", goal)):
        if len(array) != len(lava):
            raise ValueError(f"{path}: `{name}` has {len(array)} rows, but `lava` has {len(lava)} mazes")
    return [_maze(path, i, lava[i], start[i], goal[i]) for i in range(len(lava))]


def _checked(path: Path, arrays: dict[str, NDArray[Any]], name: str) -> NDArray[Any]:
    if name not in arrays:
        raise ValueError(f"{path} is no maze set: it has no array `{name}` (it has: {', '.join(arrays) or 'none'})")
    array = arrays[name]
    wanted = "bool" if name == "lava" else "integer"
    fits = array.dtype == bool if name == "lava" else np.issubdtype(array.dtype, np.integer)
    if not fits or array.shape[1:] != _SHAPES[name]:
        shape = ", ".join(map(str, _SHAPES[name]))
        raise ValueError(f"{path}: `{name}` must be {wanted}[N, {shape}], it is {array.dtype}{list(array.shape)}")
    return array


def _maze(path: Path, i: int, lava: NDArray[np.bool_], start: NDArray[Any], goal: NDArray[Any]) -> Maze:
    border = np.ones((SIZE, SIZE), bool)
    border[1:-1, 1:-1] = False
    if not lava[border].all():
        raise ValueError(f"{path}: `lava` of maze {i} must close the outer wall")
    if not lava[::PITCH, ::PITCH].all():
        raise ValueError(f"{path}: `lava` of maze {i} must cover the cells where walls meet, (0, 4), (4, 4) and so on")
    ends = {}
    for name, (row, column) in (("start", start.tolist()), ("goal", goal.tolist())):
        if not (0 <= row < SIZE and 0 <= column < SIZE) or room_of((row, column)) is None or lava[row, column]:
            raise ValueError(f"{path}: `{name}` of maze {i} is ({row}, {column}), which is not a free cell of a room")
        ends[name] = (row, column)
    if ends["start"] == ends["goal"]:
        raise ValueError(f"{path}: `goal` of maze {i} is its start")
    if distances_from(lava, ends["start"])[ends["goal"]] < 0:
        raise ValueError(f"{path}: `lava` of maze {i} leaves no path from start to goal")
    return Maze(lava, ends["start"], ends["goal"])
