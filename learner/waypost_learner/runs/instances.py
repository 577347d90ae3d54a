"""Determines the training and the test instance of each episode of a run, from the run's seed."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from waypost.domains import InstanceSets
from waypost_learner.algorithms.learner import Learner
from waypost_learner.rollout import streams
from waypost_learner.runs.evaluation import attempt

_LARGEST_BATCH = 64  # rollouts in parallel, in the search for a failing one
_MOST_DRAWS = 250  # in the search for a failing rollout


class Instances:
    """The instances of a run, by their number.

    Args:
        sets: the instances to train on and to test on.
        seed: the run's seed.
    """

    def __init__(self, sets: InstanceSets, seed: int) -> None:
        self._sets, self._seed = sets, seed

    def train(self, draw: int) -> Any:
        """Return the training instance of a draw."""
        instance = self._pick(self._sets.train, streams.TRAIN_ORDER, draw)
        if self._sets.vary is None:
            return instance
        return self._sets.vary(instance, np.random.default_rng([self._seed, streams.VARIATION, draw]))

    def test(self, episode: int) -> Any:
        """Return the test instance of an episode."""
        return self._pick(self._sets.test, streams.TEST_ORDER, episode)

    def failing_draw(self, learner: Learner, first: int) -> int:
        """Return the first draw, from `first` on, on whose training instance the current policies fail.

        Rollouts run in batches that grow while no rollout fails. If at least 250 rollouts succeed, return `first`.
        """
        draw, size = first, 2
        while draw < first + _MOST_DRAWS:
            draws = range(draw, draw + size)
            successes = attempt(learner, [self.train(one) for one in draws], streams.TRAIN, draws)
            for one, success in zip(draws, successes, strict=True):
                if not success:
                    return one
            draw, size = draw + size, min(2 * size, _LARGEST_BATCH)
        return first

    def _pick(self, instances: Sequence[Any], stream: int, number: int) -> Any:
        """Return an instance. Successive numbers give all instances in random order, then again in another order."""
        lap, place = divmod(number, len(instances))
        return instances[np.random.default_rng([self._seed, stream, lap]).permutation(len(instances))[place]]
