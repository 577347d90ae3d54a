"""Measures steps and updates on Montezuma's Revenge: `python bench/montezuma.py`.

Each of ours is compared with a plain loop of ale-py and PyTorch in the same run. The plain loop of steps makes the same
pictures. The plain update is double DQN with the same network, loss and optimizer on transitions drawn uniformly from
one array of pictures: no priorities, no demonstrations, no n-step returns. Both are filled with the same pictures. All
run with one thread, in turns, and compute updates on a CUDA device if there is one. Speeds and ratios are medians over
the rounds. The script prints tables and asserts nothing.
"""

import argparse
import os
import platform
import statistics
import time
from collections import deque
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import torch
from ale_py import ALEInterface, LoggerMode, roms
from numpy.typing import NDArray
from PIL import Image
from torch.nn import functional

from waypost.domains import find_domain
from waypost_learner.domains.montezuma.game import ACTIONS
from waypost_learner.policies.device import DEVICE
from waypost_learner.policies.dqn import QFunction
from waypost_learner.policies.views import policy_view
from waypost_learner.presets import find_preset
from waypost_learner.rollout.experience import Experience, Transition
from waypost_learner.rollout.policy_keys import pi
from waypost_learner.rollout.simulator import Simulator

LEGAL = (0, 1, 2, 3, 4, 5, 11, 12)  # the emulator's numbers of the actions
ROUNDS = 7
Timed = Callable[[int], None]  # does something so many times


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=3_000, help="of the environment, in each round")
    parser.add_argument("--updates", type=int, default=300, help="with the network of lean, in each round")
    parser.add_argument("--filled", type=int, default=100_000, help="transitions in the buffers")
    chosen = parser.parse_args()
    torch.set_num_threads(1)
    load = os.getloadavg()[0]
    where = torch.cuda.get_device_name() if DEVICE.type == "cuda" else "no GPU"
    print(f"{platform.machine()}, {os.cpu_count()} cores, {where}, load {load:.1f}, torch {torch.__version__}.\n")
    print("| what | plain, per second | ours, per second | ours / plain |")
    print("|---|---|---|---|", flush=True)
    compare("steps of the environment", chosen.steps, plain_steps, our_steps)
    for preset in ("lean", "paper"):
        fewer = chosen.updates if preset == "lean" else max(1, chosen.updates // 50)
        compare(f"updates of {preset}", fewer, *updates(preset, chosen.filled))


def compare(what: str, n: int, plain: Timed, ours: Timed) -> None:
    """Print the medians of speeds and ratios."""
    speeds = []
    for _ in range(ROUNDS):
        pair = []
        for loop in (plain, ours):
            began = time.perf_counter()
            loop(n)
            if DEVICE.type == "cuda":
                torch.cuda.synchronize()
            pair.append(n / (time.perf_counter() - began))
        speeds.append(pair)
    rows = [[pair[0] for pair in speeds], [pair[1] for pair in speeds], [pair[1] / pair[0] for pair in speeds]]
    plain_speed, our_speed, ratio = map(statistics.median, rows)
    print(f"| {what} | {plain_speed:,.0f} | {our_speed:,.0f} | {ratio:.2f} |", flush=True)


def plain_steps(n: int) -> None:
    """Take random steps in the emulator and stack the last four small pictures."""
    ALEInterface.setLoggerMode(LoggerMode.Error)
    ale = ALEInterface()
    ale.setFloat("repeat_action_probability", 0.0)
    ale.setInt("frame_skip", 4)
    ale.loadROM(roms.get_rom_path("montezuma_revenge"))
    rng, done = np.random.default_rng(0), True
    legal = [ale.getLegalActionSet()[number] for number in LEGAL]
    for action in rng.integers(len(LEGAL), size=n).tolist():
        if done:
            ale.reset_game()
            frames = deque([shrunk(ale.getScreenGrayscale())] * 4, 4)
            lives = ale.lives()
        ale.act(legal[action])
        frames.append(shrunk(ale.getScreenGrayscale()))
        np.stack(frames)
        done = ale.lives() < lives


def shrunk(screen: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return a grey screen as uint8[84, 84]."""
    return np.asarray(Image.fromarray(screen).resize((84, 84), Image.Resampling.BILINEAR))


def our_steps(n: int) -> None:
    """Take random steps in the domain."""
    domain = find_domain("montezuma")
    simulator, rng = Simulator(domain), np.random.default_rng(0)
    instance = domain.instances("random").train[0]
    for action in rng.integers(len(ACTIONS), size=n).tolist():
        if simulator.ended:
            simulator.reset(instance)
        simulator.step(action)


def updates(name: str, filled: int) -> tuple[Timed, Timed]:
    """Return the plain updates and ours, with the network of a preset."""
    domain, preset = find_domain("montezuma"), find_preset(name, None, "montezuma")
    use = replace(preset.use, centered=False)  # as in `Learner`
    view = policy_view(domain, use, preset.training.network, pi(0))
    spec = replace(preset.training.dqn, update_every=1, least=1, capacity=filled, stop_above=None)
    q = QFunction(view.view.shape, len(ACTIONS), view.network, spec, seed=0)
    rng = np.random.default_rng(0)
    channels, side, _ = view.view.shape
    pictures = rng.integers(0, 256, (filled + channels, side, side), np.uint8)
    choices, rewards = rng.integers(0, len(ACTIONS), filled), rng.normal(size=filled).astype(np.float32)
    for first in range(0, filled, 100):
        stacks = tuple(pictures[at : at + channels] for at in range(first, first + 101))
        steps = (Transition(i, int(choices[first + i]), float(rewards[first + i]), 1, i + 1) for i in range(100))
        q.replay.add(Experience(stacks, tuple(steps)))

    network, target = (QFunction(view.view.shape, len(ACTIONS), view.network, spec, 0).network for _ in range(2))
    optimizer = torch.optim.Adam(network.parameters(), lr=5e-4, fused=True)
    if spec.optimizer == "rmsprop":
        optimizer = torch.optim.RMSprop(network.parameters(), lr=1e-4, alpha=0.95)
    stacked = np.arange(channels)

    def plain(n: int) -> None:
        for _ in range(n):
            rows = rng.integers(0, filled, spec.batch)
            before, after = (
                torch.from_numpy(pictures[(rows + ahead)[:, None] + stacked]).to(DEVICE).float().div_(255)
                for ahead in (0, 1)
            )
            choice, reward = (torch.from_numpy(numbers[rows]).to(DEVICE) for numbers in (choices, rewards))
            with torch.autocast(DEVICE.type, torch.bfloat16, enabled=q.uses_bf16):
                with torch.no_grad():
                    best = network(after).argmax(1, keepdim=True)
                    wanted = reward + spec.discount * target(after).float().gather(1, best).squeeze(1)
                values = network(before).float().gather(1, choice[:, None]).squeeze(1)
            loss = functional.huber_loss(values, wanted)
            optimizer.zero_grad()
            torch.autograd.backward(loss)
            optimizer.step()

    def ours(n: int) -> None:
        for _ in range(n):
            q.step()

    return plain, ours


if __name__ == "__main__":
    main()
