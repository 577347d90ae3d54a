"""Practice queries, read from a file that `waypost practice` wrote."""

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

    reasons: list[str]


class PracticeFile(BaseModel):
    """The content of a file of practice queries."""

    vocabulary: wire.Vocabulary
    frames: list[wire.Frame] = []  # the pictures of all states, for a domain without a renderer
    exercises: list[Exercise]


class BadPractice(Exception):
    """The file cannot be used. The message says why and what to do."""


class PracticeSet:
    """The practice queries of a server."""

    def __init__(self, path: Path | None = None, most_frame_bytes: int = 2**20) -> None:
        """Read the file at `path`, or the file in this package. A frame may have at most `most_frame_bytes`.

        Raises:
            BadPractice: with one sentence for the operator.
        """
        chosen = path or SHIPPED
        try:
            self._file = PracticeFile.model_validate_json(chosen.read_bytes())
            self._names = checks.Names.of(self._file.vocabulary)
            self.frames = frames.decode(self._file.frames, most_frame_bytes)
            for place, one in enumerate(self._file.exercises):
                self._check(one, ["exercises", place])
        except (OSError, ValidationError, errors.Unprocessable) as error:
            reason = str(error).partition("\n")[0]
            raise BadPractice(
                f"{chosen} has no practice queries: {reason}; `waypost practice` writes such a file."
            ) from None

    def _check(self, one: Exercise, at: errors.Location) -> None:
        checks.check_ask(one.ask, self._names, [*at, "ask"])
        for segment in (*getattr(one.ask, "segments", ()), *one.ask.context):
            if absent := set(segment.frames) - set(self.frames):
                raise errors.Unprocessable([*at, "ask"], f"frame {min(absent)} is not in the file")
        scoring.check(one.ask, one.known, self._names, [*at, "known"])

    def questions(self) -> wire.Practice:
        """Return the queries without their known answers, except those of the examples."""
        asks = [wire.PracticeQuery(id=place, ask=one.ask) for place, one in enumerate(self._file.exercises)]
        return wire.Practice(vocabulary=self._file.vocabulary, queries=asks, examples=self._examples())

    def _examples(self) -> list[wire.WorkedExample]:
        """Return a worked example of each kind of which a query is left to answer."""
        by_kind: dict[wire.Kind, list[int]] = {}
        for place, one in enumerate(self._file.exercises):
            by_kind.setdefault(one.ask.kind, []).append(place)
        return [self._example(places[-1]) for places in by_kind.values() if len(places) > 1]

    def _example(self, place: int) -> wire.WorkedExample:
        one = self._file.exercises[place]
        feedback = wire.Feedback(marks=scoring.solved(one.known), reasons=one.reasons, is_right=True)
        return wire.WorkedExample(query=place, feedback=feedback)

    def mark(self, query: int, answer: wire.Answer) -> wire.Feedback:
        """Score an answer.

        Raises:
            NotFound, Unprocessable: there is no such query, or the answer does not fit it.
        """
        exercises: Sequence[Exercise] = self._file.exercises
        if query >= len(exercises):
            raise errors.NotFound(f"There is no practice query {query}.")
        one = exercises[query]
        checks.check_answer(one.ask, answer, self._names, ["body", "answer"])
        marks = scoring.marks(one.known, answer)
        return wire.Feedback(marks=marks, reasons=one.reasons, is_right=all(mark.is_right for mark in marks))


async def open_practice(db: Database, path: Path | None, most_frame_bytes: int) -> PracticeSet:
    """Read the practice queries, and store their pictures, so that the web app finds them like those of a run.

    Raises:
        BadPractice: with one sentence for the operator.
    """
    practice = PracticeSet(path, most_frame_bytes)
    if practice.frames:
        await db.write(lambda tx: _keep(tx, practice.frames))
    return practice


def _keep(tx: Tx, files: dict[str, bytes]) -> None:
    frames.store(tx, files)
    frames.pin(tx, files)


async def practice_of(connection: HTTPConnection) -> PracticeSet:
    """Return the practice queries of the app that serves a request."""
    return cast(PracticeSet, connection.app.state.practice)


Exercises = Annotated[PracticeSet, Depends(practice_of)]
