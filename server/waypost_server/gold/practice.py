"""Practice queries, read from a file that `waypost practice` wrote."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, cast

from fastapi import Depends
from pydantic import BaseModel, ValidationError
from starlette.requests import HTTPConnection

from waypost import wire
from waypost_server import errors
from waypost_server.gold import scoring
from waypost_server.queries import checks

SHIPPED = Path(__file__).with_name("practice.json")


class Exercise(wire.KnownAsk):
    """A practice query with its known answer and a reason for each label."""

    reasons: list[str]


class PracticeFile(BaseModel):
    """The content of a file of practice queries."""

    vocabulary: wire.Vocabulary
    exercises: list[Exercise]


class BadPractice(Exception):
    """The file cannot be used. The message says why and what to do."""


class PracticeSet:
    """The practice queries of a server."""

    def __init__(self, path: Path | None = None) -> None:
        """Read the file at `path`, or the file in this package.

        Raises:
            BadPractice: with one sentence for the operator.
        """
        chosen = path or SHIPPED
        try:
            self._file = PracticeFile.model_validate_json(chosen.read_bytes())
            self._names = checks.Names.of(self._file.vocabulary)
            for place, one in enumerate(self._file.exercises):
                self._check(one, ["exercises", place])
        except (OSError, ValidationError, errors.Unprocessable) as error:
            reason = str(error).partition("\n")[0]
            raise BadPractice(
                f"{chosen} has no practice queries: {reason}; `waypost practice` writes such a file."
            ) from None

    def _check(self, one: Exercise, at: errors.Location) -> None:
        checks.check_ask(one.ask, self._names, [*at, "ask"])
        scoring.check(one.ask, one.known, self._names, [*at, "known"])

    def questions(self) -> wire.Practice:
        """Return the queries without their known answers."""
        asks = [wire.PracticeQuery(id=place, ask=one.ask) for place, one in enumerate(self._file.exercises)]
        return wire.Practice(vocabulary=self._file.vocabulary, queries=asks)

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


async def practice_of(connection: HTTPConnection) -> PracticeSet:
    """Return the practice queries of the app that serves a request."""
    return cast(PracticeSet, connection.app.state.practice)


Exercises = Annotated[PracticeSet, Depends(practice_of)]
