"""Defines the six queries of the paper (Le et al. 2018, section 3) in plain Python, for training scripts.

`Run.ask` sends them. A query contains segments with states, names of actions and optional pictures. Each class says
what the answer to its queries is.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Generic, TypeVar

from waypost import wire
from waypost.runs.pictures import Picture, digest, png

Sides = tuple[float, float, float, float]
"""The left, upper, right and lower side of a box in a picture, as shares of its width and height."""

A = TypeVar("A", covariant=True)
"""The type of the answers to a kind of query."""


@dataclass(frozen=True)
class Segment:
    """A part of an episode: states s_1 .. s_{H+1}, and the actions a_1 .. a_H between them.

    Args:
        states: H + 1 JSON values, such as numbers, lists and dicts. Arrays become lists.
        actions: H names of actions.
        subgoal: the name of the subgoal that the actions were to reach; None if the policy has no subgoals.
        pictures: H + 1 pictures of the states, or none; PNG files in bytes, or arrays uint8[rows, columns, 3].
        landmarks: where subgoals are in the pictures: for each state, or once for all states, boxes by subgoal. A box
            is its left, upper, right and lower side, as shares of the picture's width and height, 0 to 1.
        action_landmarks: where actions lead in the pictures: boxes by action, in the same form.

    Raises:
        ValueError: there is not one state more than actions, or not one picture per state, or landmarks do not fit.
    """

    states: Sequence[Any]
    actions: Sequence[str]
    subgoal: str | None = None
    pictures: Sequence[Picture] = ()
    landmarks: Sequence[Mapping[str, Sides]] = ()
    action_landmarks: Sequence[Mapping[str, Sides]] = ()

    def __post_init__(self) -> None:
        n_states, n_actions, n_pictures = len(self.states), len(self.actions), len(self.pictures)
        if n_states != n_actions + 1:
            raise ValueError(
                f"the segment has {n_states} states and {n_actions} actions; give one state more than actions, "
                "because the last action leads to a last state"
            )
        if n_pictures not in (0, n_states):
            raise ValueError(
                f"the segment has {n_pictures} pictures and {n_states} states; give one picture per state, or none"
            )
        for name, landmarks in (("landmarks", self.landmarks), ("action_landmarks", self.action_landmarks)):
            if len(landmarks) not in ((0, 1, n_states) if n_pictures else (0,)):
                raise ValueError(
                    f"the segment has {name} {len(landmarks)} times, {n_states} states and {n_pictures} pictures; "
                    f"give {name} with pictures only, and then for each state, or once for all"
                )
            for choice, (left, top, right, bottom) in (item for one in landmarks for item in one.items()):
                if not (0 <= left < right <= 1 and 0 <= top < bottom <= 1):
                    raise ValueError(
                        f"the box of {choice!r} is {(left, top, right, bottom)}; give its left, upper, right and lower "
                        "side, as shares of the picture's width and height, 0 to 1"
                    )

    @cached_property
    def message(self) -> wire.Segment:
        """The segment as a message."""
        return wire.Segment(
            subgoal=self.subgoal,
            states=_json(self.states),
            actions=list(self.actions),
            frames=[digest(file) for file in self._files],
            landmarks=_boxes(self.landmarks),
            action_landmarks=_boxes(self.action_landmarks),
        )

    @property
    def frames(self) -> Mapping[str, bytes]:
        """The pictures as PNG files by their SHA-256.

        Raises:
            ValueError: a picture is neither a PNG file nor an array of the right type and shape.
        """
        return dict(zip(self.message.frames, self._files, strict=True))

    @cached_property
    def _files(self) -> list[bytes]:
        return [png(picture) for picture in self.pictures]


@dataclass(frozen=True, kw_only=True)
class Query(ABC, Generic[A]):
    """A question to the expert; the base class of the six kinds.

    Args:
        episode: the number of the episode, from 0. Equal questions about the same episode are one query.
        instance: the instance of the environment as a JSON value, such as its map and goal.
        context: earlier segments of the episode. Annotators see them, but the query does not ask about them.
        question: the question in words, for people; a suitable text if it is None.
    """

    episode: int
    instance: Any = None
    context: Sequence[Segment] = ()
    question: str | None = None

    @property
    def asked(self) -> Sequence[Segment]:
        """The segments that the query asks about."""
        return ()

    def frames(self) -> Mapping[str, bytes]:
        """Return all pictures of the query, as PNG files by their SHA-256."""
        return {name: file for segment in (*self.context, *self.asked) for name, file in segment.frames.items()}

    @abstractmethod
    def message(self, ordinal: int) -> wire.Ask:
        """Return the query as a message. `ordinal` is the number of the query in its episode."""

    def _common(self, ordinal: int, question: str) -> dict[str, Any]:
        common = {
            "episode": self.episode,
            "ordinal": ordinal,
            "question": question if self.question is None else self.question,
            "instance": _json(self.instance),
            "context": [segment.message for segment in self.context],
        }
        return common if not self.asked else common | {"segments": [segment.message for segment in self.asked]}


@dataclass(frozen=True)
class HierDemo(Query[tuple[wire.DemoSegment, ...]]):
    """Carry out the task from a state. The answer is a tuple of segments, each with its `subgoal` and `actions`.

    With a `context`, the expert takes over: its last segment failed, and the expert plays on from there.

    Args:
        state: the first state of the demonstration, as a JSON value. It is the last state of the context, if any.
        max_segments: H_HI, the largest number of segments.
        max_actions: H_FULL, the largest number of actions in all segments.
        flat: whether to ask for actions only: the answer is then one segment whose subgoal is None.
    """

    state: Any
    max_segments: int
    max_actions: int
    flat: bool = False

    def message(self, ordinal: int) -> wire.AskHierDemo:
        """Return the query as a message.

        Raises:
            ValueError: the context ends in another state.
        """
        if self.context and _json(self.context[-1].states[-1]) != _json(self.state):
            raise ValueError("the demonstration begins in another state than its context ends in; give the same state")
        return wire.AskHierDemo(
            kind="hier_demo",
            state=_json(self.state),
            max_segments=self.max_segments,
            max_actions=self.max_actions,
            flat=self.flat,
            **self._common(ordinal, self._words()),
        )

    def _words(self) -> str:
        if not self.context:
            return "Do the whole task yourself."
        return "Play on from here." if self.flat or self.max_segments > 1 else "Play on until a subgoal is reached."


@dataclass(frozen=True)
class InspectFull(Query[bool]):
    """Did the episode accomplish the whole task? The answer is True for pass and False for fail.

    Args:
        segments: the segments of the episode, in order.
    """

    segments: Sequence[Segment]

    @property
    def asked(self) -> Sequence[Segment]:
        """The segments of the episode."""
        return self.segments

    def message(self, ordinal: int) -> wire.AskInspectFull:
        """Return the query as a message."""
        return wire.AskInspectFull(kind="inspect_full", **self._common(ordinal, "Did it do the whole task?"))


@dataclass(frozen=True)
class LabelHi(Query[tuple[str, ...]]):
    """Which subgoal was right at the start of each segment? The answer has one subgoal per segment.

    Args:
        segments: the segments to label, in order.
    """

    segments: Sequence[Segment]

    @property
    def asked(self) -> Sequence[Segment]:
        """The segments to label."""
        return self.segments

    def message(self, ordinal: int) -> wire.AskLabelHi:
        """Return the query as a message, with the learner's own subgoals as the suggestion if there are any."""
        own = [segment.subgoal for segment in self.segments if segment.subgoal is not None]
        suggestion = wire.LabelHiAnswer(kind="label_hi", subgoals=own) if len(own) == len(self.segments) else None
        return wire.AskLabelHi(
            kind="label_hi",
            suggestion=suggestion,
            **self._common(ordinal, "Which subgoal should it have chosen for each segment?"),
        )


