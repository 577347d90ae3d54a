"""Lays a replayed path out as arrays, one entry per state, for formats that store steps.

The facts of an answer go to fixed places, so that nothing is lost or counted twice: a label to the state that it
labels, a verdict and the answer's cost to the last state that the query asks about. `units` of one episode of a run
therefore add up to what the ledger says.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost import wire
from waypost.domains import Domain
from waypost_learner.exchange.replay import Asked, Replay

UNSAID = -1  # no subgoal, action, verdict or termination was given

DESCRIPTION = {
    "run_episode": "the number of the episode in the run; a demonstration and a rollout of it are two episodes here",
    "demonstrated": "1 if the expert carried out the episode, 0 if it is the learner's rollout",
    "segment": "the number of the segment that the state's action belongs to (last state: the segment before)",
    "subgoal": "the subgoal of that segment, in the order of the domain's list; -1 in a flat episode",
    "expert_subgoal": "the expert's subgoal for the state; -1 = the expert did not say",
    "expert_subgoal_by": "who gave it; empty = nobody",
    "expert_action": "the expert's action for the state, toward the segment's subgoal; -1 = the expert did not say",
    "expert_action_by": "who gave it; empty = nobody",
    "expert_termination": "whether the segment that leads to this state should have ended here: 1 yes, 0 no, "
    "-1 = the expert did not say",
    "inspect_lo": "whether the segment that ends in this state accomplished its subgoal: 1 pass, 0 fail, "
    "-1 = not asked",
    "inspect_full": "whether the episode accomplished the task: 1 pass, 0 fail, -1 = not asked (last state only)",
    "annotator": "who gave the answers whose cost is in this entry, joined by commas; empty = nobody",
    "units": "the cost of the answers about segments up to this state, in units",
    "seconds": "the time from lease to answer of the same answers, in seconds",
    "active_seconds": "the working time without idle time of the same answers, in seconds",
}


@dataclass(frozen=True)
class Steps:
    """One episode with T actions as arrays."""

    observations: NDArray[np.float32]  # [T + 1, observation shape]
    actions: NDArray[np.int64]  # [T]
    rewards: NDArray[np.float64]  # [T]
    terminated: bool  # whether the environment ended the episode; otherwise it was cut off
    infos: dict[str, Any]  # one entry per state, [T + 1]; the keys of `DESCRIPTION`; texts are lists


def steps_of(domain: Domain, replay: Replay) -> Steps:
    """Return a path and all answers about it as arrays."""
    path = replay.path
    infos = _unsaid(replay)
    ends = [0, *accumulate(len(segment.actions) for segment in path)]
    for number, (first, segment) in enumerate(zip(ends, path, strict=False)):
        infos["segment"][first:] = number
        infos["subgoal"][first:] = UNSAID if segment.subgoal is None else segment.subgoal
    booked = defaultdict[int, list[wire.AssignmentRecord]](list)
    for asked in replay.asked:
        held = asked.record.answered
        if held is not None and held.answer is not None:
            _say(domain, infos, ends, asked, held.annotator, held.answer.content, replay)
            booked[ends[asked.end]].append(held)
    for place, answers in booked.items():
        infos["annotator"][place] = ",".join(dict.fromkeys(one.annotator for one in answers))
        for name in ("units", "seconds", "active_seconds"):
            infos[name][place] = sum(getattr(one.answer, name) for one in answers)
    states = [path[0].start, *(state for segment in path for state in segment.states[1:])]
    return Steps(
        np.stack([state.observation for state in states]),
        np.array([action for segment in path for action in segment.actions], np.int64),
        np.array([reward for segment in path for reward in segment.rewards], np.float64),
        path[-1].final,
        infos,
    )


def _unsaid(replay: Replay) -> dict[str, Any]:
    """Return the arrays of an episode about which nothing was said."""
    n = 1 + sum(len(segment.actions) for segment in replay.path)
    told = ("expert_subgoal", "expert_action", "expert_termination", "inspect_lo", "inspect_full")
    return {
        "run_episode": np.full(n, replay.episode, np.int64),
        "demonstrated": np.full(n, replay.demonstrated, np.int8),
        **{name: np.full(n, UNSAID, np.int64) for name in ("segment", "subgoal", *told)},
        **{name: [""] * n for name in ("expert_subgoal_by", "expert_action_by", "annotator")},
        **{name: np.zeros(n) for name in ("units", "seconds", "active_seconds")},
    }


def _say(
    domain: Domain,
    infos: dict[str, Any],
    ends: Sequence[int],
    asked: Asked,
    by: str,
    content: wire.Answer,
    replay: Replay,
) -> None:
    """Write one answer to its places."""
    starts, end = ends[asked.first : asked.end], ends[asked.end]
    match content:
        case wire.HierDemoAnswer():
            for start, segment in zip(starts, replay.path, strict=True):
                if segment.subgoal is not None:
                    _label_hi(infos, start, segment.subgoal, by)
                    infos["expert_termination"][start + 1 : start + len(segment.actions)] = 0
                    ended = segment.terminated or segment.final
                    infos["expert_termination"][start + len(segment.actions)] = ended
                _label_lo(infos, start, segment.actions, by)
        case wire.InspectAnswer():
            infos[content.kind][end] = int(content.verdict == "pass")
        case wire.LabelHiAnswer():
            for start, name in zip(starts, content.subgoals, strict=True):
                _label_hi(infos, start, domain.subgoals.index(name), by)
        case wire.LabelLoAnswer():
            # The learner uses the labels up to the first true termination. omega_1 has no place of its own: where it
            # is true, no action of the segment has a label.
            stop = [*content.terminations, True].index(True)
            actions = [domain.actions.index(name) for name in content.actions[:stop] if name is not None]
            _label_lo(infos, starts[0], actions, by)
            said = content.terminations[1 : stop + 1]
            infos["expert_termination"][starts[0] + 1 : starts[0] + 1 + len(said)] = said
        case wire.LabelFullAnswer():
            _label_lo(infos, starts[0], [domain.actions.index(name) for name in content.actions], by)


def _label_hi(infos: dict[str, Any], place: int, subgoal: int, by: str) -> None:
    infos["expert_subgoal"][place] = subgoal
    infos["expert_subgoal_by"][place] = by


def _label_lo(infos: dict[str, Any], place: int, actions: Sequence[int], by: str) -> None:
    infos["expert_action"][place : place + len(actions)] = actions
    infos["expert_action_by"][place : place + len(actions)] = [by] * len(actions)
