"""How many steps a second the maze environment takes: `python bench/environment.py`.

Beside it, in the same run, a bare limit: the same moves and the same observations in a plain numpy loop without
gymnasium. Speeds are the best of several rounds, ratios the median over the rounds. MiniGrid's FourRooms, the nearest
public environment, is measured too where `minigrid` is installed. Prints a table; asserts nothing.
"""

import argparse
import importlib.util
import os
import platform
import statistics
import time
from collections.abc import Callable
from pathlib import Path

import gymnasium
import numpy as np

from learner.domains.maze.env import AGENT, LAVA, MAX_STEPS, TARGET, TRAIL, MazeEnv
from learner.domains.maze.generator import maze_set
from learner.domains.maze.maze import MOVES, SIZE

BATCH = 16
ROUNDS = 5
Loop = Callable[[int], None]


def machine() -> str:
    """The processor, its cores, and how busy it is with other things."""
    info = Path("/proc/cpuinfo")
    models = [line.split(":")[1].strip() for line in info.read_text().splitlines() if "model name" in line]
    load = os.getloadavg()[0]
    model = models[0] if models else platform.processor()
    return (
        f"{model}, {os.cpu_count()} cores, load {load:.1f}, Python {platform.python_version()}, numpy {np.__version__}"
    )


def single(env: gymnasium.Env) -> Loop:
    """Random actions in one environment, reset where episodes end."""

    def loop(steps: int) -> None:
        actions = np.random.default_rng(0).integers(env.action_space.n, size=steps)
        env.reset(seed=0)
        for action in actions:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()

    return loop


def batched(make: Callable[[], gymnasium.Env]) -> Loop:
    """Random actions in a vector of environments."""
    vector = gymnasium.vector.SyncVectorEnv([make] * BATCH)

    def loop(steps: int) -> None:
        actions = np.random.default_rng(0).integers(vector.single_action_space.n, size=(steps // BATCH, BATCH))
        vector.reset(seed=0)
        for action in actions:
            vector.step(action)

    return loop


def bare(steps: int) -> None:
    """The limit: moves, pixels and a copy of them, in plain Python and numpy."""
    mazes = maze_set("random")[0]
    rng = np.random.default_rng(0)
    done, count = True, 0
    for action in rng.integers(4, size=steps).tolist():
        if done:
            maze = mazes[rng.integers(len(mazes))]
            pixels = np.zeros((3, SIZE, SIZE), np.float32)
            pixels[1][maze.lava] = LAVA
            pixels[2][maze.goal] = TARGET
            row, column = maze.start
            count = 0
        pixels[0, row, column] = 0
        row, column = row + MOVES[action][0], column + MOVES[action][1]
        count += 1
        burnt = maze.lava[row, column]
        pixels[0, row, column] = AGENT
        if not burnt:
            pixels[1, row, column] = TRAIL
        done = burnt or (row, column) == maze.goal or count >= MAX_STEPS
        pixels.copy()


def bare_batched(steps: int) -> None:
    """The limit for a vector: the same, for all mazes at once."""
    mazes = maze_set("random")[0]
    rng = np.random.default_rng(0)
    moves, rows = np.array(MOVES), np.arange(BATCH)
    lava = np.stack([maze.lava for maze in mazes])
    goals, starts = np.array([maze.goal for maze in mazes]), np.array([maze.start for maze in mazes])
    first = np.zeros((len(mazes), 3, SIZE, SIZE), np.float32)
    first[:, 1][lava] = LAVA
    first[np.arange(len(mazes)), 2, *goals.T] = TARGET
    chosen = rng.integers(len(mazes), size=BATCH)
    pixels, cells, counts = first[chosen], starts[chosen], np.zeros(BATCH, int)
    for actions in rng.integers(4, size=(steps // BATCH, BATCH)):
        pixels[rows, 0, *cells.T] = 0
        cells = cells + moves[actions]
        counts += 1
        burnt = lava[chosen, *cells.T]
        pixels[rows, 0, *cells.T] = AGENT
        pixels[rows, 1, *cells.T] = np.where(burnt, LAVA, TRAIL)
        done = burnt | (cells == goals[chosen]).all(1) | (counts >= MAX_STEPS)
        pixels.copy()
        if done.any():
            (ended,) = done.nonzero()
            chosen[ended] = rng.integers(len(mazes), size=len(ended))
            pixels[ended], cells[ended], counts[ended] = first[chosen[ended]], starts[chosen[ended]], 0


def steps_a_second(loop: Loop, steps: int) -> float:
    """Measure one round."""
    began = time.perf_counter()
    loop(steps)
    return steps / (time.perf_counter() - began)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--steps", type=int, default=20_000, help="steps a round")
    steps = parser.parse_args().steps
    maze_set("random")
    rows: list[tuple[str, Loop, str | None]] = [
        ("bare numpy, one maze", bare, None),
        ("MazeEnv, one", single(MazeEnv()), "bare numpy, one maze"),
        (f"bare numpy, {BATCH} mazes at once", bare_batched, None),
        (f"MazeEnv, SyncVectorEnv of {BATCH}", batched(MazeEnv), f"bare numpy, {BATCH} mazes at once"),
    ]
    if importlib.util.find_spec("minigrid"):
        import minigrid  # noqa: F401 - registers its environments

        rows.append(("MiniGrid-FourRooms-v0, one", single(gymnasium.make("MiniGrid-FourRooms-v0")), "MazeEnv, one"))
    speeds: dict[str, list[float]] = {name: [] for name, *_ in rows}
    for _ in range(ROUNDS):  # in turns, so that each ratio is of figures taken side by side
        for name, loop, _ in rows:
            speeds[name].append(steps_a_second(loop, steps))
    print(machine())
    print("| environment | steps/s | beside | ratio |")
    print("|---|---|---|---|")
    for name, _, limit in rows:
        ratio = (
            f"{statistics.median(a / b for a, b in zip(speeds[name], speeds[limit], strict=True)):.2f}" if limit else ""
        )
        print(f"| {name} | {max(speeds[name]):,.0f} | {limit or ''} | {ratio} |")


if __name__ == "__main__":
    main()
