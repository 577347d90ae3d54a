"""Make practice queries: rollouts of a learner that sometimes errs, with the right answers from the domain's oracle.

A file of them has demonstrations to look at, too.
"""

import json
from base64 import b64encode
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any

import numpy as np

from waypost import wire
from waypost.domains import Domain, Oracle, oracle_of
from waypost.trajectory import Segment, Trajectory, n_steps
from waypost_learner.algorithms.queries import InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Query
from waypost_learner.experts.solutions import solve
from waypost_learner.experts.worked import demonstrations
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator

WRONG_SUBGOAL, WRONG_ACTION, WRONG_END = 0.12, 0.04, 0.1  # probabilities of the learner's errors
CANDIDATES = 150  # rollouts from which the exercises of a file are picked
MOST_ACTIONS, MOST_SEGMENTS = 14, 6  # upper limits for one exercise


@dataclass(frozen=True)
class Rollout:
    """One rollout of the erring learner."""

    instance: Any
    sigma: Trajectory
    succeeded: bool


def practice(domain: Domain, instances: str, seed: int) -> str:
    """Return the text of a file of practice queries.

    Args:
        domain: the domain; its oracle gives the right answers.
        instances: the name of a set of instances, or a file.
        seed: fixes the rollouts.

    Raises:
        ValueError: the domain has no oracle, or no rollout is suitable.
    """
    content, frames = made(domain, instances, seed)
    pictures = [json.dumps({"hash": one, "png": b64encode(file).decode()}) for one, file in frames.items()]
    parts = [f'"vocabulary": {vocabulary(domain).model_dump_json()}']
    if pictures:
        parts.append(f'"frames": {_lines(pictures)}')
    parts.append(f'"exercises": {_lines([one.model_dump_json() for one in content.exercises])}')
    parts.append(f'"demonstrations": {_lines([one.model_dump_json() for one in content.demonstrations])}')
    return "{" + ",\n".join(parts) + "}\n"


def made(
    domain: Domain, instances: str, seed: int, candidates: int = CANDIDATES
) -> tuple[wire.PracticePut, dict[str, bytes]]:
    """Return practice queries, two of each kind if the rollouts contain suitable ones, and their pictures by hash.

    With them comes a demonstration for each way in which one is asked for, if the oracle can give one.

    Raises:
        ValueError: the domain has no oracle, or no rollout is suitable.
    """
    oracle = oracle_of(domain)
    if oracle is None:
        raise ValueError(f"the domain {domain.name!r} has no oracle, so its right answers are not known")
    rollouts = list(islice(_rollouts(domain, oracle, instances, seed), candidates))
    picks = [pick for pick in _picks() if domain.subgoals or pick.flat]
    found = [_exercise(domain, rollouts, place, pick) for place, pick in enumerate(picks)]
    exercises = [one for one in found if one is not None]
    if not exercises:
        raise ValueError("no rollout is suitable for practice: try another --seed")
    shown = list(demonstrations(domain, oracle, [(one.instance, one.sigma) for one in rollouts]))
    frames: dict[str, bytes] = {}
    for taken in [*(files for _, files in exercises), *(files for _, files in shown)]:
        frames |= taken
    content = wire.PracticePut(
        exercises=[exercise for exercise, _ in exercises], demonstrations=[one for one, _ in shown]
    )
    return content, frames


def _lines(values: Sequence[str]) -> str:
    return "[\n" + ",\n".join(values) + "\n]"


def _rollouts(domain: Domain, oracle: Oracle, instances: str, seed: int) -> Iterator[Rollout]:
    """Yield rollouts of a learner that mostly follows the oracle."""
    rng, simulator = np.random.default_rng(seed), Simulator(domain)
    train = domain.instances(instances).train
    while True:
        instance = train[int(rng.integers(len(train)))]
        state, sigma, view = simulator.reset(instance), list[Segment](), domain.instance_view(instance)
        while not simulator.ended and len(sigma) < domain.horizons.hi:
            subgoal = oracle.good_subgoals(view, state.view)[0]
            if rng.random() < WRONG_SUBGOAL:
                subgoal = int(rng.integers(len(domain.subgoals)))
            states, actions = [state], list[int]()
            terminated = False
            while not terminated and not simulator.ended and len(actions) < domain.horizons.lo:
                good = oracle.good_actions(view, states[0].view, state.view, subgoal)
                if not good or rng.random() < WRONG_ACTION:
                    good = [int(rng.integers(len(domain.actions)))]
                state = simulator.step(good[0])
                actions.append(good[0])
                states.append(state)
                reached = oracle.reached(view, states[0].view, state.view, subgoal)
                terminated = reached and rng.random() >= WRONG_END
            sigma.append(Segment(subgoal, tuple(states), tuple(actions), terminated))
        yield Rollout(instance, tuple(sigma), simulator.succeeded)


@dataclass(frozen=True)
class Pick:
    """How to pick one exercise: take the query with the highest `worth` of all rollouts, if it is above 0."""

    queries: Callable[[Rollout], Iterator[Query]]
    worth: Callable[[wire.Known, wire.Ask], float]
    flat: bool = False  # whether it also suits domains without subgoals
    spare: Callable[[Rollout], Iterator[Query]] | None = None  # queries to take if none of `queries` is suitable


