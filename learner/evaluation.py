"""Success on given instances, all rolled out in step so that the networks see batches."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from learner.learner import TEST, Learner
from learner.rollout import run_all
from learner.simulator import Simulator

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
        simulators = [Simulator(learner.domain) for _ in numbers]
        rollouts = [
            learner.rollout(simulator, instances[number % len(instances)], TEST, number)
            for simulator, number in zip(simulators, numbers, strict=True)
        ]
        run_all(rollouts, learner.policies)
        successes += sum(simulator.succeeded for simulator in simulators)
    return Evaluation(episodes, successes)
