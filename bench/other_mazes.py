"""Measures the success of a run's policy on other kinds of mazes: `python bench/other_mazes.py RUN --store FILE`.

The script uses the unseen mazes of both sets, and 300 mazes of each other kind, which it draws with the given seed.
With `--values "fields.far=96 loop_penalty=1"`, a policy of the preset `general` spreads its fields that far, and leaves
loops. The script prints a table and asserts nothing.
"""

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from waypost_learner.domains.maze.files import save_mazes
from waypost_learner.domains.maze.maze import Maze, closed_rooms, distances_from, room_of, walls
from waypost_learner.runs.evaluation import evaluate, learner_of

N = 300  # mazes of each kind
_WALLS = list(walls())
_ROOM_CELLS = [(row, column) for row in range(17) for column in range(17) if room_of((row, column)) is not None]
Doors = Callable[[np.random.Generator], NDArray[np.bool_]]  # returns bool[24, 3]: which cells of each wall are doors


def one_each(opened: NDArray[np.bool_], rng: np.random.Generator) -> NDArray[np.bool_]:
    """Return one door in a random cell of each opened wall."""
    doors = np.zeros((len(_WALLS), 3), bool)
    doors[np.arange(len(_WALLS)), rng.integers(3, size=len(_WALLS))] = opened
    return doors


def many_ways(rng: np.random.Generator) -> NDArray[np.bool_]:
    """Open each wall with probability 0.7."""
    return one_each(rng.random(len(_WALLS)) < 0.7, rng)


def one_way(rng: np.random.Generator) -> NDArray[np.bool_]:
    """Open the walls of a random spanning tree of the rooms, so that exactly one path connects two rooms."""
    joined = {room: {room} for wall in _WALLS for room in wall[:2]}
    opened = np.zeros(len(_WALLS), bool)
    for number in rng.permutation(len(_WALLS)):
        first, second, _ = _WALLS[number]
        if joined[first] is not joined[second]:
            opened[number] = True
            joined[first] |= joined[second]
            for room in joined[second]:
                joined[room] = joined[first]
    return one_each(opened, rng)


def several_doors(rng: np.random.Generator) -> NDArray[np.bool_]:
    """Make each cell of a wall a door with probability 0.2, so a wall has up to three doors."""
    return rng.random((len(_WALLS), 3)) < 0.2


def draw(doors: Doors, least: int, number: int, seed: int) -> Iterator[Maze]:
    """Yield mazes with random start and goal whose shortest path has at least `least` steps, without end."""
    rng = np.random.default_rng([number, least, seed])
    while True:
        lava = closed_rooms()
        for is_open, (*_, cells) in zip(doors(rng), _WALLS, strict=True):
            for cell, door in zip(cells, is_open, strict=True):
                lava[cell] &= not door
        start, goal = (_ROOM_CELLS[int(n)] for n in rng.choice(len(_ROOM_CELLS), 2, replace=False))
        if distances_from(lava, goal)[start] >= least:
            yield Maze(lava, start, goal)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", nargs="?")
    parser.add_argument("--store", type=Path, default=Path("waypost.db"))
    parser.add_argument("--checkpoints", type=Path, help="the folder of checkpoints; default: beside the store")
    parser.add_argument("--values", help="values that replace the run's own, as for `waypost evaluate`")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the other kinds of mazes")
    parser.add_argument("--only", nargs="+", help="the kinds to measure, as the table names them; all by default")
    parser.add_argument("--threads", type=int, help="CPU threads; one per core by default")
    parser.add_argument("--save", type=Path, help="a folder to write the sets to, as .npz")
    arguments = parser.parse_args()
    if arguments.run is None:
        parser.exit(0, "Nothing was measured. Give the id of a run that has a checkpoint.\n")
    folder = arguments.checkpoints or arguments.store.with_name(f"{arguments.store.name}.checkpoints")
    path = folder / f"{arguments.run}.safetensors"
    learner, _ = learner_of(path, arguments.values, arguments.threads)
    kinds: dict[str, tuple[Doors, int]] = {
        "many paths, any length": (many_ways, 1),
        "many paths, at least 20 steps": (many_ways, 20),
        "one path, at least 40 steps": (one_way, 40),
        "one path, at least 45 steps": (one_way, 45),
        "several doors per wall": (several_doors, 20),
    }
    sets = {f"{name}, unseen": list(learner.domain.instances(name).test) for name in ("random", "corners")}
    for number, (name, (doors, least)) in enumerate(kinds.items()):
        drawn = draw(doors, least, number, arguments.seed)
        sets[name] = [next(drawn) for _ in range(N)]
        if arguments.save is not None:
            arguments.save.mkdir(parents=True, exist_ok=True)
            save_mazes(arguments.save / f"{name.replace(', ', '-').replace(' ', '-')}.npz", sets[name])
    unknown = set(arguments.only or ()) - sets.keys()
    if unknown:
        parser.error(f"there are no {', '.join(unknown)}; there are {', '.join(sets)}")
    print("| mazes | shortest path in steps, median (maximum) | success |")
    print("|---|---|---|")
    for name in arguments.only or sets:
        mazes = sets[name]
        lengths = [int(distances_from(maze.lava, maze.goal)[maze.start]) for maze in mazes]
        found = evaluate(learner, mazes, len(mazes))
        print(f"| {name} | {np.median(lengths):.0f} ({max(lengths)}) | {found.success_rate:.1%} |", flush=True)


if __name__ == "__main__":
    main()
