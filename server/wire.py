"""Every message that crosses HTTP, and nothing else: pydantic and the standard library only.

The server and the learner's client both import this module, and the page's TypeScript types are generated from it
(through the OpenAPI document), so there is one contract. Words are the paper's: a *segment* is one (s_h, g_h, tau_h),
a subgoal and the LO-level trajectory that carried it out (Le et al. 2018, section 3).

Subgoals and actions travel by name (a run declares both lists); states and instances travel as the domain's own JSON
view, which the server stores without looking inside. Times are seconds since the epoch; costs are units (the price
of one label, unless the run sets others).
"""

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, JsonValue

Kind = Literal["hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full"]
Verdict = Literal["pass", "fail"]
RunState = Literal["running", "paused", "finished"]
QueryState = Literal["open", "leased", "answered", "cancelled"]
Role = Literal["admin", "learner", "annotator", "viewer"]

Name = Annotated[str, Field(min_length=1, max_length=100)]
Units = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]


class Message(BaseModel):
    """What all messages share: unknown fields and lax conversions (`"3"` for 3) are refused."""

    model_config = ConfigDict(extra="forbid", strict=True)


# --- queries: what the learner asks ------------------------------------------------------------------------------


class Segment(Message):
    """One (s_h, g_h, tau_h) of the learner's hierarchical trajectory."""

    subgoal: Name | None = Field(description="The subgoal the learner pursued; null for a flat policy.")
    states: list[JsonValue] = Field(max_length=10_000, description="s_1 .. s_{H+1}, in the domain's JSON view.")
    actions: list[Name] = Field(max_length=10_000, description="a_1 .. a_H, one fewer than the states.")


class AskBase(Message):
    """What every query carries, whatever its kind."""

    episode: int = Field(ge=0, le=2**31 - 1, description="Which episode of the run asks.")
    ordinal: int = Field(ge=0, le=2**31 - 1, description="Which query of that episode this is, from 0.")
    question: str = Field(max_length=500, description="The question in words, for a person.")
    instance: JsonValue = Field(description="The environment instance, in the domain's JSON view.")
    context: list[Segment] = Field(
        default_factory=list, max_length=1_000, description="Segments that came before, shown but not asked about."
    )


class AskHierDemo(AskBase):
    """HierDemo(s): carry out the task from state s and return the hierarchical trajectory."""

    kind: Literal["hier_demo"]
    state: JsonValue = Field(description="s, where the demonstration starts.")
    max_segments: int = Field(ge=1, le=10_000, description="H_HI: a demonstration has at most so many segments.")
    max_actions: int = Field(ge=1, le=10_000, description="H_FULL: and at most so many actions in all.")


class AskInspectFull(AskBase):
    """Inspect_FULL(tau_FULL): was the overall goal accomplished?"""

    kind: Literal["inspect_full"]
    segments: list[Segment] = Field(min_length=1, max_length=1_000)


class AskLabelHi(AskBase):
    """Label_HI(tau_HI): a good subgoal at the first state of each segment."""

    kind: Literal["label_hi"]
    segments: list[Segment] = Field(min_length=1, max_length=1_000)


class AskInspectLo(AskBase):
    """Inspect_LO(tau; g): did this one segment accomplish its subgoal?"""

    kind: Literal["inspect_lo"]
    segments: list[Segment] = Field(min_length=1, max_length=1)


class AskLabelLo(AskBase):
    """Label_LO(tau; g): a good action at each state of this one segment, and where it should have ended."""

    kind: Literal["label_lo"]
    segments: list[Segment] = Field(min_length=1, max_length=1)


class AskLabelFull(AskBase):
    """Label_FULL(tau_FULL): a good action at each state of the full trajectory."""

    kind: Literal["label_full"]
    segments: list[Segment] = Field(min_length=1, max_length=1_000)


Ask = Annotated[
    AskHierDemo | AskInspectFull | AskLabelHi | AskInspectLo | AskLabelLo | AskLabelFull,
    Field(discriminator="kind"),
]


# --- answers: what an annotator returns ----------------------------------------------------------------------------


class DemoSegment(Message):
    """One segment of a demonstration; its states follow from the actions."""

    subgoal: Name
    actions: list[Name] = Field(min_length=1, max_length=10_000)


class HierDemoAnswer(Message):
    """The expert's own hierarchical trajectory; each segment ends where its subgoal is reached."""

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


class Query(Message):
    """A query as everybody sees it: what was asked, where it stands, and its answer once it has one."""

    id: int
    run: str
    state: QueryState
    priority: int
    created_at: float
    ask: Ask
    answer: Answer | None
    answer_id: int | None
    used: bool = Field(description="Whether the learner has used the answer; then it can be retracted no more.")
    annotator: str | None = Field(description="Who answered, or who holds it now.")
    units: float | None = Field(description="What the answer cost.")
    seconds: float | None = Field(description="From lease to answer, by the server's clock.")