@dataclass(frozen=True)
class InspectLo(Query[bool]):
    """Did this segment accomplish its subgoal? The answer is True for pass and False for fail.

    Args:
        segment: the segment to inspect, with its subgoal.
    """

    segment: Segment

    @property
    def asked(self) -> Sequence[Segment]:
        """The segment to inspect."""
        return (self.segment,)

    def message(self, ordinal: int) -> wire.AskInspectLo:
        """Return the query as a message."""
        return wire.AskInspectLo(
            kind="inspect_lo",
            **self._common(ordinal, f"It tried “{self.segment.subgoal}”. Did that work?"),
        )


@dataclass(frozen=True)
class LabelLo(Query[wire.LabelLoAnswer]):
    """Which action was right in each state of this segment, and in which state should the segment have ended?

    The answer has `actions` and `terminations`: H actions, and H + 1 booleans that say in which states the segment
    should end. Use the labels up to the first true termination. From there on, an action may be None.

    Args:
        segment: the segment to label, with its subgoal.
        terminated: whether the learner ended the segment itself in the last state. Annotators see this as its choice.
    """

    segment: Segment
    terminated: bool = True

    @property
    def asked(self) -> Sequence[Segment]:
        """The segment to label."""
        return (self.segment,)

    def message(self, ordinal: int) -> wire.AskLabelLo:
        """Return the query as a message, with the learner's own choices as the suggestion."""
        actions = self.segment.actions
        return wire.AskLabelLo(
            kind="label_lo",
            suggestion=wire.LabelLoAnswer(
                kind="label_lo", actions=list(actions), terminations=[*(False for _ in actions), self.terminated]
            ),
            **self._common(ordinal, f"It tried “{self.segment.subgoal}”. What should it have done at each step?"),
        )


