"""Defines the answers that annotators send, one class for each kind of answer."""

from typing import Annotated, Literal

from pydantic import Field

from waypost.wire.frames import Pictured
from waypost.wire.words import Json, Message, Name, Verdict

__all__ = [
    "Answer",
    "DemoReplay",
    "DemoSegment",
    "HierDemoAnswer",
    "InspectAnswer",
    "LabelFullAnswer",
    "LabelHiAnswer",
    "LabelLoAnswer",
]


class DemoSegment(Message):
    """One segment of a demonstration. The learner computes its states from the actions."""

    subgoal: Name | None = Field(description="The subgoal of the segment; null in a flat demonstration.")
    actions: list[Name] = Field(min_length=1, max_length=10_000, description="a_1 .. a_H.")


class DemoReplay(Pictured):
    """What an annotator saw of a demonstration, for those who look at it later. The learner does not use it."""

    states: list[Json] = Field(
        max_length=10_001, description="One JSON view of the domain per state, from the start to the last action."
    )


class HierDemoAnswer(Message):
    """The expert's own trajectory: segments that each end where the subgoal is reached, or one flat segment."""

    kind: Literal["hier_demo"]
    segments: list[DemoSegment] = Field(min_length=1, max_length=10_000, description="The segments in order.")
    replay: DemoReplay | None = Field(
        default=None, description="What the annotator saw, if the web app cannot compute it from the actions."
    )


class InspectAnswer(Message):
    """Pass or Fail, the answer to Inspect_FULL and Inspect_LO."""

    kind: Literal["inspect_full", "inspect_lo"]
    verdict: Verdict = Field(description="Whether the task (the subgoal) was accomplished.")


class LabelHiAnswer(Message):
    """g*_1 .. g*_n: a good subgoal for each segment of the query."""

    kind: Literal["label_hi"]
    subgoals: list[Name] = Field(max_length=10_000, description="One good subgoal per segment.")


class LabelLoAnswer(Message):
    """a*_1 .. a*_H and omega*_1 .. omega*_{H+1} of one segment with H actions.

    The learner uses the labels up to the first true termination. From the state of that termination on, an action may
    be null, because no action toward the subgoal is good after the subgoal is reached.
    """

    kind: Literal["label_lo"]
    actions: list[Name | None] = Field(max_length=10_000, description="A good action for each state but the last.")
    terminations: list[bool] = Field(max_length=10_001, description="For each state, whether the segment should end.")


class LabelFullAnswer(Message):
    """a*_1 .. a*_H: a good action for each state of the full trajectory."""

    kind: Literal["label_full"]
    actions: list[Name] = Field(max_length=100_000, description="The actions of all segments, joined.")


Answer = Annotated[
    HierDemoAnswer | InspectAnswer | LabelHiAnswer | LabelLoAnswer | LabelFullAnswer,
    Field(discriminator="kind"),
]
