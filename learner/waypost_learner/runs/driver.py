"""The outer loop of the algorithms: draw an instance, ask the episode's queries, learn from its labels, test.

Several episodes may be open at once (`in_flight`). Their results are applied in episode order, and episode t + K starts
right after episode t was applied. With several `environments`, that many episodes start at the same moment, and their
rollouts step together. So a run is a function of its configuration and the answers; the order and the speed
of the answers do not matter. This also holds for training while the expert answers: its amount is fixed, and it ends
before the policies act again. Meanwhile, answers that have come let their episodes ask the next query. A query is
identified by its episode and ordinal, so a restarted learner asks the same queries and pays for each only once.
"""

import time
from collections import deque
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from waypost import wire
from waypost.client import Refused
from waypost.domains import interval_of_tests, replay_of
from waypost.tracing import Step
from waypost_learner.algorithms import Episode
from waypost_learner.algorithms.queries import HierDemo, Query
from waypost_learner.algorithms.uninspected import uninspected
from waypost_learner.policies.labels import Labels
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout import streams
from waypost_learner.rollout.rollout import run
from waypost_learner.rollout.simulator import Start
from waypost_learner.runs.config import START, Progress
from waypost_learner.runs.instances import Instances
from waypost_learner.runs.run_queue import RunQueue
from waypost_learner.runs.setup import Setup

CHECKPOINT_EVERY = 25  # episodes
_UNTIL_NEXT_LOOK = 0.2  # seconds of training while the expert answers, until the learner looks for answers

Withdraw = Callable[[], None]
Offer = Callable[[int, Translator], Withdraw]
"""Offers the environment of the demonstration with this query id to people; returns a function that withdraws it."""


@dataclass(frozen=True)
class Hooks:
    """The functions that a driver calls. A hook that is not given does nothing.

    Args:
        let_answer: called when queries may be open; an expert in this process then answers them.
        on_answer: called with each query whose answer is used, and its id.
        on_episode: called with each episode's result and the units that its answers cost.
        checkpoint: called with the progress whenever the run can be resumed from this point.
        offer: called with each demonstration that is not answered at once, so that people can play it.
    """

    let_answer: Callable[[], None] = lambda: None
    on_answer: Callable[[int, Query], None] = lambda _id, _query: None
    on_episode: Callable[[wire.EpisodeResult, float], None] = lambda _result, _units: None
    checkpoint: Callable[[Progress], None] = lambda _progress: None
    offer: Offer = lambda _query, _translator: lambda: None


@dataclass
class OpenEpisode:
    """An episode that is not applied yet."""

    number: int
    translator: Translator
    generator: Generator[Query, Any, Labels]
    steps: int = 0  # of the learner's rollout; 0 for a demonstration
    success: bool | None = None  # of the learner's rollout; None for a demonstration
    reward: float = 0.0  # of the learner's rollout
    passed: bool | None = None  # whether what is monitored was right; None if no answer said
    ordinal: int = 0  # of the next query
    asked: Query | None = None  # the query that was asked last
    pending: int | None = None  # its id, while its answer is not used
    units: float = 0  # the cost of its answers
    labels: Labels | None = None  # its labels, once it has ended
    withdraw: Withdraw = lambda: None  # withdraws the offer of its environment
    began: int = field(default_factory=time.time_ns)  # in nanoseconds since the epoch

    def resume(self, resume: Callable[[], Query]) -> Query | None:
        """Return the algorithm's next query; None if the episode has ended, with `labels` set."""
        try:
            return resume()
        except StopIteration as end:
            self.labels = end.value
            return None


