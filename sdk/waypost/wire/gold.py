"""Defines the messages about gold queries and practice queries: queries with known answers."""

from typing import Annotated, Literal

from pydantic import Field

from waypost.wire.answers import Answer, HierDemoAnswer
from waypost.wire.queries import Ask, AskHierDemo
from waypost.wire.runs import Vocabulary
from waypost.wire.words import Kind, Message, Name, Verdict

__all__ = [
    "Choices",
    "Exercise",
    "Feedback",
    "Gold",
    "GoldList",
    "GoldPost",
    "Known",
    "KnownActions",
    "KnownAsk",
    "KnownSegment",
    "KnownSubgoals",
    "KnownVerdict",
    "Mark",
    "Practice",
    "PracticeAnswer",
    "PracticePut",
    "PracticeQuery",
    "Reason",
    "WorkedDemonstration",
    "WorkedExample",
]


MOST_EXERCISES = 100  # that a learner sends for a run


class KnownVerdict(Message):
    """The correct verdict of an inspection."""

    kind: Literal["inspect_full", "inspect_lo"]
    verdict: Verdict


Choices = Annotated[list[Name], Field(min_length=1, max_length=1_000)]


class KnownSubgoals(Message):
    """The correct subgoals of a Label_HI."""

    kind: Literal["label_hi"]
    subgoals: list[Choices] = Field(max_length=10_000, description="For each segment, all correct subgoals.")


class KnownSegment(Message):
    """The correct actions and the correct end of a Label_LO."""

    kind: Literal["label_lo"]
    actions: list[Choices] = Field(
        max_length=10_000, description="For each state before the segment should end, all correct actions."
    )
    end: int | None = Field(
        ge=0, le=10_000, description="The number of the state where the segment should end, from 0; null if in none."
    )


class KnownActions(Message):
    """The correct actions of a Label_FULL."""

    kind: Literal["label_full"]
    actions: list[Choices] = Field(
        max_length=100_000, description="For each state of the full trajectory, all correct actions."
    )


Known = Annotated[KnownVerdict | KnownSubgoals | KnownSegment | KnownActions, Field(discriminator="kind")]


class KnownAsk(Message):
    """A query with its correct answers; a label can have several correct values."""

    ask: Ask
    known: Known = Field(description="The correct answers.")


class GoldPost(Message):
    """New gold queries of a run, sent by a learner or an administrator. Existing gold queries do not change."""

    answered: list[int] = Field(
        default_factory=list,
        max_length=1_000,
        description="Ids of answered queries of this run. Each answer becomes the only correct one.",
    )
    known: list[KnownAsk] = Field(
        default_factory=list, max_length=1_000, description="Queries together with their correct answers."
    )


class Gold(Message):
    """A gold query with its results so far, sent by the server."""

    id: int
    kind: Kind
    question: str = Field(description="The query in words.")
    known: Known = Field(description="The correct answers.")
    query: int | None = Field(description="The id of the answered query it was made from; null if there is none.")
    author: str | None = Field(description="The name of the user who answered that query; they never get it as gold.")
    answers: int = Field(description="How often it was answered.")
    agreement: float | None = Field(description="The share of correct labels in all answers, 0 to 1; null if none.")
    created_at: float = Field(description="When it became gold, in seconds since the epoch.")


class GoldList(Message):
    """The gold queries of a run, newest first, sent by the server."""

    gold: list[Gold]


class Mark(Message):
    """One label of an answer, compared with the correct labels; sent by the server."""

    place: int = Field(description="The number of the label, from 0; for a Label_LO, the number of the state.")
    given: str | None = Field(
        description='The label in the answer. "(done)" and "(not done)" are the two labels of a segment\'s end.'
    )
    right: list[str] = Field(description="All correct labels in this place.")
    is_right: bool = Field(description="Whether the given label is correct.")


class PracticeQuery(Message):
    """A practice query, sent by the server."""

    id: int
    ask: Ask


Reason = Literal["accomplished", "not_accomplished", "shortest", "no_way"]
"""Why labels are correct; `Feedback.reasons` says what each means."""


class Exercise(KnownAsk):
    """A practice query with its correct answers and a reason for each label."""

    reasons: list[Reason] = Field(max_length=100_000, description="For each label, why the correct labels are correct.")


class Feedback(Message):
    """The server's reply to a practice answer: each label compared with the correct ones."""

    marks: list[Mark]
    reasons: list[Reason] = Field(
        description="For each label, why the correct labels are correct. `accomplished`, `not_accomplished`: the goal "
        "is, or is not, accomplished in this state. `shortest`: they are on a shortest path to it. `no_way`: nothing "
        "leads to it from this state. The goal is the segment's subgoal in a Label_LO or an Inspect_LO, else the task."
    )
    is_right: bool = Field(description="Whether all labels are correct.")


class WorkedExample(Message):
    """A practice query with a correct answer, sent by the server; it is shown before others of its kind are asked."""

    query: int = Field(description="The id of the practice query.")
    feedback: Feedback = Field(description="A correct answer, and the reason for each label.")


class WorkedDemonstration(Message):
    """A demonstration as a worked example, sent by the server. To practice one, a learner's environment is needed."""

    ask: AskHierDemo
    answer: HierDemoAnswer = Field(
        description="A good demonstration, with the states that were seen. The episode ends with it, unless it plays "
        "on where the learner failed."
    )


class Practice(Message):
    """The practice queries of a domain in their order, sent by the server. Practice stores and costs nothing."""

    vocabulary: Vocabulary
    queries: list[PracticeQuery]
    examples: list[WorkedExample] = Field(
        description="The last query of each kind, for the kinds that have several queries."
    )
    demonstrations: list[WorkedDemonstration] = Field(
        description="At most one for each way in which demonstrations are asked for."
    )
    domains: list[str] = Field(description="All domains that can be practiced on this server.")


class PracticePut(Message):
    """Practice queries of a run's domain, sent by its learner. Their pictures are uploaded before."""

    exercises: list[Exercise] = Field(min_length=1, max_length=MOST_EXERCISES)
    demonstrations: list[WorkedDemonstration] = Field(
        max_length=10, description="At most one for each way in which demonstrations are asked for."
    )


class PracticeAnswer(Message):
    """An answer to a practice query, sent by an annotator."""

    answer: Answer
