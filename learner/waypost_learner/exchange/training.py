"""`waypost clone`: trains policies on the labels of a run that is already there, without asking anybody.

The learner does what it does in `waypost train h-bc`: after each episode it trains on all labels so far. So the
demonstrations of a run of h-BC give the same weights as the run itself, and an imported run the same as the original.
"""

import time
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path
from typing import Any

from waypost import wire
from waypost.domains import place_of
from waypost_learner.algorithms import ALGORITHMS
from waypost_learner.exchange.labels import labels_of
from waypost_learner.exchange.replay import Replayer
from waypost_learner.rollout import streams
from waypost_learner.rollout.rollout import run as run_one
from waypost_learner.runs import checkpoints
from waypost_learner.runs.config import Progress, TrainConfig
from waypost_learner.runs.instances import Instances
from waypost_learner.runs.setup import set_up


@dataclass(frozen=True)
class Trained:
    """The result of training on labels."""

    checkpoint: str  # its name, for `waypost evaluate`
    run: str  # the id of the run whose labels they are
    episodes: int  # with queries
    labels: int  # rows in all data buffers
    success_rate: float  # over the trailing 100 tests; there is one test after each episode
    weights: str  # the SHA-256 of all weights
    wall_seconds: float


def train_on(
    records: Iterable[wire.Record],
    values: dict[str, Any],
    folder: Path,
    episodes: int | None = None,
    threads: int | None = None,
) -> Trained:
    """Train policies on the labels of a run, and write their checkpoint.

    Args:
        records: the records of the run; its domain and instances are used.
        values: fields of `TrainConfig`: the algorithm (h-bc or flat-bc), the preset, the seed, values of the preset.
        episodes: how many of the run's episodes with queries to use; all if None.
        folder: the folder of the checkpoint.
        threads: CPU threads to train with; one per core if None.

    Raises:
        ValueError: the algorithm asks an expert, the run has no labels for it, or its paths cannot be replayed.
    """
    began = time.monotonic()
    stream = iter(records)
    first = next(stream)
    assert isinstance(first, wire.RunRecord)
    config = _config(first.run, values)
    setup, replayer = set_up(config, threads), Replayer(first.run)
    learner, instances = setup.learner, Instances(setup.instances, config.seed)
    simulator, tests = learner.make_simulator(), list[bool]()
    for episode, replays in islice(replayer.episodes(stream), episodes):
        learner.train_idle()
        learner.learn(labels_of(learner.domain, replays))
        run_one(learner.rollout(simulator, instances.test(episode), streams.TEST, episode), learner.policies)
        tests.append(simulator.succeeded)
    learner.train_idle()
    n_labels = sum(len(data) for data in learner.data.values())
    if n_labels == 0:
        raise ValueError(f"run {first.run.id} has no labels that {config.algorithm} can learn from")
    name = f"{first.run.id}.{config.algorithm}-{config.seed}"
    header = checkpoints.Header(name, replace(config, episodes=len(tests)), Progress(len(tests)))
    checkpoints.write(folder / f"{name}.safetensors", learner, header, weights_only=True)
    recent, weights, seconds = tests[-100:], checkpoints.weights_hash(learner), time.monotonic() - began
    return Trained(name, first.run.id, len(tests), n_labels, sum(recent) / len(recent), weights, round(seconds, 3))


def _config(run: wire.Run, values: dict[str, Any]) -> TrainConfig:
    name = values["algorithm"]
    cloning = [known for known, one in ALGORITHMS.items() if not one.interactive and not one.levels.reinforced]
    if name not in cloning:
        raise ValueError(f"{name} does not learn from given labels alone; choose one of: {', '.join(cloning)}")
    return TrainConfig(domain=place_of(run), instances=str(run.config.get("instances", "random")), **values)
