"""The outer loop of the algorithms: get an instance, let the episode ask, apply its labels, Train, test.

The driver resolves an algorithm's queries through the queue. It may keep several episodes open (`in_flight`); their
results are applied in episode order, and episode t + K starts right after episode t was applied, so a run is a
function of its configuration and the answers, never of who was fast. That holds too where policies train on while the
expert is at the next question: by a fixed amount, and before they act again. Queries are keyed by (episode, ordinal): a
learner that starts again asks the same ones and pays for nothing twice.
"""

import time
from collections import deque
from collections.abc import Callable, Generator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from waypost import wire
from waypost.client import Client, Refused
from waypost.domain import InstanceSets
from waypost_learner.algorithms import Algorithm, Episode
from waypost_learner.algorithms.learner import TEST, TRAIN, Learner
from waypost_learner.algorithms.queries import HierDemo, Query
from waypost_learner.algorithms.unasked import unasked
from waypost_learner.policies.datasets import Labels
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.policy_keys import FLAT, META
from waypost_learner.rollout.rollout import run
from waypost_learner.runs.config import START, Progress, TrainConfig
from waypost_learner.runs.evaluation import attempt

POLL_SECONDS = 30.0
CHECKPOINT_EVERY = 25  # episodes
_TRAIN_ORDER, _TEST_ORDER, _VARIATION, _MONITORING = 2, 3, 4, 5  # streams of randomness, beside the rollouts'
_LARGEST_BATCH = 64  # rollouts in step, when looking for one that fails
_MOST_DRAWS = 250  # without a failure, the learner has nothing left to ask about for now


Withdraw = Callable[[], None]
Offer = Callable[[int, Translator], Withdraw]
"""Offers the environment of a demonstration (a query's id, its instance) to whoever plays it."""


@dataclass
class OpenEpisode:
    """An episode under way."""

    number: int
    translator: Translator
    generator: Generator[Query, Any, Labels]
    steps: int = 0  # of the learner's rollout; none in a demonstration
    success: bool | None = None
    passed: bool | None = None  # what Inspect_FULL said of it, if it was asked
    ordinal: int = 0
    pending: int | None = None  # the query it waits for
    units: float = 0  # what its answers cost
    labels: Labels | None = None  # what it taught, once it is over
    withdraw: Withdraw = lambda: None  # its environment, from who may be playing it

    def resume(self, going_on: Callable[[], Query]) -> Query | None:
        """Let the algorithm go on to its next query; None at its end."""
        try:
            return going_on()
        except StopIteration as over:
            self.labels = over.value
            return None


class BudgetExhausted(Exception):
    """The run's budget cannot pay the next query."""


