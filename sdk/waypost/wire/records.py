"""Defines the records of a run: everything that a run contains, as values that another store can take in."""

from typing import Annotated, Literal

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.frames import Frame
from waypost.wire.queries import Ask
from waypost.wire.runs import EpisodeResult, Run
from waypost.wire.watching import AssignmentState, LedgerEntryKind
from waypost.wire.words import Kind, Message, Name, QueryState

__all__ = [
    "AnswerRecord",
    "AssignmentRecord",
    "EpisodeRecord",
    "FrameRecord",
    "LedgerRecord",
    "QueryRecord",
    "Record",
    "RecordPage",
    "RecordPart",
    "RunRecord",
]

RecordPart = Literal["queries", "ledger", "episodes"]


class AnswerRecord(Message):
    """An answer as it was stored."""

    content: Answer
    revision: int | None = Field(
        ge=0, description="How often the query had been retracted before this answer; null if the answer was late."
    )
    units: float = Field(ge=0, description="The charged units; 0 if the answer was late.")
    seconds: float = Field(ge=0, allow_inf_nan=False, description="The time from lease to answer, in seconds.")
    active_seconds: float = Field(
        ge=0, allow_inf_nan=False, description="The annotator's working time without idle time, in seconds."
    )
    at: float = Field(allow_inf_nan=False, description="When it was given, in seconds since the epoch.")


class AssignmentRecord(Message):
    """One assignment of a query: who held it, how it ended, and the answer that came of it."""

    annotator: Name = Field(description="The annotator's name or pseudonym.")
    state: AssignmentState
    deferring: bool = Field(description="Whether the annotator leaves queries to others for a while.")
    reason: str | None = Field(description="The annotator's reason for skipping or releasing it.")
    leased_at: float = Field(allow_inf_nan=False, description="When the lease began, in seconds since the epoch.")
    expires_at: float = Field(allow_inf_nan=False, description="When the lease expired, in seconds since the epoch.")
    ended_at: float | None = Field(
        allow_inf_nan=False, description="When the assignment ended, in seconds since the epoch; null if it is live."
    )
    answer: AnswerRecord | None


class RunRecord(Message):
    """The run itself, the first record."""

    record: Literal["run"] = "run"
    format: Literal[1] = Field(default=1, description="The version of these records.")
    run: Run


class FrameRecord(Message):
    """A picture. It comes before the first query that shows it."""

    record: Literal["frame"] = "frame"
    frame: Frame


class QueryRecord(Message):
    """A query with its answer and its whole history. (episode, ordinal) in `ask` identifies it in its run."""

    record: Literal["query"] = "query"
    state: QueryState
    priority: int = Field(description="Queries with a higher priority were handed out first.")
    used: bool = Field(description="Whether the learner has used the answer.")
    created_at: float = Field(allow_inf_nan=False, description="When the learner asked, in seconds since the epoch.")
    ask: Ask = Field(description="The query as the learner asked it.")
    answered: AssignmentRecord | None = Field(description="The assignment with the answer that counts.")
    earlier: list[AssignmentRecord] = Field(description="All other assignments, oldest first.")


class LedgerRecord(Message):
    """One entry of the ledger: a charge, or a refund with negative amounts."""

    record: Literal["ledger"] = "ledger"
    entry: LedgerEntryKind
    kind: Kind = Field(description="The kind of the query.")
    episode: int = Field(description="The number of the episode in the run, from 0.")
    ordinal: int = Field(description="The number of the query in the episode, from 0.")
    revision: int = Field(description="The revision of the answer that was charged or refunded.")
    units: float = Field(description="The cost of the answer, in units.")
    lo_units: float = Field(description="The part of `units` for LO labels: actions and terminations.")
    seconds: float = Field(allow_inf_nan=False, description="The time from lease to answer, in seconds.")
    active_seconds: float = Field(allow_inf_nan=False, description="The working time without idle time, in seconds.")
    at: float = Field(allow_inf_nan=False, description="When it was booked, in seconds since the epoch.")


class EpisodeRecord(Message):
    """The result of an episode."""

    record: Literal["episode"] = "episode"
    result: EpisodeResult
    at: float = Field(allow_inf_nan=False, description="When it was reported, in seconds since the epoch.")


Record = Annotated[RunRecord | FrameRecord | QueryRecord | LedgerRecord | EpisodeRecord, Field(discriminator="record")]


class RecordPage(Message):
    """One page of a part of a run's records, sent by the server."""

    records: list[Annotated[QueryRecord | LedgerRecord | EpisodeRecord, Field(discriminator="record")]]
    cursor: int | None = Field(description="The cursor for the next page; null after the last record.")
