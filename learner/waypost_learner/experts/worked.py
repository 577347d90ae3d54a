"""Choose demonstrations to look at: the oracle's shortest ones, one for each way in which they are asked for."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

from waypost import wire
from waypost.domains import Domain, Oracle
from waypost.trajectory import Segment, Trajectory, n_steps
from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.stage import Stage
from waypost_learner.remote.translation import Translator

FEWEST_STEPS = 3  # of the segment that failed, and of the one that is played after it


@dataclass(frozen=True)
class Candidate:
    """A query that asks for a demonstration, and the oracle's answer."""

    instance: Any
    query: HierDemo
    answer: wire.HierDemoAnswer
    worth: tuple[bool, int]  # the smallest is the best


def demonstrations(
    domain: Domain, oracle: Oracle, rollouts: Sequence[tuple[Any, Trajectory]]
) -> Iterator[tuple[wire.WorkedDemonstration, dict[str, bytes]]]:
    """Yield a hierarchical demonstration, a flat one, and one that plays on where a segment failed.

    A way is left out if the oracle cannot demonstrate, or if no rollout suits it.

    Args:
        domain: the domain.
        oracle: its oracle.
        rollouts: instances, each with the trajectory of a learner that sometimes errs.

    Yields:
        the demonstration, and the PNG files of its frames by their hashes.
    """
    starts = {repr(domain.instance_view(instance)): (instance, sigma[0].start) for instance, sigma in rollouts}
    ways = [[(instance, HierDemo(state, flat=True)) for instance, state in starts.values()]]
    if domain.subgoals:
        whole = [(instance, HierDemo(state)) for instance, state in starts.values()]
        failed = [(instance, one) for instance, sigma in rollouts for one in _failed(domain, oracle, instance, sigma)]
        ways = [whole, *ways, failed]
    for asked in ways:
        candidates = sorted(_candidates(domain, asked), key=lambda one: one.worth)
        played = (_played(domain, oracle, one) for one in candidates)
        yield from islice(filter(None, played), 1)


def _failed(domain: Domain, oracle: Oracle, instance: Any, sigma: Trajectory) -> Iterator[HierDemo]:
    """Yield the query that plays on after the first wrong action, as if its segment ended there.

    Its subgoal and all before it were right, and the episode went on.
    """
    view = domain.instance_view(instance)
    for place, segment in enumerate(sigma):
        origin, subgoal = segment.start.view, segment.subgoal
        if subgoal is None or subgoal not in oracle.good_subgoals(view, origin):
            return
        for step, (state, action) in enumerate(zip(segment.states, segment.actions, strict=False)):
            if action in oracle.good_actions(view, origin, state.view, subgoal):
                continue
            goes_on = place < len(sigma) - 1 or step < len(segment.actions) - 1
            if goes_on and not oracle.reached(view, origin, segment.states[step + 1].view, subgoal):
                cut = Segment(subgoal, segment.states[: step + 2], segment.actions[: step + 1], terminated=True)
                yield HierDemo(cut.states[-1], before=(*sigma[:place], cut), max_segments=1)
            return
        if not oracle.reached(view, origin, segment.states[-1].view, subgoal):
            return


def _candidates(domain: Domain, asked: Sequence[tuple[Any, HierDemo]]) -> Iterator[Candidate]:
    expert = OracleExpert(domain)
    for instance, query in asked:
        try:
            answer = expert(Translator(domain, instance).ask(query, episode=0, ordinal=0))
        except ValueError:  # the oracle cannot demonstrate, or no action is good here
            continue
        assert isinstance(answer, wire.HierDemoAnswer)
        yield Candidate(instance, query, answer, _worth(query, answer))


def _worth(query: HierDemo, answer: wire.HierDemoAnswer) -> tuple[bool, int]:
    """Return the number of steps to look at, after whether there is too little to see: one segment, or a few steps."""
    shown = sum(len(segment.actions) for segment in answer.segments)
    if query.before:
        is_little = min(shown, len(query.before[-1].actions)) < FEWEST_STEPS
    else:
        is_little = not query.flat and len(answer.segments) < 2
    return (is_little, n_steps(query.before) + shown)


def _played(domain: Domain, oracle: Oracle, one: Candidate) -> tuple[wire.WorkedDemonstration, dict[str, bytes]] | None:
    """Return a demonstration as a person would have seen it; None if it does not end as an example should."""
    frames = dict[str, bytes]()
    camera = Camera(domain, one.instance)
    translator = Translator(domain, one.instance, camera)
    ask = translator.ask(one.query, episode=0, ordinal=0)
    assert isinstance(ask, wire.AskHierDemo)
    moves = wire.PlayMoves(type="moves", number=0, segments=one.answer.segments, known=0)
    seen = Stage(translator, frames.update).perform(moves)
    if one.query.before:
        subgoal = domain.subgoals.index(one.answer.segments[0].subgoal or "")
        is_good = not seen.ended and oracle.reached(ask.instance, seen.states[0], seen.states[-1], subgoal)
    else:
        is_good = seen.ended and seen.succeeded
    if not is_good:
        return None
    replay = wire.DemoReplay(
        states=seen.states, frames=seen.frames, landmarks=seen.landmarks, action_landmarks=seen.action_landmarks
    )
    answer = one.answer.model_copy(update={"replay": replay})
    return wire.WorkedDemonstration(ask=ask, answer=answer), frames | camera.developed()
