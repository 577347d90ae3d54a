"""Measures what the maze's declared structure is worth without any label: `python bench/no_labels.py`.

The preset `lean` is told which squares of the picture are places and where each action leads. With the environment's
own reward, this is enough for a planner that asks nobody. It notes, for each look of a place, the reward of stepping
there. It moves along shortest paths over places that cost nothing, to places that are rewarded or look like none where
it has been. The script prints a table with a row for each seed and asserts nothing.
"""

import argparse
import csv
from collections import defaultdict, deque
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost.domains import Grid, View, find_domain

Picture = NDArray[np.float32]  # [channels, rows, columns]
Rewards = Mapping[bytes, float]  # by the look of a place: its pixel in all channels


def look(picture: Picture, row: int, column: int) -> bytes:
    """Return how a place looks: its pixel in all channels."""
    return picture[:, row, column].tobytes()


def explored(env: Any, mazes: Any, view: View, steps: int, rng: np.random.Generator) -> Rewards:
    """Try the looks of places, and return the mean reward of stepping on each, by the look before the step."""
    found: dict[bytes, list[float]] = defaultdict(list)
    means: dict[bytes, float] = {}
    ended = True
    for _ in range(steps):
        if ended:
            observation, _ = env.reset(options={"instance": mazes[rng.integers(len(mazes))]})
        picture = view.observe(observation)
        action = planned(picture, grid_of(view), means, rng)
        seen = look(picture, *place_after(picture, grid_of(view), action))
        observation, reward, terminated, truncated, _ = env.step(action)
        found[seen].append(float(reward))
        means[seen] = float(np.mean(found[seen]))
        ended = terminated or truncated
    return means


def planned(picture: Picture, grid: Grid, rewards: Rewards, rng: np.random.Generator) -> int:
    """Return the first action of a shortest path to a rewarded or unknown place over places without a reward.

    Return a random action if there is no such path.
    """
    middle = picture.shape[1] // 2
    queue: deque[tuple[int, int, int | None]] = deque([(middle, middle, None)])
    seen = {(middle, middle)}
    while queue:
        row, column, first = queue.popleft()
        for action, move in enumerate(grid.moves):
            down, right = move or (0, 0)
            there = row + down, column + right
            if there in seen or min(there) < 0 or max(there) >= picture.shape[1]:
                continue
            seen.add(there)
            reward = rewards.get(look(picture, *there), 1.0)
            begun = action if first is None else first
            if reward > 0:
                return begun
            if reward == 0:
                queue.append((*there, begun))
    return int(rng.integers(len(grid.moves)))


def place_after(picture: Picture, grid: Grid, action: int) -> tuple[int, int]:
    """Return the place that an action leads to from the agent's place, which is in the middle."""
    middle, (down, right) = picture.shape[1] // 2, grid.moves[action] or (0, 0)
    return middle + down, middle + right


def grid_of(view: View) -> Grid:
    """Return the places of a view."""
    assert view.grid is not None
    return view.grid


def success_rate(env: Any, mazes: Any, choose: Callable[[Picture], int]) -> float:
    """Return the share of mazes in which a policy reaches the target."""
    successes = 0
    for maze in mazes:
        observation, _ = env.reset(options={"instance": maze})
        ended = False
        while not ended:
            observation, reward, terminated, truncated, _ = env.step(choose(observation))
            ended = terminated or truncated
        successes += reward > 0
    return successes / len(mazes)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--instances", default="random:1", help="the mazes to test on; default: %(default)s")
    parser.add_argument("--steps", type=int, default=500, help="steps in training mazes; default: %(default)s")
    parser.add_argument("--seeds", type=int, default=10, help="default: %(default)s")
    parser.add_argument("--episodes", type=int, default=1_000, help="default: %(default)s")
    parser.add_argument("--to", type=Path, help="a CSV file to write the shares of success to, too")
    arguments = parser.parse_args()
    domain: Any = find_domain("maze")
    view, env = domain.flat_view, domain.make_env()
    train, tests = domain.instances("random").train, domain.instances(arguments.instances).test[: arguments.episodes]
    print("| seed | rewards that were found | success of the planner | of random actions |")
    print("|---|---|---|---|")
    rows = []
    for seed in range(arguments.seeds):
        rng = np.random.default_rng(seed)
        rewards = explored(env, train, view, arguments.steps, rng)

        def plan(observation: Picture, known: Rewards = rewards, draws: np.random.Generator = rng) -> int:
            return planned(view.observe(observation), view.grid, known, draws)

        def draw(_: Picture, draws: np.random.Generator = rng) -> int:
            return int(draws.integers(len(domain.actions)))

        found = ", ".join(f"{reward:g}" for reward in sorted(rewards.values()))
        rows.append((seed, success_rate(env, tests, plan), success_rate(env, tests, draw)))
        print(f"| {seed} | {found} | {rows[-1][1]:.1%} | {rows[-1][2]:.1%} |", flush=True)
    if arguments.to is not None:
        with arguments.to.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([("seed", "planner", "random"), *rows])


if __name__ == "__main__":
    main()
