"""Maze sets in files: what was saved comes back, and what is no maze set is refused by the name of its fault."""

import pickle
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.files import load_mazes, save_mazes
from waypost_learner.domains.maze.generator import maze_set

Arrays = dict[str, np.ndarray]


def arrays() -> Arrays:
    """Three good mazes."""
    mazes = maze_set("random")[0][:3]
    return {
        "lava": np.stack([maze.lava for maze in mazes]),
        "start": np.array([maze.start for maze in mazes], np.int8),
        "goal": np.array([maze.goal for maze in mazes], np.int8),
    }


def saved(path: Path, contents: Arrays) -> Path:
    file = path / "mazes.npz"
    np.savez(file, **contents)  # type: ignore[arg-type]
    return file


def test_mazes_come_back_as_they_were_saved(tmp_path: Path) -> None:
    mazes = list(maze_set("corners")[1][:20])
    save_mazes(tmp_path / "mazes.npz", mazes)
    assert [maze.to_json() for maze in load_mazes(tmp_path / "mazes.npz")] == [maze.to_json() for maze in mazes]


def test_a_file_is_trained_and_tested_on_alike(tmp_path: Path) -> None:
    sets = MazeDomain().instances(str(saved(tmp_path, arrays())))
    assert sets.train == sets.test
    assert len(sets.train) == 3


def test_integers_of_any_size_do_for_start_and_goal(tmp_path: Path) -> None:
    contents = arrays() | {"start": arrays()["start"].astype(np.int64), "goal": arrays()["goal"].astype(np.uint8)}
    (maze, *_) = load_mazes(saved(tmp_path, contents))
    assert maze.start == tuple(arrays()["start"][0])
    assert all(type(line) is int for line in (*maze.start, *maze.goal))


def without(name: str) -> Callable[[Arrays], Any]:
    return lambda contents: contents.pop(name)


def instead(name: str, change: Callable[[np.ndarray], np.ndarray]) -> Callable[[Arrays], Any]:
    return lambda contents: contents.update({name: change(contents[name])})


def at(place: Any, value: Any) -> Callable[[np.ndarray], np.ndarray]:
    def change(array: np.ndarray) -> np.ndarray:
        changed = array.copy()
        changed[place] = value
        return changed

    return change


def wall_in(contents: Arrays) -> None:
    """Close the middle maze's start in."""
    row, column = (int(line) for line in contents["start"][1])
    lava = contents["lava"].copy()
    lava[1] = True
    lava[1, row, column] = False
    lava[1][tuple(contents["goal"][1])] = False
    contents["lava"] = lava


FAULTS: list[tuple[str, Callable[[Arrays], Any], str]] = [
    ("no lava", without("lava"), "has no array `lava` (it has: start, goal)"),
    ("no start", without("start"), "has no array `start` (it has: lava, goal)"),
    ("no goal", without("goal"), "has no array `goal` (it has: lava, start)"),
    ("lava in integers", instead("lava", lambda a: a.astype(int)), "`lava` must be bool[N, 17, 17], it is int64"),
    ("start in floats", instead("start", lambda a: a.astype(float)), "`start` must be integer[N, 2], it is float64"),
    ("goal in booleans", instead("goal", lambda a: a > 0), "`goal` must be integer[N, 2], it is bool"),
    ("small mazes", instead("lava", lambda a: a[:, :16, :16]), "`lava` must be bool[N, 17, 17], it is bool[3, 16, 16]"),
    ("one maze alone", instead("lava", lambda a: a[0]), "`lava` must be bool[N, 17, 17], it is bool[17, 17]"),
    ("a number for lava", instead("lava", lambda a: a[0, 0, 0]), "`lava` must be bool[N, 17, 17], it is bool[]"),
    ("three lines", instead("start", lambda a: np.c_[a, a[:, :1]]), "`start` must be integer[N, 2], it is int8[3, 3]"),
    ("no mazes", instead("lava", lambda a: a[:0]), "`lava` has no mazes"),
    ("too few starts", instead("start", lambda a: a[:2]), "`start` has 2 rows, but `lava` has 3 mazes"),
    ("too many goals", instead("goal", lambda a: np.r_[a, a]), "`goal` has 6 rows, but `lava` has 3 mazes"),
    (
        "start on lava",
        instead("start", at(1, (0, 5))),
        "`start` of maze 1 is (0, 5), which is not a free cell of a room",
    ),
    ("start outside", instead("start", at(2, (5, 17))), "`start` of maze 2 is (5, 17)"),
    ("start below zero", instead("start", at(0, (-1, 3))), "`start` of maze 0 is (-1, 3)"),
    ("goal on a wall line", instead("goal", at(1, (4, 4))), "`goal` of maze 1 is (4, 4)"),
    ("goal at the start", lambda contents: contents.update(goal=contents["start"]), "`goal` of maze 0 is its start"),
    ("an open outer wall", instead("lava", at((1, 0, 5), False)), "`lava` of maze 1 must close the outer wall"),
    ("open crossings", instead("lava", at((2, 4, 8), False)), "`lava` of maze 2 must cover the cells where walls meet"),
    ("no path", wall_in, "`lava` of maze 1 leaves no path from start to goal"),
]


