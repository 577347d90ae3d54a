"""Defines the paginated views of a run: its queries, its ledger, the history of a query, and who is working."""

from typing import Literal

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.comments import Comment
from waypost.wire.words import DemoForm, Kind, Message, QueryState

__all__ = [
    "AssignmentState",
    "AtWork",
    "AtWorkList",
    "Change",
    "Doing",
    "ExportFormat",
    "ExportTable",
    "Holding",
    "LedgerEntry",
    "LedgerEntryKind",
    "LedgerPage",
    "Outlook",
    "PastAnswer",
    "PastAssignment",
    "QueryHistory",
    "QueryPage",
    "QueryRow",
    "RunOutlook",
    "Stuck",
    "StuckQuery",
    "StuckReason",
]

AssignmentState = Literal["live", "answered", "skipped", "released", "expired", "cancelled"]
LedgerEntryKind = Literal["charge", "refund"]
StuckReason = Literal["waiting", "expired", "skipped"]
ExportTable = Literal["curves", "ledger", "queries"]
ExportFormat = Literal["csv", "jsonl"]


class QueryRow(Message):
    """A query and its answer without the trajectory, as a row of a table; sent by the server."""

    id: int
    episode: int = Field(description="The number of the episode in the run, from 0.")
    ordinal: int = Field(description="The number of the query in the episode, from 0.")
    kind: Kind
    state: QueryState
    priority: int = Field(description="Queries with a higher priority are handed out first.")
    question: str = Field(description="The query in words.")
    created_at: float = Field(description="When the learner asked, in seconds since the epoch.")
    answered_at: float | None = Field(description="When the answer was given, in seconds since the epoch.")
    answer: Answer | None = Field(description="The answer that counts; null if there is none.")
    used: bool = Field(description="Whether the learner has used the answer.")
    annotator: str | None = Field(description="The name of the user who answered, or who holds the query now.")
    units: float | None = Field(description="The cost of the answer, in units.")
    seconds: float | None = Field(description="The time from lease to answer, in seconds.")
    skips: int = Field(description="How often annotators skipped the query.")
    expiries: int = Field(description="How many leases of the query expired.")


class QueryPage(Message):
    """One page of a run's queries, newest first, sent by the server."""

    rows: list[QueryRow]
    total: int = Field(description="The number of queries on all pages.")
    newest: int | None = Field(description="The id of the newest query on all pages.")
    oldest: int | None = Field(description="The id of the oldest query on all pages.")


class LedgerEntry(Message):
    """One entry of the ledger, sent by the server: a charge, or a refund with negative amounts."""

    id: int
    at: float = Field(description="When it was booked, in seconds since the epoch.")
    entry: LedgerEntryKind
    kind: Kind = Field(description="The kind of the query.")
    query: int = Field(description="The id of the query.")
    episode: int = Field(description="The number of the episode in the run, from 0.")
    ordinal: int = Field(description="The number of the query in the episode, from 0.")
    annotator: str = Field(description="The name of the user who answered.")
    units: float = Field(description="The cost of the answer, in units.")
    lo_units: float = Field(description="The part of `units` for LO labels: actions and terminations.")
    seconds: float = Field(description="The time from lease to answer, in seconds.")
    balance: float = Field(description="The units that the run had spent after this entry.")


class LedgerPage(Message):
    """One page of a run's ledger, newest first, with the sums over all pages; sent by the server."""

    entries: list[LedgerEntry]
    total: int = Field(description="The number of entries on all pages.")
    newest: int | None = Field(description="The id of the newest entry on all pages.")
    oldest: int | None = Field(description="The id of the oldest entry on all pages.")
    units: float = Field(description="The sum of `units` on all pages.")
    lo_units: float = Field(description="The sum of `lo_units` on all pages.")
    seconds: float = Field(description="The sum of `seconds` on all pages.")
    spent: float = Field(description="The units that the run has spent; equal to `units` if there is no filter.")


class PastAnswer(Message):
    """An answer that was given at some time, sent by the server. Answers never change."""

    id: int
    content: Answer
    at: float = Field(description="When it was given, in seconds since the epoch.")
    units: float = Field(description="The charged units; 0 if the answer was late.")
    seconds: float = Field(description="The time from lease to answer, in seconds.")
    fate: Literal["counts", "retracted", "late"] = Field(
        description="Whether the answer counts, was retracted, or came after the end of the lease."
    )


