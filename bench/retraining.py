"""Trains `general` anew on the labels of a run's first episodes, and shows what more training does.

    python bench/retraining.py RUN --store gates.db --instances random:1 --of 100 --episodes 33 --values ""

It says after how many updates how many instances are solved, and the gates of the commonest pixels: how easily the
network thinks that each is passed. It asserts nothing.
"""

import argparse
from itertools import islice
from pathlib import Path

import torch

from waypost import wire
from waypost.domains import place_of
from waypost_learner.exchange.labels import labels_of
from waypost_learner.exchange.replay import Replayer
from waypost_learner.exchange.source import opened, records_of
from waypost_learner.policies.fields.field_net import FieldNet
from waypost_learner.policies.fields.shared_policy import SharedPolicy
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.evaluation import evaluate
from waypost_learner.runs.setup import set_up

BATCHES, ROWS = 120, 64  # of one call of Train in idle time
UNTRAINED = f"train_shared.passes=0 train_shared.least=0 train_shared.idle={BATCHES * ROWS}"
COMMONEST = 4  # kinds of pixels


def main() -> None:
    """Train, and print a row after each number of updates."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("run", help="the id of a run with the preset general")
    arguments.add_argument("--store", type=Path, required=True, help="its store")
    arguments.add_argument("--instances", default="random:1", help="whose test instances are tried")
    arguments.add_argument("--of", type=int, default=100, help="how many of them")
    arguments.add_argument("--episodes", type=int, help="how many episodes with queries; all if it is not given")
    arguments.add_argument("--seed", type=int, help="of the new network; that of the run if it is not given")
    arguments.add_argument("--values", default="", help="values of the preset to replace")
    arguments.add_argument("--calls", type=int, nargs="+", default=[4, 8, 12, 24], help=f"of {BATCHES} updates each")
    given = arguments.parse_args()
    with opened(given.store, "", "") as source:
        stream = iter(records_of(source, given.run))
        first = next(stream)
        assert isinstance(first, wire.RunRecord)
        old = first.run.config
        config = TrainConfig(
            "h-bc",
            domain=place_of(first.run),
            instances=str(old["instances"]),
            preset="general",
            told=str(old["told"]),
            seed=int(old["seed"]) if given.seed is None else given.seed,
            values=f"{UNTRAINED} {given.values}".strip(),
        )
        learner = set_up(config, threads=1).learner
        for _, replays in islice(Replayer(first.run).episodes(stream), given.episodes):
            learner.learn(labels_of(learner.domain, replays))
    assert learner.shared is not None
    tests = learner.domain.instances(given.instances).test[: given.of]
    print(f"{sum(map(len, learner.data.values()))} rows\n\n| updates | solved of {len(tests)} | gates |\n|---|---|---|")
    done = 0
    for calls in given.calls:
        for _ in range(calls - done):
            for _ in learner.shared.idle_updates(learner.data):
                pass
        done = calls
        solved = evaluate(learner, tests, len(tests)).successes
        print(f"| {BATCHES * done:,} | {solved} | {gates(learner.shared)} |", flush=True)


@torch.inference_mode()
def gates(policy: SharedPolicy) -> str:
    """Return the gates of the commonest kinds of pixels in the pictures that the network saw."""
    network, pictures = policy.acting, policy.transitions[range(len(policy.transitions))][0][:, 0]
    assert isinstance(network, FieldNet)
    pixels = pictures.movedim(1, -1).reshape(-1, pictures.shape[1])
    kinds, counts = torch.unique(pixels, dim=0, return_counts=True)
    commonest = kinds[counts.argsort(descending=True)[:COMMONEST]]
    passed = network.passed(commonest[:, :, None, None]).flatten()
    return ", ".join(f"{pixel.tolist()}: {gate:.2g}" for pixel, gate in zip(commonest, passed.tolist(), strict=True))


if __name__ == "__main__":
    main()
