"""Scoring: compares answers with known answers, label by label.

A label is a verdict, a subgoal, an action, or the termination of a segment. A label can have several right choices.
"""

from collections.abc import Sequence
from itertools import chain, zip_longest
from typing import assert_never, cast

from pydantic import TypeAdapter

from waypost import wire
from waypost_server.errors import Location, Unprocessable
from waypost_server.queries import checks

KNOWN: TypeAdapter[wire.Known] = TypeAdapter(wire.Known)

DONE, NOT_DONE = "(done)", "(not done)"


def exactly(answer: wire.Answer) -> wire.Known:
    """Return the known answer for which only this answer is right.

    Raises:
        Unprocessable: a demonstration. Many demonstrations are equally good, and the server cannot execute them.
    """
    match answer:
        case wire.InspectAnswer():
            return wire.KnownVerdict(kind=answer.kind, verdict=answer.verdict)
        case wire.LabelHiAnswer():
            return wire.KnownSubgoals(kind="label_hi", subgoals=[[name] for name in answer.subgoals])
        case wire.LabelLoAnswer():
            end = _end(answer)
            names = cast(list[str], answer.actions[:end])  # no action is null before the end
            return wire.KnownSegment(kind="label_lo", actions=[[name] for name in names], end=end)
        case wire.LabelFullAnswer():
            return wire.KnownActions(kind="label_full", actions=[[name] for name in answer.actions])
        case wire.HierDemoAnswer():
            raise Unprocessable(["body", "answered"], "a demonstration cannot be gold, because many others are as good")
        case _:
            assert_never(answer)


def check(ask: wire.Ask, known: wire.Known, names: checks.Names, at: Location) -> None:
    """Refuse a known answer that does not fit its query: wrong kind or length, or names that the run lacks."""
    if known.kind != ask.kind:
        raise Unprocessable([*at, "kind"], f"is {known.kind}; the query is {ask.kind}")
    match known, ask:
        case wire.KnownSubgoals(), wire.AskLabelHi():
            checks.check_length(known.subgoals, len(ask.segments), [*at, "subgoals"], "segments")
            for name in chain.from_iterable(known.subgoals):
                names.check_subgoal(name, [*at, "subgoals"])
        case wire.KnownSegment(), wire.AskLabelLo():
            n_actions = len(ask.segments[0].actions)
            if known.end is not None and known.end > n_actions:
                raise Unprocessable([*at, "end"], f"is {known.end}; the last state is {n_actions}")
            before = n_actions if known.end is None else known.end
            checks.check_length(known.actions, before, [*at, "actions"], "states before the end")
            names.check_actions([*chain.from_iterable(known.actions)], [*at, "actions"])
        case wire.KnownActions(), wire.AskLabelFull():
            n_actions = checks.n_actions_of(ask.segments)
            checks.check_length(known.actions, n_actions, [*at, "actions"], "actions")
            names.check_actions([*chain.from_iterable(known.actions)], [*at, "actions"])


def solved(known: wire.Known) -> list[wire.Mark]:
    """Return the labels of a right answer, each marked as right."""
    right = _right(known)
    return _marks([choices[0] for choices in right], right)


def _right(known: wire.Known) -> Sequence[Sequence[str]]:
    match known:
        case wire.KnownVerdict():
            return [[known.verdict]]
        case wire.KnownSubgoals():
            return known.subgoals
        case wire.KnownSegment():
            return [*known.actions, [NOT_DONE if known.end is None else DONE]]
        case wire.KnownActions():
            return known.actions


def labels(answer: wire.Answer) -> list[str | None]:
    """Return the single labels of an answer, one per state or segment; None for a state after the segment's end.

    A demonstration has none, because two demonstrations are not about the same states.
    """
    match answer:
        case wire.InspectAnswer():
            return [answer.verdict]
        case wire.LabelHiAnswer():
            return [*answer.subgoals]
        case wire.LabelLoAnswer():
            return _of_states(answer)
        case wire.LabelFullAnswer():
            return [*answer.actions]
        case wire.HierDemoAnswer():
            return []
        case _:
            assert_never(answer)


def differences(answer: wire.Answer, policy: wire.Answer) -> list[wire.Difference]:
    """Return where what the learner's policies would answer to a query differs from its answer."""
    both = zip_longest(labels(answer), labels(policy))
    return [wire.Difference(place=at, answer=one, policy=now) for at, (one, now) in enumerate(both) if one != now]


def differ(one: wire.Answer | None, other: wire.Answer) -> bool | None:
    """Return whether two answers to a query differ in a label; None if they cannot be compared."""
    if one is None or one.kind == "hier_demo":
        return None
    return labels(one) != labels(other)


def marks(known: wire.Known, answer: wire.Answer) -> list[wire.Mark]:
    """Compare each label of an answer with the known answer. The answer must fit the query."""
    if known.kind != answer.kind:
        raise TypeError(f"{answer.kind} answers no {known.kind}")
    right = _right(known)
    return _marks(labels(answer)[: len(right)], right)


def _end(answer: wire.LabelLoAnswer) -> int | None:
    return answer.terminations.index(True) if True in answer.terminations else None


def _of_states(answer: wire.LabelLoAnswer) -> list[str | None]:
    """Return each state's label: its action, `DONE` where the segment should end, None after that."""
    end = _end(answer)
    if end is None:
        return [*answer.actions, NOT_DONE]
    after: list[str | None] = [None] * (len(answer.actions) - end)
    return [*answer.actions[:end], DONE, *after]


def _marks(given: Sequence[str | None], right: Sequence[Sequence[str]]) -> list[wire.Mark]:
    return [
        wire.Mark(place=place, given=label, right=list(choices), is_right=label in choices)
        for place, (label, choices) in enumerate(zip(given, right, strict=True))
    ]
