"""Find every right answer to a query, and why it is right, from a domain's oracle.

Answers to gold queries and practice queries are marked against a solution. `OracleExpert` picks its answers from it.
"""

from dataclasses import dataclass
from typing import Any

from waypost import wire
from waypost.domains import Domain, Oracle, oracle_of


@dataclass(frozen=True)
class Solution:
    """The right choices of each label of a query, and one reason per label."""

    known: wire.Known
    reasons: tuple[wire.Reason, ...]


def solve(domain: Domain, ask: wire.Ask) -> Solution:
    """Return all right answers to a query. The first right choice of a label is the oracle's preferred one.

    Raises:
        ValueError: the domain has no oracle, or the query is a demonstration, which has many equally good answers.
    """
    oracle = oracle_of(domain)
    if oracle is None:
        raise ValueError(f"the domain {domain.name!r} has no oracle, so its right answers are not known")
    match ask:
        case wire.AskInspectFull():
            passed = oracle.succeeded(ask.instance, ask.segments[-1].states[-1])
            return _verdict(ask.kind, passed)
        case wire.AskInspectLo():
            (segment,) = ask.segments
            first, last = segment.states[0], segment.states[-1]
            passed = oracle.reached(ask.instance, first, last, _subgoal(domain, segment))
            return _verdict(ask.kind, passed)
        case wire.AskLabelHi():
            return _subgoals(domain, oracle, ask)
        case wire.AskLabelLo():
            return _segment(domain, oracle, ask)
        case wire.AskLabelFull():
            return _actions(domain, oracle, ask)
        case wire.AskHierDemo():
            raise ValueError("a demonstration has no single right answer: many are equally good")


def _subgoals(domain: Domain, oracle: Oracle, ask: wire.AskLabelHi) -> Solution:
    right = [
        [domain.subgoals[good] for good in oracle.good_subgoals(ask.instance, segment.states[0])]
        for segment in ask.segments
    ]
    return Solution(wire.KnownSubgoals(kind="label_hi", subgoals=right), tuple("shortest" for _ in right))


def _segment(domain: Domain, oracle: Oracle, ask: wire.AskLabelLo) -> Solution:
    """Return the right actions up to the state where the segment should end, and this state."""
    (segment,) = ask.segments
    origin, subgoal = segment.states[0], _subgoal(domain, segment)
    right, reasons, end = list[list[str]](), list[wire.Reason](), None
    for step, state in enumerate(segment.states):
        if oracle.reached(ask.instance, origin, state, subgoal):
            reasons.append("accomplished")
            end = step
            break
        if step == len(segment.actions):
            reasons.append("not_accomplished")
            break
        good = oracle.good_actions(ask.instance, origin, state, subgoal)
        if not good:
            reasons.append("no_way")
            end = step
            break
        right.append([domain.actions[action] for action in good])
        reasons.append("shortest")
    return Solution(wire.KnownSegment(kind="label_lo", actions=right, end=end), tuple(reasons))


def _actions(domain: Domain, oracle: Oracle, ask: wire.AskLabelFull) -> Solution:
    right, reasons = list[list[str]](), list[wire.Reason]()
    for segment in ask.segments:
        for state in segment.states[:-1]:
            # An action is on a shortest path to the goal if it is good toward one of the good subgoals.
            good = {
                action: None
                for subgoal in oracle.good_subgoals(ask.instance, state)
                for action in oracle.good_actions(ask.instance, state, state, subgoal)
            }
            right.append([domain.actions[action] for action in good] or list(domain.actions))
            reasons.append("shortest" if good else "no_way")
    return Solution(wire.KnownActions(kind="label_full", actions=right), tuple(reasons))


def _subgoal(domain: Domain, segment: wire.Segment) -> int:
    return domain.subgoals.index(segment.subgoal or "")


def _verdict(kind: Any, passed: bool) -> Solution:
    known = wire.KnownVerdict(kind=kind, verdict="pass" if passed else "fail")
    return Solution(known, ("accomplished" if passed else "not_accomplished",))
