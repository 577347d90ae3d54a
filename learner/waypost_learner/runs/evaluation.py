"""Success on given instances, all rolled out in step so that the networks see batches."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from waypost_learner.algorithms.learner import TEST, Learner
from waypost_learner.rollout.rollout import run_all

BATCH = 256


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
    """Roll out one episode on each instance, beginning again with the first when there are more episodes."""
    successes = 0
    for first in range(0, episodes, BATCH):
        numbers = range(first, min(first + BATCH, episodes))
        successes += sum(attempt(learner, [instances[n % len(instances)] for n in numbers], TEST, numbers))
    return Evaluation(episodes, successes)


def attempt(learner: Learner, instances: Sequence[Any], stream: int, numbers: Sequence[int]) -> list[bool]:
    """Roll out on each instance, as rollouts of these numbers in a stream of randomness; return which succeed."""
    simulators = [learner.make_simulator() for _ in instances]
    rollouts = [
        learner.rollout(simulator, instance, stream, number)
        for simulator, instance, number in zip(simulators, instances, numbers, strict=True)
    ]
    run_all(rollouts, learner.policies)
    return [simulator.succeeded for simulator in simulators]
