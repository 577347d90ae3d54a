"""Defines the messages with which answers are reviewed."""

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.gold import Mark
from waypost.wire.watching import QueryRow
from waypost.wire.words import Kind, Message

__all__ = [
    "Agreement",
    "AgreementOfKind",
    "Difference",
    "Predicted",
    "Prediction",
    "Predictions",
    "ReviewPage",
    "ReviewRow",
    "SecondAnswer",
]

MOST_PREDICTIONS = 100  # in one request


class Prediction(Message):
    """What the current policies would answer to a query whose answer the learner has used, sent by the learner."""

    query: int = Field(ge=0, le=2**53, description="The id of the query.")
    answer: Answer = Field(description="Of the query's kind, which is one of the kinds that ask for labels.")


class Predictions(Message):
    """What the policies of one moment would answer, sent by the learner."""

    episode: int = Field(ge=0, le=10**9, description="The last episode from which the policies learned.")
    predictions: list[Prediction] = Field(max_length=MOST_PREDICTIONS, description="At most one per query.")


class Difference(Message):
    """A place where the learner's policies would answer otherwise than the annotator did, sent by the server."""

    place: int = Field(description="The number of the segment or the state in the query, from 0.")
    answer: str | None = Field(
        description='The annotator\'s label; "(done)" and "(not done)" are the two of a segment\'s end, null is none.'
    )
    policy: str | None = Field(description="The label of the policies, in the same words.")


class Predicted(Message):
    """What the learner's policies would answer to a query, as the learner sent it last; sent by the server."""

    episode: int = Field(description="The last episode from which the policies had learned.")
    answer: Answer
    differences: list[Difference] = Field(description="Where it differs from the annotator's answer.")


class SecondAnswer(Message):
    """The answer of a second annotator to the same query, sent by the server. The learner never gets it."""

    annotator: str = Field(description="The name of the second annotator.")
    answer: Answer
    units: float = Field(description="What the answer would cost, in units; the run does not pay it.")
    seconds: float = Field(description="The time from lease to answer, in seconds.")


class ReviewRow(Message):
    """An answered query under review, sent by the server, with what its answer is compared with."""

    query: QueryRow
    differs: bool | None = Field(
        description="Whether the answer differs from the learner's suggestion; null if the query had none."
    )
    policy: Predicted | None = Field(
        description="What the learner's policies would answer now; null if the learner has not sent it."
    )
    gold: list[Mark] | None = Field(
        description="For an answer to a gold query: its labels beside the correct ones; otherwise null."
    )
    second: SecondAnswer | None = Field(description="The answer of a second annotator; null if there is none.")


class ReviewPage(Message):
    """One page of answers under review, newest query first, sent by the server."""

    rows: list[ReviewRow]
    total: int = Field(description="The number of answers on all pages.")
    newest: int | None = Field(description="The id of the newest query on all pages.")
    oldest: int | None = Field(description="The id of the oldest query on all pages.")


class AgreementOfKind(Message):
    """The agreement of first and second answers to one kind of query, sent by the server."""

    kind: Kind
    queries: int = Field(description="The number of queries that two annotators answered.")
    labels: int = Field(description="The number of pairs of labels in these answers.")
    share: float | None = Field(description="The share of pairs whose labels are the same, 0 to 1; null without pairs.")
    alpha: float | None = Field(
        description="Krippendorff's alpha of the labels as names; null with fewer queries than `fewest`, or if all "
        "labels are the same."
    )


class Agreement(Message):
    """The agreement of the annotators of a run, sent by the server, and what its second answers cost."""

    by_kind: list[AgreementOfKind]
    fewest: int = Field(description="The number of queries answered twice from which on alpha is given.")
    waiting: int = Field(description="The number of second answers that are still wanted.")
    units: float = Field(description="What the second answers would cost at the run's prices; the run does not pay it.")
    active_seconds: float = Field(description="The annotators' working time for them without idle time, in seconds.")
