"""Watching: what whoever looks at a run leafs through."""

from typing import Literal

from pydantic import Field

from waypost.wire.answers import Answer
from waypost.wire.words import Kind, Message, QueryState

__all__ = [
    "AssignmentState",
    "AtWork",
    "AtWorkList",
    "Change",
    "ExportFormat",
    "ExportTable",
    "Holding",
    "LedgerEntry",
    "LedgerEntryKind",
    "LedgerPage",
    "PastAnswer",
    "PastAssignment",
    "QueryHistory",
    "QueryPage",
    "QueryRow",
]

AssignmentState = Literal["live", "answered", "skipped", "released", "expired", "cancelled"]
LedgerEntryKind = Literal["charge", "refund"]
ExportTable = Literal["curves", "ledger", "queries"]
ExportFormat = Literal["csv", "jsonl"]


class QueryRow(Message):
    """A query in a table: what was asked and what came of it, without the trajectory."""

    id: int
    episode: int
    ordinal: int
    kind: Kind
    state: QueryState
    priority: int
    question: str
    created_at: float
    answered_at: float | None
    answer: Answer | None
    used: bool
    annotator: str | None = Field(description="Who answered, or who holds it now.")
    units: float | None
    seconds: float | None
    skips: int = Field(description="How often it was skipped.")
    expiries: int = Field(description="How many of its leases ran out.")


class QueryPage(Message):
    """A page of a run's queries, newest first."""

    rows: list[QueryRow]
    total: int = Field(description="How many there are on all pages.")
    newest: int | None = Field(description="The newest of them on any page.")
    oldest: int | None = Field(description="The oldest of them on any page.")


class LedgerEntry(Message):
    """One line of the ledger: a charge, or a refund with its amounts below zero."""

    id: int
    at: float
    entry: LedgerEntryKind
    kind: Kind
    query: int
    episode: int
    ordinal: int
    annotator: str
    units: float
    lo_units: float
    seconds: float
    balance: float = Field(description="What the run had spent after this line.")


class LedgerPage(Message):
    """A page of a run's ledger, newest first, and the sums of all its pages."""

    entries: list[LedgerEntry]
    total: int = Field(description="How many lines there are on all pages.")
    newest: int | None = Field(description="The newest of them on any page.")
    oldest: int | None = Field(description="The oldest of them on any page.")
    units: float
    lo_units: float
    seconds: float
    spent: float = Field(description="What the run's account says; without a filter, `units` is the same.")


class PastAnswer(Message):
    """An answer as it was given; never changed."""

    id: int
    content: Answer
    at: float
    units: float = Field(description="What it was charged; 0 if it came too late.")
    seconds: float
    fate: Literal["counts", "retracted", "late"]


class PastAssignment(Message):
    """One time a query was handed out, and how that ended."""

    id: int
    annotator: str
    state: AssignmentState
    reason: str | None = Field(description="What was said when it was skipped or given back.")
    leased_at: float
    expires_at: float
    ended_at: float | None
    answer: PastAnswer | None


class QueryHistory(Message):
    """Everything that became of a query, oldest first, and its neighbors in its run."""

    assignments: list[PastAssignment]
    ledger: list[LedgerEntry]
    previous: int | None = Field(description="The query asked before it in the run, by episode and ordinal.")
    next: int | None


class Holding(Message):
    """A query somebody holds right now."""

    query: int
    run: str
    kind: Kind
    episode: int
    leased_at: float


class AtWork(Message):
    """An annotator who asked for work of late or holds a query."""

    annotator: str
    run: str | None = Field(description="The run asked for; null for any.")
    kinds: list[Kind] | None = Field(description="The kinds asked for; null for any.")
    seen_at: float
    holds: list[Holding]


class AtWorkList(Message):
    """Who is at work, the one seen last first."""

    annotators: list[AtWork]


class Change(Message):
    """Something changed in some run, as sent by server-sent events."""

    newest: int = Field(description="The newest event of any run.")