class Driver:
    """Trains one run.

    Args:
        config: the run's values.
        algorithm: what an episode is.
        learner: what is trained.
        instances: where to train and test.
        client: the queue, as a learner.
        run_id: the run, already created.
        let_answer: called when queries may be open; an expert in this process answers them there.
        on_episode: called with each episode's result and what its answers cost, in units.
        offer: called with a demonstration that others are to give, so that they can play it.
        checkpoint: called with where the run stands whenever it can go on from there.
        first: where to go on, after a resumed checkpoint.
        pictures: whether queries carry pictures of their states, where the domain has them; people need them.
    """

    def __init__(
        self,
        config: TrainConfig,
        algorithm: Algorithm,
        learner: Learner,
        instances: InstanceSets,
        client: Client,
        run_id: str,
        let_answer: Callable[[], None] = lambda: None,
        on_episode: Callable[[wire.EpisodeResult, float], None] = lambda _result, _units: None,
        checkpoint: Callable[[Progress], None] = lambda _: None,
        offer: Offer = lambda _query, _translator: lambda: None,
        first: Progress = START,
        pictures: bool = False,
    ) -> None:
        self._config, self._algorithm, self._learner, self._instances = config, algorithm, learner, instances
        self._client, self._run_id = client, run_id
        self._let_answer, self._on_episode, self._checkpoint = let_answer, on_episode, checkpoint
        self._pictures = pictures
        self._offer = offer
        self._test_simulator = learner.make_simulator()
        # Experience is large, and episodes that learn from it are short.
        self._checkpoint_every = CHECKPOINT_EVERY * (20 if learner.structure.reinforced else 1)
        self._open: deque[OpenEpisode] = deque()
        self._next = self._applied = first.episodes
        self._draws = first.draws
        self._passes = first.passes
        self._cursor = 0
        self._clock = time.monotonic()

    @property
    def progress(self) -> Progress:
        """Where the run stands."""
        return Progress(self._applied, self._draws, self._passes)

    def train(self) -> None:
        """Run to the last episode.

        Raises:
            BudgetExhausted: the budget ended first.
            Refused: the server refused for another reason; a run that was finished by somebody, say.
        """
        try:
            while self._open or self._next < self._config.episodes:
                while self._may_start():
                    self._start_episode(self._next)
                    self._next += 1
                self._learner.train_on()
                if self._open[0].labels is not None:
                    self._apply(self._open.popleft())
                else:
                    self._wait()
        finally:
            for episode in self._open:
                episode.withdraw()

    def _may_start(self) -> bool:
        """Return whether the next episode may begin.

        No episode is open at a checkpoint: it would have been rolled out with weights that are gone when a resumed
        run comes to it again.
        """
        if self._next % self._checkpoint_every == 0 and self._open:
            return False
        return len(self._open) < self._config.in_flight and self._next < self._config.episodes

    def _start_episode(self, number: int) -> None:
        """Get a new environment instance and go to the first query."""
        warm_start = self._algorithm.warm_start if number < self._learner.preset.warm_start else None
        draw = self._draws if warm_start or not self._config.redraw else self._failing_draw()
        self._draws = draw + 1
        instance = self._train_instance(draw)
        s = self._learner.start(instance, draw)
        generator = (warm_start or self._episode(number))(s, self._learner)
        camera = Camera(self._learner.domain, instance) if self._pictures else None
        episode = OpenEpisode(number, Translator(self._learner.domain, instance, camera), generator)
        self._open.append(episode)
        query = episode.resume(partial(next, generator))
        simulator = self._learner.simulator
        episode.steps, episode.success = simulator.steps, simulator.succeeded if simulator.steps else None
        self._ask(episode, query)

    def _train_instance(self, draw: int) -> Any:
        instance = _pick(self._instances.train, self._config.seed, _TRAIN_ORDER, draw)
        if self._instances.vary is None:
            return instance
        return self._instances.vary(instance, np.random.default_rng([self._config.seed, _VARIATION, draw]))

    def _episode(self, number: int) -> Episode:
        """Return what the episode is: the algorithm's, or one that asks nothing, where success is known."""
        monitoring = self._learner.preset.monitoring
        chance = np.random.default_rng([self._config.seed, _MONITORING, number])
        return self._algorithm.episode if monitoring.inspects(self._passes, chance) else unasked

    def _failing_draw(self) -> int:
        """Return the next draw on whose instance the present policies fail; just the next one if they hardly do.

        Rollouts go in batches that grow while none fails.
        """
        first, size = self._draws, 2
        while first < self._draws + _MOST_DRAWS:
            draws = range(first, first + size)
            instances = [self._train_instance(draw) for draw in draws]
            for draw, success in zip(draws, attempt(self._learner, instances, TRAIN, draws), strict=True):
                if not success:
                    return draw
            first, size = first + size, min(2 * size, _LARGEST_BATCH)
        return self._draws

    def _ask(self, episode: OpenEpisode, query: Query | None) -> None:
        """Ask, and go on with the answers that are there at once."""
        while query is not None:
            ask = episode.translator.ask(query, episode.number, episode.ordinal)
            if episode.translator.camera:
                self._client.upload(episode.translator.camera.developed())
            try:
                (asked,) = self._client.ask(self._run_id, [ask])
            except Refused as refusal:
                if refusal.name == "budget-exhausted":
                    raise BudgetExhausted(str(refusal)) from refusal
                raise
            episode.ordinal += 1
            episode.pending = asked.id
            self._let_answer()
            asked_before, query = query, self._go_on(episode)
            if episode.pending is not None and isinstance(asked_before, HierDemo):
                episode.withdraw = self._offer(asked.id, episode.translator)

    def _go_on(self, episode: OpenEpisode) -> Query | None:
        """Use the pending answer, if it is there, and return the next query, if there is one."""
        assert episode.pending is not None
        try:
            used = self._client.use(episode.pending)
        except Refused as refusal:
            if refusal.name == "not-answered":
                return None
            raise
        assert used.answer is not None
        episode.withdraw()
        episode.pending, episode.withdraw = None, lambda: None
        episode.units += used.units or 0
        if used.answer.kind == "inspect_full":
            episode.passed = used.answer.verdict == "pass"
        return episode.resume(partial(episode.generator.send, episode.translator.answer(used.answer)))

    def _wait(self) -> None:
        """Wait for answers, and let the episodes they belong to go on."""
        self._let_answer()
        page = self._client.answers(self._run_id, self._cursor, wait=POLL_SECONDS)
        self._cursor = page.cursor
        answered = {query.id for query in page.queries}
        for episode in self._open:
            if episode.pending in answered:
                query = self._go_on(episode)
                if query is not None:
                    self._ask(episode, query)

    def _apply(self, episode: OpenEpisode) -> None:
        """Learn from an episode, test on an unseen instance, report."""
        assert episode.labels is not None
        self._learner.learn(episode.labels)
        if episode.passed is not None:
            self._passes = self._passes + 1 if episode.passed else 0
        instance = _pick(self._instances.test, self._config.seed, _TEST_ORDER, episode.number)
        run(self._learner.rollout(self._test_simulator, instance, TEST, episode.number), self._learner.policies)
        now = time.monotonic()
        sizes = {key: len(data) for key, data in self._learner.data.items()}
        result = wire.EpisodeResult(
            episode=episode.number,
            warm_start=episode.success is None,
            train_success=episode.success,
            test_success=self._test_simulator.succeeded,
            train_steps=episode.steps,
            test_steps=self._test_simulator.steps,
            hi_labels=sizes.get(META, 0),
            lo_labels=sum(size for key, size in sizes.items() if key >= 0 or key == FLAT),
            seconds=round(now - self._clock, 4),
        )
        self._clock = now
        self._client.report(self._run_id, [result])
        self._applied += 1
        if self._applied % self._checkpoint_every == 0:
            self._checkpoint(self.progress)
        self._on_episode(result, episode.units)


def _pick(instances: Any, seed: int, stream: int, number: int) -> Any:
    """Return the instance of an episode: all of them in random order, then all again in another."""
    lap, place = divmod(number, len(instances))
    return instances[np.random.default_rng([seed, stream, lap]).permutation(len(instances))[place]]