class PastAssignment(Message):
    """One assignment of a query and its end, sent by the server."""

    id: int
    annotator: str = Field(description="The name of the user.")
    state: AssignmentState
    reason: str | None = Field(description="The annotator's reason for skipping or releasing it.")
    leased_at: float = Field(description="When the lease began, in seconds since the epoch.")
    expires_at: float = Field(description="When the lease expires or expired, in seconds since the epoch.")
    ended_at: float | None = Field(description="When the assignment ended, in seconds since the epoch; null if live.")
    answer: PastAnswer | None


class QueryHistory(Message):
    """All assignments, ledger entries and comments of a query, oldest first, and its neighbors; sent by the server."""

    assignments: list[PastAssignment]
    ledger: list[LedgerEntry]
    comments: list[Comment] = Field(description="What reviewers wrote about the query.")
    previous: int | None = Field(description="The id of the previous query in the run, by episode and ordinal.")
    next: int | None = Field(description="The id of the next query in the run, by episode and ordinal.")


class Holding(Message):
    """A query that an annotator holds now, sent by the server."""

    query: int = Field(description="The id of the query.")
    run: str = Field(description="The id of the run.")
    kind: Kind
    episode: int = Field(description="The number of the episode in the run, from 0.")
    leased_at: float = Field(description="When the lease began, in seconds since the epoch.")


class AtWork(Message):
    """An annotator who recently asked for work or holds a query, sent by the server."""

    annotator: str = Field(description="The name of the user.")
    run: str | None = Field(description="The id of the requested run; null for any run.")
    kinds: list[Kind] | None = Field(description="The requested kinds of queries; null for all kinds.")
    seen_at: float = Field(description="When they last asked for work or renewed a lease, in seconds since the epoch.")
    holds: list[Holding] = Field(description="The queries that they hold, oldest first.")


class AtWorkList(Message):
    """The annotators who are working, most recently seen first; sent by the server."""

    annotators: list[AtWork]


Doing = Literal["nothing_yet", "asking", "training", "rolling_out", "paused", "finished"]


class RunOutlook(Message):
    """What the learner of a run does, and when it will ask again; sent by the server."""

    run: str = Field(description="The id of the run.")
    name: str = Field(description="The name of the run.")
    domain: str = Field(description="The name of the run's domain.")
    kinds: list[Kind] = Field(description="The kinds of query that the learner asked lately.")
    demonstrations: list[DemoForm] = Field(
        description="How it asked for its last demonstrations: `hier_demo`, segments with subgoals; `flat_demo`, "
        "actions only; `play_on`, from a state where it failed."
    )
    doing: Doing = Field(
        description="What the learner does: it waits for answers (`asking`), learns from them (`training`), or acts "
        "until it has something to ask (`rolling_out`); or it has neither asked nor reported anything yet "
        "(`nothing_yet`); or the run is paused or finished."
    )
    seconds: float = Field(description="How long ago the run changed last, in seconds.")
    usual_seconds: float | None = Field(
        description="The median time from the last answer to the next query, over the last 20 times that no query was "
        "open, in seconds; null before the first."
    )
    open: int = Field(description="The number of unanswered queries, rounded up to tens; 1,000 for more.")


class Outlook(Message):
    """What an annotator without a query can expect, sent by the server."""

    open: int = Field(
        description="The number of unanswered queries of all running runs, rounded up to tens; 1,000 for more."
    )
    runs: list[RunOutlook] = Field(
        description="The newest runs, at most six: running ones first, then paused ones, then finished ones."
    )


class Change(Message):
    """A server-sent event: something changed in some run."""

    newest: int = Field(description="The id of the newest event of all runs.")


class StuckQuery(Message):
    """A query that is stuck, and why."""

    query: int = Field(description="The id of the query.")
    episode: int
    kind: Kind
    reasons: list[StuckReason] = Field(
        description="waiting: it has been open for more than 10 minutes. expired: two or more of its leases expired. "
        "skipped: every annotator of the last day who takes queries of its run and kind has skipped it."
    )
    open_since: float = Field(
        description="When it was asked, or when the last lease of it ended, in seconds since the epoch."
    )
    expiries: int = Field(description="How many leases of the query expired.")


class Stuck(Message):
    """The queries of a run that are stuck, oldest first, sent by the server."""

    queries: list[StuckQuery] = Field(description="The first 20.")
    total: int = Field(description="How many there are.")
