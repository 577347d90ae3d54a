"""Answers: what an annotator returns."""

from typing import Annotated, Literal

from pydantic import Field

from waypost.wire.words import Message, Name, Verdict

__all__ = [
    "Answer",
    "DemoSegment",
    "HierDemoAnswer",
    "InspectAnswer",
    "LabelFullAnswer",
    "LabelHiAnswer",
    "LabelLoAnswer",
]


class DemoSegment(Message):
    """One segment of a demonstration; its states follow from the actions."""

    subgoal: Name | None = Field(description="The subgoal carried out; null in a flat demonstration.")
    actions: list[Name] = Field(min_length=1, max_length=10_000)


class HierDemoAnswer(Message):
    """The expert's own trajectory: hierarchical, each segment ending where its subgoal is reached; or one flat one."""

    kind: Literal["hier_demo"]
    segments: list[DemoSegment] = Field(min_length=1, max_length=10_000)


class InspectAnswer(Message):
    """Pass or Fail, for Inspect_FULL and Inspect_LO."""

    kind: Literal["inspect_full", "inspect_lo"]
    verdict: Verdict


class LabelHiAnswer(Message):
    """g*_1 .. g*_n: a good subgoal for each segment of the query."""

    kind: Literal["label_hi"]
    subgoals: list[Name] = Field(max_length=10_000)


class LabelLoAnswer(Message):
    """a*_1 .. a*_H and omega*_1 .. omega*_{H+1} of one segment with H actions.

    Labels count up to the first true termination. An action may be null only there and after it: the segment should
    have ended, so no action toward the subgoal is good.
    """

    kind: Literal["label_lo"]
    actions: list[Name | None] = Field(max_length=10_000)
    terminations: list[bool] = Field(max_length=10_001)


class LabelFullAnswer(Message):
    """a*_1 .. a*_H over the joined segments."""

    kind: Literal["label_full"]
    actions: list[Name] = Field(max_length=100_000)


Answer = Annotated[
    HierDemoAnswer | InspectAnswer | LabelHiAnswer | LabelLoAnswer | LabelFullAnswer,
    Field(discriminator="kind"),
]
