"""Reads the records of a run from a store or from a server, one page at a time."""

import base64
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import Protocol

from waypost import wire
from waypost.client import Client
from waypost_learner.remote.embedded import stored_runs


class Source(Protocol):
    """A source of runs and their records."""

    def run(self, run: str) -> wire.Run:
        """Return a run."""

    def records(self, run: str, part: wire.RecordPart, after: int | None = None) -> wire.RecordPage:
        """Return one page of a part of a run's records; `after` is the cursor of the page before."""

    def frame(self, frame: str) -> bytes:
        """Return a picture as a PNG file, by its SHA-256."""


@contextmanager
def opened(store: Path | None, server: str, token: str) -> Iterator[Source]:
    """Open a store to read it, or a client of a server if `store` is None.

    Raises:
        ValueError: there is no such store.
    """
    with ExitStack() as stack:
        if store is not None:
            yield stack.enter_context(stored_runs(store))
        else:
            yield stack.enter_context(closing(Client(server, token)))


def records_of(source: Source, run: str, names: bool = True) -> Iterator[wire.Record]:
    """Yield all records of a run: the run, its queries (each after the frames it shows), its ledger, its episodes.

    Args:
        source: the source.
        run: the run's id.
        names: whether annotators keep their names. Otherwise each gets a pseudonym: the run's id and a number.

    Raises:
        ValueError, Refused: there is no such run.
    """
    found = source.run(run)
    yield wire.RunRecord(run=found)
    pseudonyms, seen = _Pseudonyms(found.id), _Seen()
    for record in _part(source, found.id, "queries"):
        assert isinstance(record, wire.QueryRecord)
        for frame in seen.new(_frames(record.ask)):
            png = base64.b64encode(source.frame(frame)).decode()
            yield wire.FrameRecord(frame=wire.Frame(hash=frame, png=png))
        yield record if names else pseudonyms.replace(record)
    yield from _part(source, found.id, "ledger")
    yield from _part(source, found.id, "episodes")


def _part(source: Source, run: str, part: wire.RecordPart) -> Iterator[wire.Record]:
    page = source.records(run, part)
    yield from page.records
    while page.cursor is not None:
        page = source.records(run, part, page.cursor)
        yield from page.records


def _frames(ask: wire.Ask) -> Iterator[str]:
    segments = () if isinstance(ask, wire.AskHierDemo) else ask.segments
    return (frame for segment in (*ask.context, *segments) for frame in segment.frames)


class _Seen:
    """The hashes that were yielded before. They are on disk, so memory does not grow with the number of pictures."""

    def __init__(self) -> None:
        self._db = sqlite3.connect("")  # a temporary database, which SQLite moves to disk when it grows
        self._db.execute("CREATE TABLE seen (hash TEXT PRIMARY KEY) WITHOUT ROWID")

    def new(self, hashes: Iterable[str]) -> Iterator[str]:
        """Yield the hashes that are new, each once."""
        for one in hashes:
            if self._db.execute("INSERT OR IGNORE INTO seen VALUES (?)", (one,)).rowcount:
                yield one


class _Pseudonyms:
    """Pseudonyms of annotators, numbered by their first appearance in the run.

    A pseudonym contains the run's id, so that data of several runs can be joined without confusing annotators.
    """

    def __init__(self, run: str) -> None:
        self._run = run
        self._known: dict[str, str] = {}

    def replace(self, record: wire.QueryRecord) -> wire.QueryRecord:
        """Return a query in which annotators have pseudonyms."""
        earlier = [self._replaced(one) for one in record.earlier]
        answered = None if record.answered is None else self._replaced(record.answered)
        return record.model_copy(update={"earlier": earlier, "answered": answered})

    def _replaced(self, one: wire.AssignmentRecord) -> wire.AssignmentRecord:
        pseudonym = self._known.setdefault(one.annotator, f"annotator-{self._run}-{len(self._known) + 1}")
        return one.model_copy(update={"annotator": pseudonym})
