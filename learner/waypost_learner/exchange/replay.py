"""Carries out the recorded actions of a run again, to get the observations and rewards along them.

Records have JSON views of states, not observations. The instances come from the run's configuration, as they did when
the run was trained. Every instance and every state must look as it was recorded, so data of a domain that has changed
are refused, not silently wrong.
"""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from waypost import wire
from waypost.domains import Domain, find_domain, place_of
from waypost.trajectory import Segment, Trajectory
from waypost_learner.experts.head_start import head_start
from waypost_learner.rollout.demonstrations import judged
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.config import config_of
from waypost_learner.runs.instances import Instances

MOST_DRAWS = 512  # searched for an episode's instance; a run with `redraw` draws several for one episode


@dataclass(frozen=True)
class Asked:
    """A query about a part of a path: the segments from `first` to before `end`."""

    record: wire.QueryRecord
    first: int
    end: int


@dataclass(frozen=True)
class Replay:
    """One path through the environment, and the queries about it.

    Args:
        episode: the number of the episode in the run.
        instance: the environment instance.
        demonstrated: whether the expert carried it out; otherwise it is the learner's rollout.
        path: its segments, with observations and rewards.
        asked: the queries about it, in the order in which they were asked.
    """

    episode: int
    instance: Any
    demonstrated: bool
    path: Trajectory
    asked: tuple[Asked, ...]


class Replayer:
    """Carries out the actions of one run again.

    Args:
        run: the run.

    Raises:
        ValueError: its domain is not installed or has other names, or `waypost train` did not make it.
    """

    def __init__(self, run: wire.Run) -> None:
        self.domain = _domain(run)
        try:
            config = config_of(run.config)
        except TypeError as error:
            raise ValueError(
                f"run {run.id} has no configuration of `waypost train`, so its instances cannot be drawn again"
            ) from error
        start = None if config.head_start is None else head_start(self.domain, config.head_start)
        self._simulator = Simulator(self.domain, start)
        self._instances = Instances(self.domain.instances(config.instances), config.seed)
        self._redraws = config.redraw
        self._draw = -1  # of the last instance that was found

    def episodes(self, records: Iterable[wire.Record]) -> Iterator[tuple[int, list[Replay]]]:
        """Yield each episode that has queries, with its paths. Records that are no queries are passed over.

        Raises:
            ValueError: an instance or a state does not look as it was recorded.
        """
        queries = (record for record in records if isinstance(record, wire.QueryRecord))
        for episode, some in groupby(queries, key=lambda record: record.ask.episode):
            yield episode, self._episode(episode, list(some))

    def _episode(self, episode: int, records: Sequence[wire.QueryRecord]) -> list[Replay]:
        instance = self._instance(episode, records[0].ask.instance)
        replays = [self._demonstration(instance, record) for record in records if _demonstrates(record)]
        about = [record for record in records if not isinstance(record.ask, wire.AskHierDemo)]
        if about:
            replays.append(self._rollout(instance, about))
        return replays

    def _instance(self, episode: int, view: Any) -> Any:
        """Return the instance of an episode. Draws are numbered in the order of the episodes."""
        draws = range(self._draw + 1, self._draw + 1 + MOST_DRAWS) if self._redraws else (episode,)
        for draw in draws:
            instance = self._instances.train(draw)
            if _plain(self.domain.instance_view(instance)) == view:
                self._draw = draw
                return instance
        raise ValueError(
            f"episode {episode}: its instance cannot be drawn again; has the domain {self.domain.name!r} changed?"
        )

    def _demonstration(self, instance: Any, record: wire.QueryRecord) -> Replay:
        assert record.answered is not None
        assert record.answered.answer is not None
        given = record.answered.answer.content
        assert isinstance(given, wire.HierDemoAnswer)
        earlier = record.ask.context  # of the learner: the demonstration goes on from there
        segments = [(segment.subgoal, segment.actions) for segment in earlier]
        segments += [(segment.subgoal, segment.actions) for segment in given.segments]
        path = self._carried_out(instance, segments)
        self._check(record.ask.episode, path, earlier)
        path = judged(self.domain, instance, path[len(earlier) :])
        return Replay(record.ask.episode, instance, True, path, (Asked(record, 0, len(path)),))

    def _rollout(self, instance: Any, records: Sequence[wire.QueryRecord]) -> Replay:
        """Return the learner's rollout: each query shows it from the start up to what it asks about."""
        shown = [_shown(record.ask) for record in records]
        longest = max(shown, key=len)
        path = self._carried_out(instance, [(segment.subgoal, segment.actions) for segment in longest])
        for segments in shown:
            self._check(records[0].ask.episode, path, segments)
        asked = tuple(
            Asked(record, len(record.ask.context), len(segments))
            for record, segments in zip(records, shown, strict=True)
        )
        return Replay(records[0].ask.episode, instance, False, path, asked)

    def _carried_out(self, instance: Any, segments: Sequence[tuple[str | None, Sequence[str]]]) -> Trajectory:
        """Return segments as they run in the environment. Actions after the end of the episode are ignored."""
        simulator, path = self._simulator, list[Segment]()
        state = simulator.reset(instance)
        for name, names in segments:
            subgoal = None if name is None else self.domain.subgoals.index(name)
            states, actions, rewards = [state], list[int](), list[float]()
            for action in names:
                if simulator.ended:
                    break
                actions.append(self.domain.actions.index(action))
                states.append(simulator.step(actions[-1]))
                rewards.append(simulator.reward)
            if actions:
                path.append(
                    Segment(
                        subgoal,
                        tuple(states),
                        tuple(actions),
                        terminated=subgoal is not None,
                        rewards=tuple(rewards),
                        final=simulator.final,
                    )
                )
            state = states[-1]
        return tuple(path)

    def _check(self, episode: int, path: Trajectory, recorded: Sequence[wire.Segment]) -> None:
        made = [[_plain(state.view) for state in segment.states] for segment in path[: len(recorded)]]
        if made != [segment.states for segment in recorded]:
            raise ValueError(
                f"episode {episode}: its actions lead to other states; has the domain {self.domain.name!r} changed?"
            )


def _domain(run: wire.Run) -> Domain:
    domain, names = find_domain(place_of(run)), run.vocabulary
    if (list(domain.subgoals), list(domain.actions)) != (names.subgoals, names.actions):
        raise ValueError(f"the domain {domain.name!r} has other subgoals or actions than run {run.id}")
    return domain


def _demonstrates(record: wire.QueryRecord) -> bool:
    return isinstance(record.ask, wire.AskHierDemo) and record.answered is not None


def _shown(ask: wire.Ask) -> list[wire.Segment]:
    assert not isinstance(ask, wire.AskHierDemo)
    return [*ask.context, *ask.segments]


def _plain(view: Any) -> Any:
    """Return a JSON view as it comes back from a record: with lists for tuples."""
    return json.loads(json.dumps(view))
