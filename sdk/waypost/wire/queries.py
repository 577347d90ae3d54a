"""Defines the queries that learners ask, one class for each kind, and the replies that contain queries."""

from typing import Annotated, Literal

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.frames import Pictured
from waypost.wire.words import Json, Message, Name, QueryState

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


class Segment(Pictured):
    """One segment (s_h, g_h, tau_h) of the learner's trajectory."""

    subgoal: Name | None = Field(description="The learner's subgoal; null for a flat policy.")
    states: list[Json] = Field(max_length=10_000, description="s_1 .. s_{H+1}, as JSON views of the domain.")
    actions: list[Name] = Field(max_length=10_000, description="a_1 .. a_H, one fewer than the states.")


class AskBase(Message):
    """The fields of every kind of query."""

    episode: int = Field(ge=0, le=2**31 - 1, description="The number of the episode in the run, from 0.")
    ordinal: int = Field(ge=0, le=2**31 - 1, description="The number of the query in the episode, from 0.")
    question: str = Field(max_length=500, description="The query in words, for people.")
    instance: Json = Field(description="The environment instance, as a JSON view of the domain.")
    context: list[Segment] = Field(
        default_factory=list,
        max_length=1_000,
        description="Earlier segments, which are shown but not part of the query.",
    )
    suggestion: Answer | None = Field(
        default=None,
        description="The learner's own choices in the form of an answer; they may be wrong.",
    )


class AskHierDemo(AskBase):
    """HierDemo(s): carry out the task from state s, and return the hierarchical trajectory (or a flat one)."""

    kind: Literal["hier_demo"]
    state: Json = Field(description="s, the first state of the demonstration.")
    flat: bool = Field(default=False, description="Whether to return only actions: one segment without a subgoal.")
    max_segments: int = Field(ge=1, le=10_000, description="H_HI, the largest number of segments.")
    max_actions: int = Field(ge=1, le=10_000, description="H_FULL, the largest number of actions in all segments.")


class AskInspectFull(AskBase):
    """Inspect_FULL(tau_FULL): decide whether the episode accomplished the whole task."""

    kind: Literal["inspect_full"]
    segments: list[Segment] = Field(
        min_length=1, max_length=1_000, description="The segments of the episode, in order."
    )


class AskLabelHi(AskBase):
    """Label_HI(tau_HI): choose a good subgoal for the first state of each segment."""

    kind: Literal["label_hi"]
    segments: list[Segment] = Field(min_length=1, max_length=1_000, description="The segments to label, in order.")


class AskInspectLo(AskBase):
    """Inspect_LO(tau; g): decide whether this segment accomplished its subgoal."""

    kind: Literal["inspect_lo"]
    segments: list[Segment] = Field(min_length=1, max_length=1, description="The segment to inspect.")


class AskLabelLo(AskBase):
    """Label_LO(tau; g): choose a good action for each state of this segment, and mark where it should have ended."""

    kind: Literal["label_lo"]
    segments: list[Segment] = Field(min_length=1, max_length=1, description="The segment to label.")


class AskLabelFull(AskBase):
    """Label_FULL(tau_FULL): choose a good action for each state of the full trajectory."""

    kind: Literal["label_full"]
    segments: list[Segment] = Field(
        min_length=1, max_length=1_000, description="The segments of the episode, in order."
    )


Ask = Annotated[
    AskHierDemo | AskInspectFull | AskLabelHi | AskInspectLo | AskLabelLo | AskLabelFull,
    Field(discriminator="kind"),
]


class Query(Message):
    """A query with its state and its answer, sent by the server."""

    id: int
    run: str = Field(description="The id of the run.")
    state: QueryState
    priority: int = Field(description="Queries with a higher priority are handed out first.")
    created_at: float = Field(description="When the learner asked, in seconds since the epoch.")
    ask: Ask = Field(description="The query as the learner asked it.")
    answer: Answer | None = Field(description="The answer that counts; null if there is none.")
    answer_id: int | None
    used: bool = Field(description="Whether the learner has used the answer; a used answer can no longer be retracted.")
    annotator: str | None = Field(description="The name of the user who answered, or who holds the query now.")
    units: float | None = Field(description="The cost of the answer, in units.")
    seconds: float | None = Field(description="The time from lease to answer, in seconds, by the server's clock.")
    active_seconds: float | None = Field(description="The annotator's working time without idle time, in seconds.")


class Asked(Message):
    """The server's reply to `POST /runs/{id}/queries`: the queries in the same order, with answers if they have any."""

    queries: list[Query]


class AskList(Message):
    """One or more queries of one run, sent by the learner.

    Sending a query again with the same episode, ordinal and content changes nothing.
    """

    queries: list[Ask] = Field(min_length=1, max_length=1_000)
    priority: int = Field(
        default=0, ge=-1_000, le=1_000, description="Queries with a higher priority are handed out first."
    )


class QueryList(Message):
    """Queries of a run, newest first, sent by the server. For the next page, set `before` to the last query's id."""

    queries: list[Query]


class AnswerPage(Message):
    """Answered queries after a cursor, in the order of the answers, sent by the server."""

    queries: list[Query]
    cursor: int = Field(description="The cursor for the next request.")