@pytest.mark.parametrize(("fault", "message"), [fault[1:] for fault in FAULTS], ids=[fault[0] for fault in FAULTS])
def test_a_file_that_is_no_maze_set_is_refused_by_the_array_at_fault(
    tmp_path: Path, fault: Callable[[Arrays], Any], message: str
) -> None:
    contents = arrays()
    fault(contents)
    with pytest.raises(ValueError, match=r"mazes\.npz") as refusal:
        load_mazes(saved(tmp_path, contents))
    assert message in str(refusal.value)
    assert "\n" not in str(refusal.value)


class Trap:
    def __reduce__(self) -> Any:
        return (pytest.fail, ("a pickle was opened",))


def a_pickle(file: Path) -> None:
    file.write_bytes(pickle.dumps(Trap()))


def pickled_array(file: Path) -> None:
    np.savez(file, **(arrays() | {"lava": np.array([Trap()], dtype=object)}))  # type: ignore[arg-type]


def a_bare_array(file: Path) -> None:
    with file.open("wb") as stream:
        np.save(stream, arrays()["lava"])


def a_foreign_zip(file: Path) -> None:
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("lava.npy", "no array")
        archive.writestr("start.npy", "no array")


def damaged_inside(file: Path) -> None:
    """A good archive whose compressed arrays are not what they say."""
    np.savez_compressed(file, **arrays())  # type: ignore[arg-type]
    with zipfile.ZipFile(file) as archive:
        start = archive.getinfo("lava.npy").header_offset + 60
    contents = bytearray(file.read_bytes())
    contents[start : start + 40] = bytes(40)
    file.write_bytes(bytes(contents))


def torn(file: Path) -> None:
    save_mazes(file, list(maze_set("random")[0][:5]))
    file.write_bytes(file.read_bytes()[:300])


def text(file: Path) -> None:
    file.write_text("a maze")


def empty(file: Path) -> None:
    file.write_bytes(b"")


def a_folder(file: Path) -> None:
    file.mkdir()


@pytest.mark.parametrize(
    "make", [a_pickle, pickled_array, a_bare_array, a_foreign_zip, torn, text, empty, a_folder, damaged_inside]
)
def test_a_file_that_is_no_npz_of_plain_arrays_is_refused_and_no_pickle_is_opened(
    tmp_path: Path, make: Callable[[Path], None]
) -> None:
    file = tmp_path / "mazes.npz"
    make(file)
    with pytest.raises(ValueError, match=r"mazes\.npz( is no maze set|: `lava` must be bool)") as refusal:
        load_mazes(file)
    assert "\n" not in str(refusal.value)


def test_a_missing_file_is_refused_by_its_name(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"there is no file .*none\.npz"):
        load_mazes(tmp_path / "none.npz")


def test_instances_that_do_not_exist_are_refused_with_those_that_do() -> None:
    with pytest.raises(ValueError, match=r"'circles'; use random, corners, .*or an \.npz file"):
        MazeDomain().instances("circles")
