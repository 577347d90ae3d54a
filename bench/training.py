"""Measures how fast policies train and act with the network of the `paper` preset: `python bench/training.py`.

Training: the script measures `Policy.train` on maze observations in samples per second, and compares it with three
others that have the same network, data and batch size. Two are plain torch loops: one with 32-bit floats, and one with
the same precision and memory layout as `Policy.train`. The third is behavioral cloning of the `imitation`
library, with 32-bit floats, in a separate virtual environment. It does more per step (`peers/behavioral_cloning.py`).

Planning: it measures 100 steps of soft value iteration over the places of a maze, with gradients, as a flat policy of
`lean` trains, and compares them with the same steps written as torch operations that autograd follows.

Acting: the script measures the latency for one state and for a batch.

Everything uses one thread, because a learner gives one thread to each policy. Speeds are the best of several rounds;
ratios are medians over the rounds. The script prints tables and asserts nothing.
"""

import argparse
import math
import os
import platform
import statistics
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

import numpy as np
import torch
from bench.peers.client import Missing, Peer
from bench.peers.network import table_1
from torch import nn
from torch.nn import functional

from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.domains.maze.maze import MOVES, SUBGOALS
from waypost_learner.policies.datasets import Dataset, Row
from waypost_learner.policies.imitation import Policy
from waypost_learner.policies.planning import iterate
from waypost_learner.presets.paper import PAPER
from waypost_learner.rollout.simulator import Simulator

ROUNDS = 5
SPEC = PAPER.training.train_hi
CHANNELS, HIDDEN = (32, 64), 256  # of Table 1's network
Round = Callable[[], float]  # does one round of work and returns its duration in seconds


def machine(policy: Policy) -> str:
    """Describe the machine: the processor, its cores and load, and the precision that training uses on it."""
    info = Path("/proc/cpuinfo")
    models = [line.split(":")[1].strip() for line in info.read_text().splitlines() if "model name" in line]
    load = os.getloadavg()[0]
    precision = "bf16 mixed precision" if policy.bf16 else "32-bit floats"
    model = models[0] if models else platform.processor()
    return f"{model}, {os.cpu_count()} cores, load {load:.1f}, torch {torch.__version__}, Train in {precision}"


def observations(n: int) -> Dataset:
    """Return start states of mazes with random labels."""
    domain, rng, data = MazeDomain(), np.random.default_rng(0), Dataset((3, 17, 17))
    simulator, mazes = Simulator(domain), maze_set("random")[0]
    states = (simulator.reset(mazes[number % len(mazes)]) for number in range(n))
    data.append(Row(state.observation, int(rng.integers(len(SUBGOALS)))) for state in states)
    return data


def plain_network(dropout: float) -> nn.Sequential:
    """Return the network of Table 1, built from torch's layers."""
    return nn.Sequential(*table_1((3, 17, 17), CHANNELS, HIDDEN, dropout), nn.Linear(HIDDEN, len(SUBGOALS)))


def plain_loop(data: Dataset, rows: int, bf16: bool = False, channels_last: bool = False) -> Callable[[], None]:
    """Return a function that trains a plain torch network."""
    network = plain_network(SPEC.dropout)
    if channels_last:
        network = network.to(memory_format=torch.channels_last)
    optimizer = torch.optim.Adam(network.parameters(), lr=SPEC.learning_rate)
    criterion = nn.CrossEntropyLoss()
    pictures, labels = data[range(len(data))]
    choices = labels[:, 0]

    def train() -> None:
        network.train()
        for batch in torch.randint(len(data), (rows,)).split(SPEC.batch):
            with torch.autocast("cpu", torch.bfloat16, enabled=bf16):
                loss = criterion(network(pictures[batch]), choices[batch])
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()

    return train


def imitation(data: Dataset, folder: Path) -> Peer:
    """Start the `imitation` library in its own process, with the same data."""
    pictures, labels = data[range(len(data))]
    np.savez(folder / "data.npz", observations=pictures.numpy(), labels=labels[:, 0].numpy())
    return Peer(
        "behavioral_cloning",
        data=str(folder / "data.npz"),
        choices=len(SUBGOALS),
        batch=SPEC.batch,
        learning_rate=SPEC.learning_rate,
        dropout=SPEC.dropout,
        channels=CHANNELS,
        hidden=HIDDEN,
    )


def timed(work: Callable[[], object]) -> Round:
    """Return a function that measures work in this process."""

    def one() -> float:
        began = time.perf_counter()
        work()
        return time.perf_counter() - began

    return one