@dataclass(frozen=True)
class LabelFull(Query[tuple[str, ...]]):
    """Which action was right in each state of the episode? The answer has one action per action of all segments.

    Args:
        segments: the segments of the episode, in order.
    """

    segments: Sequence[Segment]

    @property
    def asked(self) -> Sequence[Segment]:
        """The segments of the episode."""
        return self.segments

    def message(self, ordinal: int) -> wire.AskLabelFull:
        """Return the query as a message, with the learner's own actions as the suggestion."""
        return wire.AskLabelFull(
            kind="label_full",
            suggestion=wire.LabelFullAnswer(
                kind="label_full", actions=[action for segment in self.segments for action in segment.actions]
            ),
            **self._common(ordinal, "What should it have done at each step?"),
        )


def plain(answer: wire.Answer) -> Any:
    """Return an answer in the type that the class of its query names."""
    match answer:
        case wire.HierDemoAnswer():
            return tuple(answer.segments)
        case wire.InspectAnswer():
            return answer.verdict == "pass"
        case wire.LabelHiAnswer():
            return tuple(answer.subgoals)
        case wire.LabelLoAnswer():
            return answer
        case wire.LabelFullAnswer():
            return tuple(answer.actions)


def check_names(query: Query[Any], vocabulary: wire.Vocabulary) -> None:
    """Refuse a subgoal or an action that the run does not declare.

    Raises:
        ValueError: the message says which name, and lists the declared ones.
    """
    for segment in (*query.context, *query.asked):
        chosen = () if segment.subgoal is None else (segment.subgoal,)
        subgoals = (*chosen, *(name for one in segment.landmarks for name in one))
        actions = (*segment.actions, *(name for one in segment.action_landmarks for name in one))
        for what, names, declared in (
            ("subgoal", subgoals, vocabulary.subgoals),
            ("action", actions, vocabulary.actions),
        ):
            for name in names:
                if name not in declared:
                    known = ", ".join(declared) or "none"
                    raise ValueError(f"the run has no {what} {name!r}; the names that it declares are: {known}")
    if isinstance(query, InspectLo | LabelLo) and query.segment.subgoal is None:
        raise ValueError(f"a segment in {type(query).__name__} needs a subgoal, because the question is about it")


def _boxes(landmarks: Sequence[Mapping[str, Sides]]) -> wire.Landmarks:
    return [{name: _box(*sides) for name, sides in one.items()} for one in landmarks]


def _box(left: float, top: float, right: float, bottom: float) -> wire.Box:
    return wire.Box(left=left, top=top, right=right, bottom=bottom)


def _json(value: Any) -> Any:
    """Return a value in plain JSON types. Arrays and tuples become lists.

    Raises:
        ValueError: JSON cannot express it.
    """
    if hasattr(value, "tolist"):  # arrays, their numbers, and tensors
        value = value.tolist()
    if isinstance(value, Mapping) and all(isinstance(key, str) for key in value):
        return {key: _json(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_json(one) for one in value]
    if isinstance(value, str | int | None) or (isinstance(value, float) and math.isfinite(value)):
        return value
    raise ValueError(
        f"{value!r} cannot be sent as JSON; use finite numbers, texts, lists, and dicts with texts as keys"
    )
