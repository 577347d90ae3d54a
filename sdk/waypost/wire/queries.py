"""Queries: what the learner asks."""

from typing import Annotated, Literal

from pydantic import Field, JsonValue

from waypost.wire.answers import Answer
from waypost.wire.words import FrameHash, Message, Name, QueryState

__all__ = [
    "AnswerPage",
    "Ask",
    "AskBase",
    "AskHierDemo",
    "AskInspectFull",
    "AskInspectLo",
    "AskLabelFull",
    "AskLabelHi",
    "AskLabelLo",
    "AskList",
    "Asked",
    "Query",
    "QueryList",
    "Segment",
]


class Segment(Message):
    """One (s_h, g_h, tau_h) of the learner's hierarchical trajectory."""

    subgoal: Name | None = Field(description="The subgoal the learner pursued; null for a flat policy.")
    states: list[JsonValue] = Field(max_length=10_000, description="s_1 .. s_{H+1}, in the domain's JSON view.")
    actions: list[Name] = Field(max_length=10_000, description="a_1 .. a_H, one fewer than the states.")
    frames: list[FrameHash] = Field(
        default_factory=list,
        max_length=10_000,
        description="A picture of each state, uploaded before; none where the page draws the states itself. Pictures "
        "are not part of what is asked: asking again with others changes nothing.",
    )


class AskBase(Message):
    """What every query carries, whatever its kind."""

    episode: int = Field(ge=0, le=2**31 - 1, description="Which episode of the run asks.")
    ordinal: int = Field(ge=0, le=2**31 - 1, description="Which query of that episode this is, from 0.")
    question: str = Field(max_length=500, description="The question in words, for a person.")
    instance: JsonValue = Field(description="The environment instance, in the domain's JSON view.")
    context: list[Segment] = Field(
        default_factory=list, max_length=1_000, description="Segments that came before, shown but not asked about."
    )
    suggestion: Answer | None = Field(
        default=None,
        description="The learner's own choice, as an answer to this query; what it did, not what is right.",
    )


class AskHierDemo(AskBase):
    """HierDemo(s): carry out the task from state s and return the hierarchical trajectory, or a flat learner's."""

    kind: Literal["hier_demo"]
    state: JsonValue = Field(description="s, where the demonstration starts.")
    flat: bool = Field(default=False, description="Only actions are wanted: one segment without a subgoal.")
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
    active_seconds: float | None = Field(description="The annotator's own time for it, without idle time.")


class Asked(Message):
    """The reply to `POST /runs/{id}/queries`: the queries in the order asked, old ones with their answers."""

    queries: list[Query]


class AskList(Message):
    """One or more queries of one run. Asking again with the same (episode, ordinal) and content changes nothing."""

    queries: list[Ask] = Field(min_length=1, max_length=1_000)
    priority: int = Field(default=0, ge=-1_000, le=1_000, description="Higher is handed out first.")


class QueryList(Message):
    """Queries of a run, newest first; `before` the last one's id goes on."""

    queries: list[Query]


class AnswerPage(Message):
    """Answers in the order they were given, after a cursor; `cursor` is where to go on."""

    queries: list[Query]
    cursor: int