class Driver:
    """Trains one run.

    Args:
        setup: the configuration, and the objects that it names.
        queue: the run's queries.
        hooks: the functions to call.
        first: the progress to continue from, after a checkpoint was loaded.
    """

    def __init__(self, setup: Setup, queue: RunQueue, hooks: Hooks | None = None, first: Progress = START) -> None:
        self._config, self._algorithm, self._learner = setup.config, setup.algorithm, setup.learner
        self._instances = Instances(setup.instances, setup.config.seed)
        self._queue, self._hooks = queue, hooks or Hooks()
        self._test_simulator = setup.learner.make_simulator()
        # Checkpoints of Q-functions contain the replay buffers, so they are large; and their episodes are short.
        self._checkpoint_every = CHECKPOINT_EVERY * (20 if setup.algorithm.levels.reinforced else 1)
        self._open: deque[OpenEpisode] = deque()
        self._next = self._applied = first.episodes
        self._draws = first.draws
        self._passes = first.passes
        self._clock = time.monotonic()

    @property
    def progress(self) -> Progress:
        """The run's progress."""
        return Progress(self._applied, self._draws, self._passes)

    def train(self) -> None:
        """Train to the last episode.

        Raises:
            BudgetExhausted: the budget was exhausted first.
            Refused: the server refused for another reason; for example, somebody finished the run.
        """
        try:
            while self._open or self._next < self._config.episodes:
                while together := self._may_start():
                    self._start_episodes(range(self._next, self._next + together))
                    self._next += together
                while not self._learner.train_idle(_UNTIL_NEXT_LOOK):
                    self._use_answers(wait=False)
                if self._open[0].labels is not None:
                    self._apply(self._open.popleft())
                else:
                    self._use_answers(wait=True)
        finally:
            for episode in self._open:
                episode.withdraw()

    def _may_start(self) -> int:
        """Return how many episodes may start now; they start together.

        No episode may be open at a checkpoint: its rollout used older weights, so a resumed run could not repeat it.
        """
        since_checkpoint = self._next % self._checkpoint_every
        if since_checkpoint == 0 and self._open:
            return 0
        environments = self._config.environments or 1
        left = self._config.episodes - self._next
        together = min(environments, left, self._checkpoint_every - since_checkpoint)
        return together if len(self._open) + together <= max(self._config.in_flight, environments) else 0

    def _start_episodes(self, numbers: Sequence[int]) -> None:
        """Draw instances and run the episodes up to their first open queries."""
        starts = {number: self._draw(number) for number in numbers}
        self._learner.roll_out_together([s for number, s in starts.items() if not self._is_warm(number)])
        for number, s in starts.items():
            self._start_episode(number, s)

    def _draw(self, number: int) -> Start:
        """Draw the instance of an episode and return its start state."""
        redraw = self._config.redraw and not self._is_warm(number)
        draw = self._instances.failing_draw(self._learner, self._draws) if redraw else self._draws
        self._draws = draw + 1
        return self._learner.start(self._instances.train(draw), draw, self._queue.pictures)

    def _is_warm(self, number: int) -> bool:
        """Return whether an episode belongs to the warm start."""
        return number < self._algorithm.warm_episodes(self._learner.preset)

    def _start_episode(self, number: int, s: Start) -> None:
        """Run an episode from s up to its first open query."""
        warm_start = self._algorithm.warm_start if self._is_warm(number) else None
        generator = (warm_start or self._episode(number))(s, self._learner)
        camera = Camera(self._learner.domain, s.instance) if self._queue.pictures else None
        episode = OpenEpisode(number, Translator(self._learner.domain, s.instance, camera), generator)
        self._open.append(episode)
        query = episode.resume(partial(next, generator))
        if s.simulator.steps:
            episode.steps, episode.success = s.simulator.steps, s.simulator.succeeded
            episode.reward = s.simulator.total_reward
        self._ask(episode, query)

    def _episode(self, number: int) -> Episode:
        """Return the algorithm's episode, or one without queries if sampled monitoring skips this episode."""
        if self._config.redraw or not self._algorithm.monitored:
            return self._algorithm.episode
        rng = np.random.default_rng([self._config.seed, streams.MONITORING, number])
        inspects = self._learner.preset.monitoring.inspects(self._passes, rng)
        return self._algorithm.episode if inspects else uninspected

    def _ask(self, episode: OpenEpisode, query: Query | None) -> None:
        """Ask an episode's query. While the answer is available immediately, ask the next query."""
        while query is not None:
            episode.asked, episode.pending = query, self._put(episode, query)
            self._hooks.let_answer()
            query = self._advance(episode)
            if episode.pending is not None and isinstance(episode.asked, HierDemo):
                episode.withdraw = self._hooks.offer(episode.pending, episode.translator)

    def _put(self, episode: OpenEpisode, query: Query) -> int:
        """Ask a query under the episode's next number, and return its id.

        After a restart, an environment that may be random gives another episode, whose queries differ from those that
        were asked before the restart. They are asked under new numbers.
        """
        translator, repeats = episode.translator, replay_of(self._learner.domain) == "actions"
        while True:
            ask = translator.ask(query, episode.number, episode.ordinal)
            episode.ordinal += 1
            try:
                return self._queue.ask(ask, translator.camera.developed() if translator.camera else {})
            except Refused as refusal:
                if repeats or refusal.name != "different-content":
                    raise

    def _advance(self, episode: OpenEpisode) -> Query | None:
        """Use the pending answer and return the next query; None if there is no answer yet or no further query."""
        assert episode.pending is not None
        assert episode.asked is not None
        used = self._queue.use(episode.pending)
        if used is None:
            return None
        assert used.answer is not None
        self._hooks.on_answer(episode.pending, episode.asked)
        episode.withdraw()
        episode.pending, episode.withdraw = None, lambda: None
        episode.units += used.units or 0
        passed = self._passed(used.ask, used.answer)
        episode.passed = episode.passed if passed is None else passed
        return episode.resume(partial(episode.generator.send, episode.translator.answer(used.answer)))

    def _passed(self, ask: wire.Ask, answer: wire.Answer) -> bool | None:
        """Return whether what is monitored was right, as an answer says; None if it does not say.

        Inspect_FULL says it. Where each pi_g learns by itself, only mu is monitored: its subgoals may all be right in
        an episode that failed.
        """
        if isinstance(answer, wire.InspectAnswer) and answer.kind == "inspect_full":
            return answer.verdict == "pass"
        if isinstance(ask, wire.AskLabelHi) and isinstance(answer, wire.LabelHiAnswer) and self._algorithm.levels.q_lo:
            return answer.subgoals == [segment.subgoal for segment in ask.segments]
        return None

    def _use_answers(self, wait: bool) -> None:
        """Continue the episodes that new answers belong to. If there are none, perhaps wait for them."""
        if all(episode.pending is None for episode in self._open):
            return
        self._hooks.let_answer()
        answered = self._queue.answered(wait)
        for episode in self._open:
            if episode.pending in answered:
                query = self._advance(episode)
                if query is not None:
                    self._ask(episode, query)

    def _apply(self, episode: OpenEpisode) -> None:
        """Learn from an episode, test on an unseen instance if a test is due, and report both."""
        assert episode.labels is not None
        learning = Step("learn", self._queue.run, episode.number)
        self._learner.learn(episode.labels)
        learning.end()
        if episode.passed is not None:
            self._passes = self._passes + 1 if episode.passed else 0
        test_every = self._config.test_every or interval_of_tests(self._learner.domain)
        tested = (episode.number + 1) % test_every == 0
        if tested:
            self._test(episode.number)
        result = self._result(episode, tested)
        self._queue.report(result)
        Step("episode", self._queue.run, episode.number, {"waypost.units": episode.units}, episode.began).end_as_first()
        self._applied += 1
        if self._applied % self._checkpoint_every == 0:
            self._hooks.checkpoint(self.progress)
        self._hooks.on_episode(result, episode.units)

    def _test(self, episode: int) -> None:
        instance = self._instances.test(episode)
        run(self._learner.rollout(self._test_simulator, instance, streams.TEST, episode), self._learner.policies)

    def _attempts(self, episode: OpenEpisode) -> list[wire.Attempt]:
        """Return the attempts at subgoals from which Q-functions learned in an episode, and which nothing led."""
        assert episode.labels is not None
        return [
            wire.Attempt(subgoal=self._learner.domain.subgoals[key.subgoal], reached=segment.outcome == "reached")
            for key, trajectory in episode.labels.experience
            for segment in trajectory
            if key.subgoal is not None and segment.outcome is not None and not segment.led
        ]

    def _result(self, episode: OpenEpisode, tested: bool) -> wire.EpisodeResult:
        """Return the result of an episode, after its test if there was one."""
        now, before = time.monotonic(), self._clock
        self._clock = now
        sizes = dict.fromkeys(("hi", "lo", "flat"), 0)
        for key, data in self._learner.data.items():
            sizes[key.level] += len(data)
        return wire.EpisodeResult(
            episode=episode.number,
            warm_start=episode.success is None,
            train_success=episode.success,
            test_success=self._test_simulator.succeeded if tested else None,
            train_steps=episode.steps,
            test_steps=self._test_simulator.steps if tested else 0,
            reward=episode.reward,
            attempts=self._attempts(episode),
            hi_labels=sizes["hi"],
            lo_labels=sizes["lo"] + sizes["flat"],
            seconds=round(now - before, 4),
        )
