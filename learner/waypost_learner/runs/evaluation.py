"""Measure the success of policies on given instances, all rolled out in parallel."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.rollout import streams
from waypost_learner.rollout.rollout import run_all
from waypost_learner.runs import checkpoints
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.setup import build_learner

BATCH = 256  # rollouts


@dataclass(frozen=True)
class Evaluation:
    """How many episodes succeeded."""

    episodes: int
    successes: int

    @property
    def success_rate(self) -> float:
        """Successes per episode."""
        return self.successes / self.episodes


def evaluate(learner: Learner, instances: Sequence[Any], episodes: int) -> Evaluation:
    """Roll out one episode on each instance in turn; after the last instance, start with the first again."""
    successes = 0
    for first in range(0, episodes, BATCH):
        numbers = range(first, min(first + BATCH, episodes))
        successes += sum(attempt(learner, [instances[n % len(instances)] for n in numbers], streams.TEST, numbers))
    return Evaluation(episodes, successes)


def attempt(learner: Learner, instances: Sequence[Any], stream: int, numbers: Sequence[int]) -> list[bool]:
    """Roll out on each instance and return which rollouts succeed.

    Args:
        learner: the learner; its current policies are rolled out.
        instances: the instances to start from.
        stream: the stream of randomness.
        numbers: the numbers of the rollouts in the stream, one per instance.
    """
    simulators = [learner.make_simulator() for _ in instances]
    rollouts = [
        learner.rollout(simulator, instance, stream, number)
        for simulator, instance, number in zip(simulators, instances, numbers, strict=True)
    ]
    run_all(rollouts, learner.policies)
    return [simulator.succeeded for simulator in simulators]


def learner_of(path: Path, values: str | None, threads: int | None) -> tuple[Learner, TrainConfig]:
    """Return a learner with the policies of a checkpoint, and the configuration of its run.

    Args:
        path: the checkpoint.
        values: values that replace the run's own, such as "fields.far=96"; the run's own if None.
        threads: CPU threads; one per core if None.

    Raises:
        ValueError: the checkpoint does not exist or does not fit the values, or a value does not exist.
    """
    config = checkpoints.read_header(path).config
    if values is not None:
        config = replace(config, values=" ".join([*(config.values or "").split(), values]))
    learner = build_learner(config, threads)
    try:
        checkpoints.load(path, learner)
    except ValueError as error:
        if values is None:
            raise
        raise ValueError(f"{path} does not fit {values!r}: leave out values that change its networks") from error
    return learner, config


def evaluate_run(
    path: Path, instances: str | None, episodes: int, threads: int | None, values: str | None = None
) -> Evaluation:
    """Evaluate the policies of a checkpoint on unseen instances.

    Args:
        path: the checkpoint.
        instances: a name of instances, or a file; the run's own instances if None.
        episodes: the number of episodes; 0 for one on each instance.
        threads: CPU threads; one per core if None.
        values: values that replace the run's own (`learner_of`).

    Raises:
        ValueError: the checkpoint or the instances do not exist, or the values do not fit.
    """
    learner, config = learner_of(path, values, threads)
    chosen = learner.domain.instances(instances or config.instances)
    return evaluate(learner, chosen.test, episodes or len(chosen.test))