def in_turns(rounds: dict[str, Round]) -> dict[str, list[float]]:
    """Measure all in turn in every round, so that ratios compare the same moments. The first round is a warm-up."""
    taken: dict[str, list[float]] = {name: [] for name in rounds}
    for _ in range(1 + ROUNDS):
        for name, one in rounds.items():
            taken[name].append(one())
    return {name: times[1:] for name, times in taken.items()}


def ratio(taken: dict[str, list[float]], limit: str, name: str) -> float:
    """Return how many times faster `name` is than `limit`."""
    return statistics.median(a / b for a, b in zip(taken[limit], taken[name], strict=True))


def print_training(policy: Policy, data: Dataset) -> None:
    rows = min(max(SPEC.passes * len(data), SPEC.least), SPEC.most)
    same = f"plain torch, {'bf16, channels last' if policy.bf16 else 'channels last'}"
    rounds = {
        "Policy.train": timed(lambda: policy.train(data)),
        same: timed(plain_loop(data, rows, bf16=policy.bf16, channels_last=True)),
        "plain torch": timed(plain_loop(data, rows)),
    }
    absent = ""
    with ExitStack() as stack:
        try:
            peer = stack.enter_context(imitation(data, Path(stack.enter_context(tempfile.TemporaryDirectory()))))
            peer.seconds(batches=1)  # raises `Missing` here if the library cannot run
            rounds[peer.versions] = lambda: peer.seconds(batches=math.ceil(rows / SPEC.batch))
        except Missing as why:
            absent = f"| imitation | not measured: {why} | |"
        taken = in_turns(rounds)
    print(f"| training, batch {SPEC.batch} | samples/s | Policy.train: times as fast |")
    print("|---|---|---|")
    for name, times in taken.items():
        print(f"| {name} | {rows / min(times):,.0f} | {ratio(taken, name, 'Policy.train'):.2f} |")
    if absent:
        print(absent)


def print_planning() -> None:
    rng, batch, side, steps = torch.Generator().manual_seed(0), 64, 17, 100  # 15 x 15 places and a frame
    inside = functional.pad(torch.ones(side - 2, side - 2, dtype=torch.float64), (1, 1, 1, 1))
    moving = 0.2 * torch.rand(batch, len(MOVES), side, side, dtype=torch.float64, generator=rng) * inside
    moving.requires_grad_()
    ending = (torch.rand(batch, side, side, dtype=torch.float64, generator=rng) * inside).requires_grad_()

    def ours() -> None:
        iterate(moving, ending, [down * side + right for down, right in MOVES], steps).sum().backward()

    def plain() -> None:
        reached = ending
        for _ in range(steps):
            padded = functional.pad(reached, (1, 1, 1, 1))
            ahead = [padded[:, 1 + down : 1 + down + side, 1 + right : 1 + right + side] for down, right in MOVES]
            reached = (moving * torch.stack(ahead, 1)).sum(1) + ending
        reached.sum().backward()

    taken = in_turns({"iterate": timed(ours), "plain": timed(plain)})
    print("\n| planning, 100 steps and their gradients, batch 64 | ms | iterate: times as fast |\n|---|---|---|")
    print(f"| iterate | {1e3 * min(taken['iterate']):.0f} | 1.00 |")
    print(f"| torch operations | {1e3 * min(taken['plain']):.0f} | {ratio(taken, 'plain', 'iterate'):.2f} |")


def print_latency(policy: Policy, data: Dataset) -> None:
    network = plain_network(0.0).eval()
    print("\n| acting | Policy, ms | plain torch, ms | Policy: times as fast |")
    print("|---|---|---|---|")
    for batch, calls in ((1, 300), (256, 10)):
        pictures = data[range(batch)][0].numpy()
        inputs = torch.from_numpy(pictures)

        def act(pictures: np.ndarray = pictures, calls: int = calls) -> None:
            for _ in range(calls):
                policy(pictures)

        @torch.inference_mode()
        def plain(inputs: torch.Tensor = inputs, calls: int = calls) -> None:
            for _ in range(calls):
                network(inputs)

        taken = in_turns({"Policy": timed(act), "plain": timed(plain)})
        ms = [1e3 * min(taken[name]) / calls for name in ("Policy", "plain")]
        print(f"| batch {batch} | {ms[0]:.3f} | {ms[1]:.3f} | {ratio(taken, 'plain', 'Policy'):.2f} |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rows", type=int, default=512, help="rows in the buffer")
    arguments = parser.parse_args()
    torch.set_num_threads(1)
    data = observations(arguments.rows)
    policy = Policy((3, 17, 17), len(SUBGOALS), False, PAPER.training.network, SPEC, seed=0)
    print(machine(policy))
    print_training(policy, data)
    print_planning()
    print_latency(policy, data)


if __name__ == "__main__":
    main()
