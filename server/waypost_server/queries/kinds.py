"""The kinds of query. Each is defined here, once: what it needs, what answers it, what the answer costs.

The prices are the run's (`wire.Prices`); the paper's are one unit per label and one per inspection.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from waypost import wire
from waypost_server.errors import Location, Unprocessable
from waypost_server.runs.ledger import Cost, to_micro

AskT = TypeVar("AskT")
AnswerT = TypeVar("AnswerT")


@dataclass(frozen=True)
class Words:
    """A run's vocabulary, ready to look names up in."""

    subgoals: frozenset[str]
    actions: frozenset[str]

    @classmethod
    def of(cls, vocabulary: wire.Vocabulary) -> "Words":
        """Return the names of a vocabulary."""
        return cls(frozenset(vocabulary.subgoals), frozenset(vocabulary.actions))

    def check_subgoal(self, name: str, at: Location) -> None:
        """Refuse a name that is no subgoal of the run."""
        if name not in self.subgoals:
            raise Unprocessable(at, f"{name!r} is no subgoal of this run")

    def check_actions(self, names: Sequence[str | None], at: Location) -> None:
        """Refuse the first name that is no action of the run."""
        for place, name in enumerate(names):
            if name is not None and name not in self.actions:
                raise Unprocessable([*at, place], f"{name!r} is no action of this run")


def check_length(values: Sequence[Any], expected: int, at: Location, what: str) -> None:
    """Refuse a list of another length than the query's."""
    if len(values) != expected:
        raise Unprocessable(at, f"has {len(values)} entries; the query has {expected} {what}")


def check_segment(segment: wire.Segment, words: Words, at: Location) -> None:
    """Refuse a segment whose states and actions do not fit, or whose names the run does not have."""
    if len(segment.states) != len(segment.actions) + 1:
        raise Unprocessable(
            [*at, "states"], f"has {len(segment.states)} states; {len(segment.actions)} actions make one more"
        )
    if segment.frames and len(segment.frames) != len(segment.states):
        raise Unprocessable(
            [*at, "frames"], f"has {len(segment.frames)} frames; each of {len(segment.states)} states has one, or none"
        )
    words.check_actions(segment.actions, [*at, "actions"])
    if segment.subgoal is not None:
        words.check_subgoal(segment.subgoal, [*at, "subgoal"])


class QueryKind(ABC, Generic[AskT, AnswerT]):
    """What a query of one kind needs, what answers it, and what the answer costs."""

    def check_ask(self, ask: Any, words: Words, at: Location) -> None:
        """Refuse a query that does not make sense."""
        for place, segment in enumerate(ask.segments):
            check_segment(segment, words, [*at, "segments", place])

    @abstractmethod
    def check_answer(self, ask: AskT, answer: AnswerT, words: Words, at: Location) -> None:
        """Refuse an answer that does not fit its query."""

    @abstractmethod
    def cost(self, answer: AnswerT, prices: wire.Prices) -> Cost:
        """Return what an answer costs."""

    @abstractmethod
    def reserve(self, ask: AskT, prices: wire.Prices) -> int:
        """Return the most an answer can cost."""


