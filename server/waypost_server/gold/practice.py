"""Practice queries and worked examples, read from files that `waypost practice` wrote: one for each domain."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, cast

from fastapi import Depends
from pydantic import BaseModel, ValidationError
from starlette.requests import HTTPConnection

from waypost import wire
from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.transaction import Tx
from waypost_server.gold import scoring
from waypost_server.queries import checks, frames

SHIPPED = Path(__file__).with_name("practice.json")


class Exercise(wire.KnownAsk):
    """A practice query with its known answer and a reason for each label."""

    reasons: list[wire.Reason]


class PracticeFile(BaseModel):
    """The content of a file of practice queries."""

    vocabulary: wire.Vocabulary
    frames: list[wire.Frame] = []  # the pictures of all states, for a domain without a renderer
    exercises: list[Exercise]
    demonstrations: list[wire.WorkedDemonstration]


class BadPractice(Exception):
    """The file cannot be used. The message says why and what to do."""


class PracticeSet:
    """The practice queries of one domain. Their ids are numbers from `first`."""

    def __init__(self, path: Path, most_frame_bytes: int = 2**20, first: int = 0) -> None:
        """Read a file. A frame may have at most `most_frame_bytes`.

        Raises:
            BadPractice: with one sentence for the operator.
        """
        try:
            self._file = PracticeFile.model_validate_json(path.read_bytes())
            self._names = checks.Names.of(self._file.vocabulary)
            self.frames = frames.decode(self._file.frames, most_frame_bytes)
            for place, one in enumerate(self._file.exercises):
                self._check(one, ["exercises", place])
            for place, shown in enumerate(self._file.demonstrations):
                self._check_shown(shown, ["demonstrations", place])
        except (OSError, ValidationError, errors.Unprocessable) as error:
            reason = str(error).partition("\n")[0]
            raise BadPractice(
                f"{path} has no practice queries: {reason}; `waypost practice` writes such a file."
            ) from None
        self.domain = self._file.vocabulary.domain
        self.ids = range(first, first + len(self._file.exercises))

    def _check(self, one: Exercise, at: errors.Location) -> None:
        self._check_ask(one.ask, [*at, "ask"])
        scoring.check(one.ask, one.known, self._names, [*at, "known"])

    def _check_shown(self, one: wire.WorkedDemonstration, at: errors.Location) -> None:
        self._check_ask(one.ask, [*at, "ask"])
        checks.check_answer(one.ask, one.answer, self._names, [*at, "answer"])
        if one.answer.replay is None or not one.answer.replay.states:
            raise errors.Unprocessable([*at, "answer", "replay"], "has no states, so there is nothing to show")
        self._check_frames(one.answer.replay.frames, [*at, "answer", "replay"])

    def _check_ask(self, ask: wire.Ask, at: errors.Location) -> None:
        checks.check_ask(ask, self._names, at)
        for segment in (*getattr(ask, "segments", ()), *ask.context):
            self._check_frames(segment.frames, at)

    def _check_frames(self, hashes: Sequence[str], at: errors.Location) -> None:
        if absent := set(hashes) - set(self.frames):
            raise errors.Unprocessable(at, f"frame {min(absent)} is not in the file")

    def questions(self, domains: Sequence[str] = ()) -> wire.Practice:
        """Return the queries without their known answers, except those of the examples."""
        asks = [wire.PracticeQuery(id=n, ask=one.ask) for n, one in zip(self.ids, self._file.exercises, strict=True)]
        return wire.Practice(
            vocabulary=self._file.vocabulary,
            queries=asks,
            examples=self._examples(),
            demonstrations=self._file.demonstrations,
            domains=list(domains),
        )

    def _examples(self) -> list[wire.WorkedExample]:
        """Return a worked example of each kind of which a query is left to answer."""
        by_kind: dict[wire.Kind, list[int]] = {}
        for place, one in enumerate(self._file.exercises):
            by_kind.setdefault(one.ask.kind, []).append(place)
        return [self._example(places[-1]) for places in by_kind.values() if len(places) > 1]

    def _example(self, place: int) -> wire.WorkedExample:
        one = self._file.exercises[place]
        feedback = wire.Feedback(marks=scoring.solved(one.known), reasons=one.reasons, is_right=True)
        return wire.WorkedExample(query=self.ids[place], feedback=feedback)

    def mark(self, query: int, answer: wire.Answer) -> wire.Feedback:
        """Score an answer.

        Raises:
            Unprocessable: the answer does not fit the query.
        """
        one = self._file.exercises[self.ids.index(query)]
        checks.check_answer(one.ask, answer, self._names, ["body", "answer"])
        marks = scoring.marks(one.known, answer)
        return wire.Feedback(marks=marks, reasons=one.reasons, is_right=all(mark.is_right for mark in marks))


class PracticeSets:
    """The practice queries of a server."""

    def __init__(self, paths: Sequence[Path] = (), most_frame_bytes: int = 2**20) -> None:
        """Read the files, or the file in this package if there are none.

        Raises:
            BadPractice: with one sentence for the operator.
        """
        self._sets: dict[str, PracticeSet] = {}
        self.frames: dict[str, bytes] = {}
        first = 0
        for path in paths or (SHIPPED,):
            one = PracticeSet(path, most_frame_bytes, first)
            if one.domain in self._sets:
                raise BadPractice(f"{path} is a second file of practice queries about {one.domain!r}; name only one.")
            self._sets[one.domain] = one
            self.frames |= one.frames
            first = one.ids.stop

    def questions(self, domain: str | None = None) -> wire.Practice:
        """Return the queries of a domain, or of the first one.

        Raises:
            NotFound: there are none for this domain.
        """
        domains = list(self._sets)
        chosen = self._sets.get(domains[0] if domain is None else domain)
        if chosen is None:
            raise errors.NotFound(f"There is no practice for {domain!r}, only for: {', '.join(domains)}.")
        return chosen.questions(domains)

    def mark(self, query: int, answer: wire.Answer) -> wire.Feedback:
        """Score an answer.

        Raises:
            NotFound, Unprocessable: there is no such query, or the answer does not fit it.
        """
        found = next((one for one in self._sets.values() if query in one.ids), None)
        if found is None:
            raise errors.NotFound(f"There is no practice query {query}.")
        return found.mark(query, answer)


async def open_practice(db: Database, paths: Sequence[Path], most_frame_bytes: int) -> PracticeSets:
    """Read the practice queries, and store their pictures, so that the web app finds them like those of a run.

    Raises:
        BadPractice: with one sentence for the operator.
    """
    practice = PracticeSets(paths, most_frame_bytes)
    if practice.frames:
        await db.write(lambda tx: _keep(tx, practice.frames))
    return practice


def _keep(tx: Tx, files: dict[str, bytes]) -> None:
    frames.store(tx, files)
    frames.pin(tx, files)


async def practice_of(connection: HTTPConnection) -> PracticeSets:
    """Return the practice queries of the app that serves a request."""
    return cast(PracticeSets, connection.app.state.practice)


Exercises = Annotated[PracticeSets, Depends(practice_of)]
