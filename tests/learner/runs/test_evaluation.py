"""An evaluation counts each episode once, and batches change nothing."""

import pytest
from tests.learner.kit import TINY

from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.rollout.rollout import run
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.rollout.streams import TEST
from waypost_learner.runs import evaluation
from waypost_learner.runs.evaluation import Evaluation, evaluate


def test_successes_are_counted_over_all_episodes_whatever_the_batch(monkeypatch: pytest.MonkeyPatch) -> None:
    learner = Learner(CorridorDomain(), TINY, seed=0, threads=1)
    instances = [Corridor(start, target) for start in range(5) for target in (7, 8, 9)]
    one_by_one = 0
    for number in range(40):
        simulator = Simulator(learner.domain)
        run(learner.rollout(simulator, instances[number % 15], TEST, number), learner.policies)
        one_by_one += simulator.succeeded
    assert 0 < one_by_one < 40
    for batch in (1, 7, 256):
        monkeypatch.setattr(evaluation, "BATCH", batch)
        assert evaluate(learner, instances, episodes=40) == Evaluation(40, one_by_one)


def test_the_success_rate_is_successes_per_episode() -> None:
    assert Evaluation(episodes=8, successes=2).success_rate == 0.25
