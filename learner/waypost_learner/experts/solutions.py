"""All that is right, and why: a domain's oracle on queries whose answers are to be known beforehand.

Gold queries and practice are marked against it. Unlike an answer it has every choice that is as good as the best.
"""

from dataclasses import dataclass
from typing import Any

from waypost import wire
from waypost.domain import Domain, Oracle


@dataclass(frozen=True)
class Solution:
    """What is right for a query, and why, label by label."""

    known: wire.Known
    reasons: tuple[str, ...]


def solve(domain: Domain, ask: wire.Ask) -> Solution:
    """Return what is right for a query.

    Raises:
        ValueError: the domain has no oracle, or the query is a demonstration, of which many are as good.
    """
    if domain.oracle is None:
        raise ValueError(f"the domain {domain.name!r} has no oracle: nothing is known of its answers")
    match ask:
        case wire.AskInspectFull():
            passed = domain.oracle.succeeded(ask.instance, ask.segments[-1].states[-1])
            why = (
                "The task is accomplished in the last state."
                if passed
                else "The task is not accomplished in the last state."
            )
            return Solution(_verdict(ask.kind, passed), (why,))
        case wire.AskInspectLo():
            (segment,) = ask.segments
            first, last = segment.states[0], segment.states[-1]
            passed = domain.oracle.reached(ask.instance, first, last, _subgoal(domain, segment))
            done = "is accomplished" if passed else "is not accomplished"
            return Solution(_verdict(ask.kind, passed), (f"In the last state {_quoted(segment.subgoal)} {done}.",))
        case wire.AskLabelHi():
            return _subgoals(domain, domain.oracle, ask)
        case wire.AskLabelLo():
            return _segment(domain, domain.oracle, ask)
        case wire.AskLabelFull():
            return _actions(domain, domain.oracle, ask)
        case wire.AskHierDemo():
            raise ValueError("a demonstration cannot be known beforehand: many are as good")


def _subgoals(domain: Domain, oracle: Oracle, ask: wire.AskLabelHi) -> Solution:
    right, reasons = list[list[str]](), list[str]()
    for segment in ask.segments:
        names = [domain.subgoals[good] for good in oracle.good_subgoals(ask.instance, segment.states[0])]
        right.append(names)
        reasons.append(_why(names, segment.subgoal, "leads on by a shortest way from here"))
    return Solution(wire.KnownSubgoals(kind="label_hi", subgoals=right), tuple(reasons))


def _segment(domain: Domain, oracle: Oracle, ask: wire.AskLabelLo) -> Solution:
    (segment,) = ask.segments
    origin, subgoal = segment.states[0], _subgoal(domain, segment)
    right, reasons = list[list[str]](), list[str]()
    for step, state in enumerate(segment.states):
        if oracle.reached(ask.instance, origin, state, subgoal):
            reasons.append(f"Here {_quoted(segment.subgoal)} is accomplished, so the segment should end.")
            return Solution(wire.KnownSegment(kind="label_lo", actions=right, end=step), tuple(reasons))
        good = oracle.good_actions(ask.instance, origin, state, subgoal)
        if not good and step < len(segment.actions):
            reasons.append(f"There is no way to {_quoted(segment.subgoal)} from here, so the segment should end.")
            return Solution(wire.KnownSegment(kind="label_lo", actions=right, end=step), tuple(reasons))
        if step < len(segment.actions):
            names = [domain.actions[action] for action in good]
            right.append(names)
            reasons.append(_why(names, segment.actions[step], f"brings {_quoted(segment.subgoal)} nearer"))
    reasons.append(f"In the last state {_quoted(segment.subgoal)} is not accomplished yet.")
    return Solution(wire.KnownSegment(kind="label_lo", actions=right, end=None), tuple(reasons))


def _actions(domain: Domain, oracle: Oracle, ask: wire.AskLabelFull) -> Solution:
    right, reasons = list[list[str]](), list[str]()
    for segment in ask.segments:
        for state, own in zip(segment.states, segment.actions, strict=False):
            # On a shortest way to the end are just the good actions toward each of the good subgoals.
            good = {
                action: None
                for subgoal in oracle.good_subgoals(ask.instance, state)
                for action in oracle.good_actions(ask.instance, state, state, subgoal)
            }
            names = [domain.actions[action] for action in good]
            right.append(names)
            reasons.append(_why(names, own, "is on a shortest way"))
    return Solution(wire.KnownActions(kind="label_full", actions=right), tuple(reasons))


def _why(right: list[str], own: str | None, does: str) -> str:
    """Say why some choices are right, and what that makes of the learner's own."""
    first, *others = (_quoted(name) for name in right)
    why = f"{first} {does}" + (f"; {' and '.join(others)} is as good." if others else ".")
    return why if own is None or own in right else f"{why} {_quoted(own)}, the learner's choice, does not do that."


def _quoted(name: str | None) -> str:
    return f"“{(name or '').replace('_', ' ')}”"


def _subgoal(domain: Domain, segment: wire.Segment) -> int:
    return domain.subgoals.index(segment.subgoal or "")


def _verdict(kind: Any, passed: bool) -> wire.KnownVerdict:
    return wire.KnownVerdict(kind=kind, verdict="pass" if passed else "fail")
