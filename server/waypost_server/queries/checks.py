"""Checks by kind of query: what a query must contain, and what an answer to it must contain."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from pydantic import BaseModel, ConfigDict

from waypost import wire
from waypost_server.errors import Location, Unprocessable


@dataclass(frozen=True)
class Names:
    """The subgoals and actions of a run, by name."""

    subgoals: frozenset[str]
    actions: frozenset[str]

    @classmethod
    def of(cls, vocabulary: wire.Vocabulary) -> "Names":
        """Return the names of a vocabulary."""
        return cls(frozenset(vocabulary.subgoals), frozenset(vocabulary.actions))

    def check_subgoal(self, name: str, at: Location) -> None:
        """Refuse a name that is not a subgoal of the run."""
        if name not in self.subgoals:
            raise Unprocessable(at, f"{name!r} is not a subgoal of this run")

    def check_action(self, name: str, at: Location) -> None:
        """Refuse a name that is not an action of the run."""
        if name not in self.actions:
            raise Unprocessable(at, f"{name!r} is not an action of this run")

    def check_actions(self, names: Sequence[str | None], at: Location) -> None:
        """Refuse the first name that is not an action of the run."""
        for place, name in enumerate(names):
            if name is not None:
                self.check_action(name, [*at, place])


class _Acted(Protocol):
    """A part of a trajectory."""

    @property
    def actions(self) -> Sequence[Any]:
        """Its actions, in order."""


class _Actions(BaseModel):
    """The actions of a segment."""

    model_config = ConfigDict(from_attributes=True)

    actions: list[Any]


class Outline(BaseModel):
    """What of a query decides whether an answer fits it. A stored query is read in half the time without the rest."""

    model_config = ConfigDict(from_attributes=True)

    kind: wire.Kind
    segments: list[_Actions] = []
    flat: bool = False
    max_segments: int = 0
    max_actions: int = 0
    suggestion: wire.Answer | None

    @classmethod
    def of(cls, ask: wire.Ask) -> "Outline":
        """Return the outline of a query that was read as a whole."""
        return cls.model_validate(ask)


def check_ask(ask: wire.Ask, names: Names, at: Location) -> None:
    """Refuse a query that is not valid in its run.

    Raises:
        Unprocessable: naming the field below `at`.
    """
    if isinstance(ask, wire.AskHierDemo):
        if not names.subgoals and not ask.flat:
            raise Unprocessable([*at, "kind"], "a run without subgoals cannot ask for a hierarchical demonstration")
    else:
        for place, segment in enumerate(ask.segments):
            _check_segment(segment, names, [*at, "segments", place])
    if isinstance(ask, wire.AskLabelHi) and not names.subgoals:
        raise Unprocessable([*at, "kind"], "a run without subgoals cannot ask for subgoals")
    if isinstance(ask, wire.AskInspectLo | wire.AskLabelLo) and ask.segments[0].subgoal is None:
        raise Unprocessable([*at, "segments", 0, "subgoal"], "is null; this kind of query asks about a subgoal")
    for place, segment in enumerate(ask.context):
        _check_segment(segment, names, [*at, "context", place])
    if ask.suggestion is not None:
        check_answer(Outline.of(ask), ask.suggestion, names, [*at, "suggestion"])


def check_answer(ask: Outline, answer: wire.Answer, names: Names, at: Location) -> None:
    """Refuse an answer that does not fit its query.

    Raises:
        Unprocessable: naming the field below `at`.
    """
    if answer.kind != ask.kind:
        raise Unprocessable([*at, "kind"], f"is {answer.kind}; the query is {ask.kind}")
    match answer:
        case wire.HierDemoAnswer():
            _check_demonstration(ask, answer, names, at)
        case wire.LabelHiAnswer():
            check_length(answer.subgoals, len(ask.segments), [*at, "subgoals"], "segments")
            for place, name in enumerate(answer.subgoals):
                names.check_subgoal(name, [*at, "subgoals", place])
        case wire.LabelLoAnswer():
            _check_lo_labels(ask, answer, names, at)
        case wire.LabelFullAnswer():
            check_length(answer.actions, n_actions_of(ask.segments), [*at, "actions"], "actions")
            names.check_actions(answer.actions, [*at, "actions"])


def check_length(values: Sequence[Any], expected: int, at: Location, unit: str) -> None:
    """Refuse a list that is not as long as the query requires."""
    if len(values) != expected:
        raise Unprocessable(at, f"has {len(values)} entries; the query has {expected} {unit}")


def n_actions_of(segments: Sequence[_Acted]) -> int:
    """Return the length of the full trajectory."""
    return sum(len(segment.actions) for segment in segments)


def _check_segment(segment: wire.Segment, names: Names, at: Location) -> None:
    n_states, n_actions = len(segment.states), len(segment.actions)
    if n_states != n_actions + 1:
        raise Unprocessable(
            [*at, "states"], f"has {n_states} states for {n_actions} actions; send one more state than actions"
        )
    if segment.frames and len(segment.frames) != n_states:
        raise Unprocessable(
            [*at, "frames"],
            f"has {len(segment.frames)} frames for {n_states} states; send one frame per state, or none",
        )
    _check_landmarks(segment, n_states, names, at)
    names.check_actions(segment.actions, [*at, "actions"])
    if segment.subgoal is not None:
        names.check_subgoal(segment.subgoal, [*at, "subgoal"])


def _check_landmarks(shown: wire.Pictured, n_states: int, names: Names, at: Location) -> None:
    for field, landmarks in (("landmarks", shown.landmarks), ("action_landmarks", shown.action_landmarks)):
        if len(landmarks) not in (0, 1, n_states):
            raise Unprocessable(
                [*at, field],
                f"has {len(landmarks)} entries for {n_states} states; send one per state, one for all, or none",
            )
    for place, boxes in enumerate(shown.landmarks):
        for name in boxes:
            names.check_subgoal(name, [*at, "landmarks", place])
    for place, boxes in enumerate(shown.action_landmarks):
        for name in boxes:
            names.check_action(name, [*at, "action_landmarks", place])


def _check_demonstration(ask: Outline, answer: wire.HierDemoAnswer, names: Names, at: Location) -> None:
    """Refuse more than H_HI segments or H_FULL actions. A flat demonstration is one segment without a subgoal."""
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
            names.check_subgoal(segment.subgoal, name_at)
        names.check_actions(segment.actions, [*at, "segments", place, "actions"])
    if answer.replay is not None:
        _check_length_or_none(answer.replay.states, total + 1, [*at, "replay", "states"])
        _check_length_or_none(answer.replay.frames, total + 1, [*at, "replay", "frames"])
        _check_landmarks(answer.replay, total + 1, names, [*at, "replay"])


def _check_length_or_none(given: Sequence[object], length: int, at: Location) -> None:
    """Refuse a list that is neither empty nor as long as it must be."""
    if given and len(given) != length:
        raise Unprocessable(at, f"has {len(given)} entries; {length} fit: one per state")


def _check_lo_labels(ask: Outline, answer: wire.LabelLoAnswer, names: Names, at: Location) -> None:
    """Require H actions and H + 1 terminations. An action may be null only where the segment should have ended."""
    n_actions = len(ask.segments[0].actions)
    check_length(answer.actions, n_actions, [*at, "actions"], "actions")
    check_length(answer.terminations, n_actions + 1, [*at, "terminations"], "states")
    names.check_actions(answer.actions, [*at, "actions"])
    end = answer.terminations.index(True) if True in answer.terminations else n_actions + 1
    for place, name in enumerate(answer.actions[:end]):
        if name is None:
            raise Unprocessable([*at, "actions", place], "may be null only from the first true termination on")
