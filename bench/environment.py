"""Measures the steps per second of the maze environment: `python bench/environment.py`.

The script compares the environment with two others in the same run. The first is an upper limit: the same moves and
observations in a plain numpy loop without gymnasium. The second is MiniGrid's FourRooms, the most similar public
environment, in a separate virtual environment. Its steps do different work (`peers/four_rooms.py`), so the comparison
is only a rough one. All actions are random. Speeds are the best of several rounds; ratios are medians over the rounds.
The script prints tables and asserts nothing.
"""

import argparse
import os
import platform
import statistics
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

import gymnasium
import numpy as np
from bench.peers.client import Missing, Peer
from bench.peers.stepping import random_steps

from waypost_learner.domains.maze.env import AGENT, LAVA, MAX_STEPS, TARGET, TRAIL, MazeEnv
from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.domains.maze.maze import MOVES, SIZE

BATCH = 16
ROUNDS = 5
FEWER = 10  # FourRooms takes a tenth of the steps
FORMS = ("unwrapped", "as made", "ImgObsWrapper", "FullyObsWrapper")
ONE, VECTOR = "MazeEnv, one", f"MazeEnv, SyncVectorEnv of {BATCH}"
LIMITS = {"bare numpy, one maze": ONE, f"bare numpy, {BATCH} mazes at once": VECTOR}
Loop = Callable[[int], None]  # takes a number of steps
Timed = Callable[[int], float]  # takes a number of steps and returns the steps per second


def machine() -> str:
    """Describe the machine: the processor, its cores and its load."""
    info = Path("/proc/cpuinfo")
    models = [line.split(":")[1].strip() for line in info.read_text().splitlines() if "model name" in line]
    load = os.getloadavg()[0]
    model = models[0] if models else platform.processor()
    return (
        f"{model}, {os.cpu_count()} cores, load {load:.1f}, Python {platform.python_version()}, numpy {np.__version__}"
    )


def batched(make: Callable[[], gymnasium.Env]) -> Loop:
    """Return a function that takes random steps in a vector of environments."""
    vector = gymnasium.vector.SyncVectorEnv([make] * BATCH)

    def loop(steps: int) -> None:
        actions = np.random.default_rng(0).integers(vector.single_action_space.n, size=(steps // BATCH, BATCH))
        vector.reset(seed=0)
        for action in actions:
            vector.step(action)

    return loop


def bare(steps: int) -> None:
    """Take steps in plain Python and numpy: the moves, the observation, and a copy of it. This is the upper limit."""
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
    """Take the same steps for a batch of mazes at once. This is the upper limit of a vector of environments."""
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


def timed(loop: Loop) -> Timed:
    """Return a function that measures a loop in this process."""

    def steps_a_second(steps: int) -> float:
        began = time.perf_counter()
        loop(steps)
        return steps / (time.perf_counter() - began)

    return steps_a_second


def minigrid(peer: Peer, form: str) -> Timed:
    """Return a function that measures one form of FourRooms, with fewer steps because each takes longer."""

    def steps_a_second(steps: int) -> float:
        return steps // FEWER / peer.seconds(form=form, steps=steps // FEWER)

    return steps_a_second


def in_turns(measured: dict[str, Timed], steps: int) -> dict[str, list[float]]:
    """Measure all in turn in every round, so that ratios compare the same moments. The first round is a warm-up."""
    speeds: dict[str, list[float]] = {name: [] for name in measured}
    for _ in range(1 + ROUNDS):
        for name, steps_a_second in measured.items():
            speeds[name].append(steps_a_second(steps))
    return {name: values[1:] for name, values in speeds.items()}


def ratio(speeds: dict[str, list[float]], name: str, limit: str) -> float:
    """Return how many times faster `name` is than `limit`."""
    return statistics.median(a / b for a, b in zip(speeds[name], speeds[limit], strict=True))


def print_limits(speeds: dict[str, list[float]]) -> None:
    print("| environment | steps/s | compared with | ratio |")
    print("|---|---|---|---|")
    for limit, ours in LIMITS.items():
        print(f"| {limit} | {max(speeds[limit]):,.0f} |  |  |")
        print(f"| {ours} | {max(speeds[ours]):,.0f} | {limit} | {ratio(speeds, ours, limit):.2f} |")


def print_minigrid(speeds: dict[str, list[float]], said: str) -> None:
    print(f"\nMiniGrid-FourRooms-v0: {said}")
    if FORMS[0] not in speeds:
        return
    print(f"\n| MiniGrid-FourRooms-v0, one | steps/s | {ONE}: times as fast |")
    print("|---|---|---|")
    for form in FORMS:
        print(f"| {form} | {max(speeds[form]):,.0f} | {ratio(speeds, ONE, form):.1f} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--steps", type=int, default=20_000, help="steps per round")
    steps = parser.parse_args().steps
    maze_set("random")
    ours = (bare, random_steps(MazeEnv()), bare_batched, batched(MazeEnv))
    names = [name for pair in LIMITS.items() for name in pair]
    measured = {name: timed(loop) for name, loop in zip(names, ours, strict=True)}
    with ExitStack() as stack:
        try:
            peer = stack.enter_context(Peer("four_rooms"))
            for form in FORMS:
                peer.seconds(form=form, steps=1)  # raises `Missing` here if the form cannot run
            measured |= {form: minigrid(peer, form) for form in FORMS}
            said = f"{peer.versions}; {steps // FEWER} steps per round"
        except Missing as why:
            said = f"not measured: {why}"
        speeds = in_turns(measured, steps)
    print(machine())
    print_limits(speeds)
    print_minigrid(speeds, said)


if __name__ == "__main__":
    main()
