"""Gold queries and practice: queries whose answers are known."""

from typing import Annotated, Literal

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.queries import Ask
from waypost.wire.runs import Vocabulary
from waypost.wire.words import Kind, Message, Name, Verdict

__all__ = [
    "Choices",
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
    "PracticeQuery",
]


class KnownVerdict(Message):
    """What an inspection should say."""

    kind: Literal["inspect_full", "inspect_lo"]
    verdict: Verdict


Choices = Annotated[list[Name], Field(min_length=1, max_length=1_000)]


class KnownSubgoals(Message):
    """The subgoals that are right, for each segment."""

    kind: Literal["label_hi"]
    subgoals: list[Choices] = Field(max_length=10_000)


class KnownSegment(Message):
    """The actions that are right, for each state before the segment should end."""

    kind: Literal["label_lo"]
    actions: list[Choices] = Field(max_length=10_000)
    end: int | None = Field(ge=0, le=10_000, description="The state it should end in, from 0; null if in none of them.")


class KnownActions(Message):
    """The actions that are right, for each state of the full trajectory."""

    kind: Literal["label_full"]
    actions: list[Choices] = Field(max_length=100_000)


Known = Annotated[KnownVerdict | KnownSubgoals | KnownSegment | KnownActions, Field(discriminator="kind")]


class KnownAsk(Message):
    """A query and what is right: for each label all that is, where several choices are as good."""

    ask: Ask
    known: Known


class GoldPost(Message):
    """Queries to be gold in a run. What is gold already stays as it is."""

    answered: list[int] = Field(
        default_factory=list, max_length=1_000, description="Queries of this run; right is just what was answered."
    )
    known: list[KnownAsk] = Field(default_factory=list, max_length=1_000)


class Gold(Message):
    """A gold query, and what annotators made of it."""

    id: int
    kind: Kind
    question: str
    known: Known
    query: int | None = Field(description="The query it was marked from.")
    author: str | None = Field(description="Who answered that; it is never put to them.")
    answers: int
    agreement: float | None = Field(description="The share of right labels over all annotators.")
    created_at: float


class GoldList(Message):
    """The gold queries of a run, newest first."""

    gold: list[Gold]


class Mark(Message):
    """One label of an answer, beside what is right there."""

    place: int = Field(description="Which label, from 0; of a segment's actions and its end, which state.")
    given: str | None = Field(description='"(done)" and "(not done)" are the two labels of a segment\'s end.')
    right: list[str] = Field(description="All that is right there.")
    is_right: bool


class PracticeQuery(Message):
    """A query to practice on."""

    id: int
    ask: Ask


class Practice(Message):
    """Queries whose answers are known, in the order to meet them. Practicing stores nothing and costs nothing."""

    vocabulary: Vocabulary
    queries: list[PracticeQuery]


class PracticeAnswer(Message):
    """An answer given for practice."""

    answer: Answer


class Feedback(Message):
    """How good an answer was, label by label."""

    marks: list[Mark]
    reasons: list[str] = Field(description="Why, for each label.")
    is_right: bool = Field(description="Whether all of them are right.")