class HierDemo(QueryKind[wire.AskHierDemo, wire.HierDemoAnswer]):
    """Costs the labels the demonstration yields: HI and LO ones, or a flat one's actions alone."""

    def check_ask(self, ask: Any, words: Words, at: Location) -> None:
        """A demonstration names subgoals, unless it is a flat one, so the run must have some."""
        if not words.subgoals and not ask.flat:
            raise Unprocessable([*at, "kind"], "a run without subgoals cannot ask for a hierarchical demonstration")

    def check_answer(self, ask: wire.AskHierDemo, answer: wire.HierDemoAnswer, words: Words, at: Location) -> None:
        """At most H_HI segments and H_FULL actions, in the run's names; a flat one is one segment without a subgoal."""
        if ask.flat and len(answer.segments) != 1:
            raise Unprocessable([*at, "segments"], f"has {len(answer.segments)} segments; a flat demonstration has one")
        if len(answer.segments) > ask.max_segments:
            raise Unprocessable([*at, "segments"], f"has {len(answer.segments)} segments; at most {ask.max_segments}")
        if (total := sum(len(segment.actions) for segment in answer.segments)) > ask.max_actions:
            raise Unprocessable([*at, "segments"], f"has {total} actions in all; at most {ask.max_actions}")
        for place, segment in enumerate(answer.segments):
            name_at = [*at, "segments", place, "subgoal"]
            if ask.flat != (segment.subgoal is None):
                raise Unprocessable(name_at, "must be null in a flat demonstration" if ask.flat else "must not be null")
            if segment.subgoal is not None:
                words.check_subgoal(segment.subgoal, name_at)
            words.check_actions(segment.actions, [*at, "segments", place, "actions"])

    def cost(self, answer: wire.HierDemoAnswer, prices: wire.Prices) -> Cost:
        """Each action; and per segment with a subgoal that subgoal and a termination."""
        n_actions = sum(len(segment.actions) for segment in answer.segments)
        return self._price(sum(segment.subgoal is not None for segment in answer.segments), n_actions, prices)

    def reserve(self, ask: wire.AskHierDemo, prices: wire.Prices) -> int:
        """The longest demonstration there may be; a segment has at least one action."""
        n_segments = 0 if ask.flat else min(ask.max_segments, ask.max_actions)
        return self._price(n_segments, ask.max_actions, prices).units

    def _price(self, n_segments: int, n_actions: int, prices: wire.Prices) -> Cost:
        lo = n_actions * to_micro(prices.action) + n_segments * to_micro(prices.termination)
        return Cost(n_segments * to_micro(prices.subgoal) + lo, lo)


class Inspect(QueryKind[Any, wire.InspectAnswer]):
    """Costs its one price, however long the trajectory."""

    def check_answer(self, ask: Any, answer: wire.InspectAnswer, words: Words, at: Location) -> None:
        """Pass or Fail fits every trajectory."""

    def cost(self, answer: wire.InspectAnswer, prices: wire.Prices) -> Cost:
        """The price of the inspection."""
        return Cost(to_micro(prices.inspect_full if answer.kind == "inspect_full" else prices.inspect_lo))

    def reserve(self, ask: Any, prices: wire.Prices) -> int:
        """The price of the inspection."""
        return to_micro(prices.inspect_full if ask.kind == "inspect_full" else prices.inspect_lo)


class InspectLo(Inspect):
    """Asks about one subgoal, so the segment must name it."""

    def check_ask(self, ask: Any, words: Words, at: Location) -> None:
        """The segment is sound and names its subgoal."""
        super().check_ask(ask, words, at)
        check_has_subgoal(ask.segments[0], at)


class LabelHi(QueryKind[wire.AskLabelHi, wire.LabelHiAnswer]):
    """Costs one subgoal per segment."""

    def check_ask(self, ask: Any, words: Words, at: Location) -> None:
        """The segments are sound, and the run has subgoals to answer with."""
        super().check_ask(ask, words, at)
        if not words.subgoals:
            raise Unprocessable([*at, "kind"], "a run without subgoals cannot ask for subgoals")

    def check_answer(self, ask: wire.AskLabelHi, answer: wire.LabelHiAnswer, words: Words, at: Location) -> None:
        """One subgoal per segment."""
        check_length(answer.subgoals, len(ask.segments), [*at, "subgoals"], "segments")
        for place, name in enumerate(answer.subgoals):
            words.check_subgoal(name, [*at, "subgoals", place])

    def cost(self, answer: wire.LabelHiAnswer, prices: wire.Prices) -> Cost:
        """One subgoal's price per segment."""
        return Cost(len(answer.subgoals) * to_micro(prices.subgoal))

    def reserve(self, ask: wire.AskLabelHi, prices: wire.Prices) -> int:
        """One subgoal's price per segment."""
        return len(ask.segments) * to_micro(prices.subgoal)