def _picks() -> list[Pick]:
    return [
        Pick(_inspect_full, lambda known, ask: _is(known, "pass") / _length(ask), flat=True),
        Pick(_inspect_full, lambda known, ask: _is(known, "fail") * _length(ask), flat=True, spare=_unfinished),
        Pick(_inspect_lo, lambda known, ask: _is(known, "pass") * _length(ask)),
        Pick(_inspect_lo, lambda known, ask: _is(known, "fail") * _length(ask)),
        Pick(_label_hi, lambda known, ask: _errors(known, ask) == 1),
        Pick(_label_hi, lambda known, ask: (_errors(known, ask) == 2) * (1 + _choices(known))),
        Pick(_label_lo, lambda known, ask: (_errors(known, ask) == 1 and not _ends_early(known, ask)) * _length(ask)),
        Pick(_label_lo, lambda known, ask: _ends_early(known, ask) * _length(ask)),
        Pick(_label_full, lambda known, ask: (_errors(known, ask) == 1) * _length(ask), flat=True),
        Pick(_label_full, lambda known, ask: (_errors(known, ask) == 2) * (1 + _choices(known)), flat=True),
    ]


def _exercise(
    domain: Domain, rollouts: list[Rollout], place: int, pick: Pick
) -> tuple[wire.Exercise, dict[str, bytes]] | None:
    """Return an exercise and the PNG files of its frames by their hashes; None if no rollout is suitable."""
    best = _best(domain, rollouts, pick.queries, pick.worth)
    if best is None and pick.spare is not None:
        best = _best(domain, rollouts, pick.spare, pick.worth)
    if best is None:
        return None
    rollout, query = best
    camera = Camera(domain, rollout.instance)  # only now, because pictures take long
    ask = Translator(domain, rollout.instance, camera).ask(query, episode=0, ordinal=place)
    solution = solve(domain, ask)
    exercise = wire.Exercise(ask=ask, known=solution.known, reasons=list(solution.reasons))
    return exercise, camera.developed()


def _best(
    domain: Domain,
    rollouts: list[Rollout],
    queries: Callable[[Rollout], Iterator[Query]],
    worth: Callable[[wire.Known, wire.Ask], float],
) -> tuple[Rollout, Query] | None:
    """Return the first query with the highest worth, and its rollout; None if no worth is above 0."""
    best, most = None, 0.0
    for rollout in rollouts:
        translator = Translator(domain, rollout.instance)
        for query in queries(rollout):
            ask = translator.ask(query, episode=0, ordinal=0)
            found = float(worth(solve(domain, ask).known, ask))
            if found > most:
                best, most = (rollout, query), found
    return best


# --- the queries of a rollout


def _inspect_full(rollout: Rollout) -> Iterator[Query]:
    yield InspectFull(rollout.sigma)


def _unfinished(rollout: Rollout) -> Iterator[Query]:
    """Yield the rollout without its end, for a domain in which even a learner that errs always succeeds."""
    if len(rollout.sigma) > 1:
        yield InspectFull(rollout.sigma[:-1])


def _inspect_lo(rollout: Rollout) -> Iterator[Query]:
    for place, segment in enumerate(rollout.sigma):
        yield InspectLo(segment, rollout.sigma[:place])


def _label_hi(rollout: Rollout) -> Iterator[Query]:
    if 3 <= len(rollout.sigma) <= MOST_SEGMENTS:
        yield LabelHi(rollout.sigma)


def _label_lo(rollout: Rollout) -> Iterator[Query]:
    for place, segment in enumerate(rollout.sigma):
        yield LabelLo(segment, rollout.sigma[:place])


def _label_full(rollout: Rollout) -> Iterator[Query]:
    if 4 <= n_steps(rollout.sigma) <= MOST_ACTIONS:
        yield LabelFull(rollout.sigma)


# --- the worth of a query as an exercise


def _is(known: wire.Known, verdict: str) -> bool:
    return isinstance(known, wire.KnownVerdict) and known.verdict == verdict


def _length(ask: wire.Ask) -> int:
    return 0 if isinstance(ask, wire.AskHierDemo) else sum(len(segment.actions) for segment in ask.segments)


def _right(known: wire.Known) -> list[list[str]]:
    return known.subgoals if isinstance(known, wire.KnownSubgoals) else getattr(known, "actions", [])


def _errors(known: wire.Known, ask: wire.Ask) -> int:
    """Return the number of labels for which the learner's own choice is wrong."""
    suggestion: Any = ask.suggestion
    own = suggestion.subgoals if isinstance(known, wire.KnownSubgoals) else suggestion.actions
    return sum(choice not in right for choice, right in zip(own, _right(known), strict=False))


def _choices(known: wire.Known) -> int:
    """Return the number of labels for which several choices are right."""
    return sum(len(right) > 1 for right in _right(known))


def _ends_early(known: wire.Known, ask: wire.Ask) -> bool:
    """Return whether the segment should have ended earlier, but not in its first state."""
    return isinstance(known, wire.KnownSegment) and known.end is not None and 0 < known.end < _length(ask)
