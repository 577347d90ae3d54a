"""Find every right answer to a query, and the reasons, from a domain's oracle.

Answers to gold queries and practice queries are marked against a solution. `OracleExpert` picks its answers from it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from waypost import wire
from waypost.domains import Domain, Oracle, oracle_of


@dataclass(frozen=True)
class Solution:
    """The right choices of each label of a query, and one reason per label."""

    known: wire.Known
    reasons: tuple[str, ...]


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
            reason = f"The task is {_accomplished(passed)} in the last state."
            return Solution(_verdict(ask.kind, passed), (reason,))
        case wire.AskInspectLo():
            (segment,) = ask.segments
            first, last = segment.states[0], segment.states[-1]
            passed = oracle.reached(ask.instance, first, last, _subgoal(domain, segment))
            reason = f"In the last state {_quoted(segment.subgoal)} is {_accomplished(passed)}."
            return Solution(_verdict(ask.kind, passed), (reason,))
        case wire.AskLabelHi():
            return _subgoals(domain, oracle, ask)
        case wire.AskLabelLo():
            return _segment(domain, oracle, ask)
        case wire.AskLabelFull():
            return _actions(domain, oracle, ask)
        case wire.AskHierDemo():
            raise ValueError("a demonstration has no single right answer: many are equally good")


def _subgoals(domain: Domain, oracle: Oracle, ask: wire.AskLabelHi) -> Solution:
    right, reasons = list[list[str]](), list[str]()
    for segment in ask.segments:
        names = [domain.subgoals[good] for good in oracle.good_subgoals(ask.instance, segment.states[0])]
        right.append(names)
        reasons.append(_reason(names, segment.subgoal, "is on a shortest path from here"))
    return Solution(wire.KnownSubgoals(kind="label_hi", subgoals=right), tuple(reasons))


def _segment(domain: Domain, oracle: Oracle, ask: wire.AskLabelLo) -> Solution:
    """Return the right actions up to the state where the segment should end, and this state."""
    (segment,) = ask.segments
    origin, subgoal, name = segment.states[0], _subgoal(domain, segment), _quoted(segment.subgoal)
    right, reasons, end = list[list[str]](), list[str](), None
    for step, (state, own) in enumerate(zip(segment.states, [*segment.actions, None], strict=False)):
        if oracle.reached(ask.instance, origin, state, subgoal):
            reasons.append(f"Here {name} is accomplished, so the segment should end.")
            end = step
            break
        if own is None:
            reasons.append(f"In the last state {name} is not accomplished yet.")
            break
        good = oracle.good_actions(ask.instance, origin, state, subgoal)
        if not good:
            reasons.append(f"There is no way to {name} from here, so the segment should end.")
            end = step
            break
        names = [domain.actions[action] for action in good]
        right.append(names)
        reasons.append(_reason(names, own, f"leads toward {name}"))
    return Solution(wire.KnownSegment(kind="label_lo", actions=right, end=end), tuple(reasons))


def _actions(domain: Domain, oracle: Oracle, ask: wire.AskLabelFull) -> Solution:
    right, reasons = list[list[str]](), list[str]()
    for segment in ask.segments:
        for state, own in zip(segment.states, segment.actions, strict=False):
            # An action is on a shortest path to the goal if it is good toward one of the good subgoals.
            good = {
                action: None
                for subgoal in oracle.good_subgoals(ask.instance, state)
                for action in oracle.good_actions(ask.instance, state, state, subgoal)
            }
            names = [domain.actions[action] for action in good]
            right.append(names or list(domain.actions))
            reasons.append(
                _reason(names, own, "is on a shortest path") if names else "No action leads to the goal from here."
            )
    return Solution(wire.KnownActions(kind="label_full", actions=right), tuple(reasons))


def _reason(right: Sequence[str], own: str | None, does: str) -> str:
    """Return the reason why some choices are right; if the learner's own choice is wrong, say so too."""
    first, *others = (_quoted(name) for name in right)
    reason = f"{first} {does}" + (f"; {' and '.join(others)} is as good." if others else ".")
    return (
        reason if own is None or own in right else f"{reason} {_quoted(own)}, the learner's choice, does not do that."
    )


def _accomplished(passed: bool) -> str:
    return "accomplished" if passed else "not accomplished"


def _quoted(name: str | None) -> str:
    return f"“{(name or '').replace('_', ' ')}”"


def _subgoal(domain: Domain, segment: wire.Segment) -> int:
    return domain.subgoals.index(segment.subgoal or "")


def _verdict(kind: Any, passed: bool) -> wire.KnownVerdict:
    return wire.KnownVerdict(kind=kind, verdict="pass" if passed else "fail")