class LabelLo(QueryKind[wire.AskLabelLo, wire.LabelLoAnswer]):
    """Costs each state's action and the last state's termination: H + 1."""

    def check_ask(self, ask: Any, words: Words, at: Location) -> None:
        """The segment is sound and names its subgoal."""
        super().check_ask(ask, words, at)
        check_has_subgoal(ask.segments[0], at)

    def check_answer(self, ask: wire.AskLabelLo, answer: wire.LabelLoAnswer, words: Words, at: Location) -> None:
        """H actions and H + 1 terminations; an action may be null only where the segment should have ended."""
        n_actions = len(ask.segments[0].actions)
        check_length(answer.actions, n_actions, [*at, "actions"], "actions")
        check_length(answer.terminations, n_actions + 1, [*at, "terminations"], "states")
        words.check_actions(answer.actions, [*at, "actions"])
        end = answer.terminations.index(True) if True in answer.terminations else n_actions + 1
        for place, name in enumerate(answer.actions[:end]):
            if name is None:
                raise Unprocessable([*at, "actions", place], "may be null only from the first true termination on")

    def cost(self, answer: wire.LabelLoAnswer, prices: wire.Prices) -> Cost:
        """H actions and a termination."""
        return self._price(len(answer.actions), prices)

    def reserve(self, ask: wire.AskLabelLo, prices: wire.Prices) -> int:
        """H actions and a termination."""
        return self._price(len(ask.segments[0].actions), prices).units

    def _price(self, n_actions: int, prices: wire.Prices) -> Cost:
        units = n_actions * to_micro(prices.action) + to_micro(prices.termination)
        return Cost(units, units)


class LabelFull(QueryKind[wire.AskLabelFull, wire.LabelFullAnswer]):
    """Costs each state's action."""

    def check_answer(self, ask: wire.AskLabelFull, answer: wire.LabelFullAnswer, words: Words, at: Location) -> None:
        """One action per action of the joined segments."""
        check_length(answer.actions, n_actions_of(ask.segments), [*at, "actions"], "actions")
        words.check_actions(answer.actions, [*at, "actions"])

    def cost(self, answer: wire.LabelFullAnswer, prices: wire.Prices) -> Cost:
        """One action's price each."""
        units = len(answer.actions) * to_micro(prices.action)
        return Cost(units, units)

    def reserve(self, ask: wire.AskLabelFull, prices: wire.Prices) -> int:
        """One action's price each."""
        return n_actions_of(ask.segments) * to_micro(prices.action)


def n_actions_of(segments: Sequence[wire.Segment]) -> int:
    """Return the length of the full trajectory."""
    return sum(len(segment.actions) for segment in segments)


def check_has_subgoal(segment: wire.Segment, at: Location) -> None:
    """Refuse a question about a subgoal that names none."""
    if segment.subgoal is None:
        raise Unprocessable([*at, "segments", 0, "subgoal"], "is null; this kind of query asks about a subgoal")


KINDS: dict[str, QueryKind[Any, Any]] = {
    "hier_demo": HierDemo(),
    "inspect_full": Inspect(),
    "label_hi": LabelHi(),
    "inspect_lo": InspectLo(),
    "label_lo": LabelLo(),
    "label_full": LabelFull(),
}


def check_ask(ask: wire.Ask, words: Words, at: Location) -> None:
    """Refuse a query that does not make sense in its run, naming the field."""
    KINDS[ask.kind].check_ask(ask, words, at)
    for place, segment in enumerate(ask.context):
        check_segment(segment, words, [*at, "context", place])
    if ask.suggestion is not None:
        check_answer(ask, ask.suggestion, words, [*at, "suggestion"])


def check_answer(ask: wire.Ask, answer: wire.Answer, words: Words, at: Location) -> None:
    """Refuse an answer that does not fit its query, naming the field."""
    if answer.kind != ask.kind:
        raise Unprocessable([*at, "kind"], f"is {answer.kind}; the query is {ask.kind}")
    KINDS[ask.kind].check_answer(ask, answer, words, at)


def cost(answer: wire.Answer, prices: wire.Prices) -> Cost:
    """Return what an answer costs."""
    return KINDS[answer.kind].cost(answer, prices)


def reserve(ask: wire.Ask, prices: wire.Prices) -> int:
    """Return what to hold for a query: the most its answer can cost, in micro-units."""
    return KINDS[ask.kind].reserve(ask, prices)
