"""Practice queries and worked examples: of files that `waypost practice` wrote, one for each domain, or of learners."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, cast

from fastapi import Depends
from pydantic import Field, ValidationError
from starlette.requests import HTTPConnection

from waypost import wire
from waypost_server import errors
from waypost_server.db.engine import Database
from waypost_server.db.transaction import Tx
from waypost_server.gold import sent_practice
from waypost_server.gold.exercises import Exercises
from waypost_server.queries import frames

SHIPPED = Path(__file__).with_name("practice.json")


class PracticeFile(wire.PracticePut):
    """The content of a file of practice queries."""

    vocabulary: wire.Vocabulary
    frames: list[wire.Frame] = Field(default_factory=list)  # of all states, for a domain without a renderer


class BadPractice(Exception):
    """The file cannot be used. The message says why and what to do."""


class PracticeSet(Exercises):
    """The practice queries of a file."""

    def __init__(self, path: Path, most_frame_bytes: int = 2**20, first: int = 0) -> None:
        """Read a file. A frame may have at most `most_frame_bytes`.

        Raises:
            BadPractice: with one sentence for the operator.
        """
        try:
            file = PracticeFile.model_validate_json(path.read_bytes())
            super().__init__(file.vocabulary, file, first)
            self.files = frames.decode(file.frames, most_frame_bytes)
            self.check([])
            if absent := set(self.frames()) - set(self.files):
                raise errors.Unprocessable(["frames"], f"frame {min(absent)} is not in the file")
        except (OSError, ValidationError, errors.Unprocessable) as error:
            reason = str(error).partition("\n")[0]
            raise BadPractice(
                f"{path} has no practice queries: {reason}; `waypost practice` writes such a file."
            ) from None
        self.domain = file.vocabulary.domain


class PracticeSets:
    """The practice queries of a server: those of its files, and those that learners sent."""

    def __init__(self, paths: Sequence[Path] = (), most_frame_bytes: int = 2**20) -> None:
        """Read the files, or the file in this package if there are none.

        Raises:
            BadPractice: with one sentence for the operator.
        """
        self._sets: dict[str, PracticeSet] = {}
        self.files: dict[str, bytes] = {}
        first = 0
        for path in paths or (SHIPPED,):
            one = PracticeSet(path, most_frame_bytes, first)
            if one.domain in self._sets:
                raise BadPractice(f"{path} is a second file of practice queries about {one.domain!r}; name only one.")
            self._sets[one.domain] = one
            self.files |= one.files
            first = one.ids.stop

    def questions(self, tx: Tx, domain: str | None = None) -> wire.Practice:
        """Return the queries of a domain, or of the first one. Where a domain has a file, only that one counts.

        Raises:
            NotFound: there are none for this domain.
        """
        sent = {name: number for name, number in sent_practice.numbers(tx).items() if name not in self._sets}
        domains = [*self._sets, *sent]
        name = domains[0] if domain is None else domain
        chosen = sent_practice.of_number(tx, sent[name]) if name in sent else self._sets.get(name)
        if chosen is None:
            raise errors.NotFound(f"There is no practice for {domain!r}, only for: {', '.join(domains)}.")
        return chosen.questions(domains)

    def mark(self, tx: Tx, query: int, answer: wire.Answer) -> wire.Feedback:
        """Score an answer.

        Raises:
            NotFound, Unprocessable: there is no such query, or the answer does not fit it.
        """
        of_file = next((one for one in self._sets.values() if query in one.ids), None)
        found = of_file or sent_practice.of_query(tx, query)
        if found is None:
            raise errors.NotFound(f"There is no practice query {query}.")
        return found.mark(query, answer)


async def open_practice(db: Database, paths: Sequence[Path], most_frame_bytes: int) -> PracticeSets:
    """Read the practice queries, and store their pictures, so that the web app finds them like those of a run.

    Raises:
        BadPractice: with one sentence for the operator.
    """
    practice = PracticeSets(paths, most_frame_bytes)
    if practice.files:
        await db.write(lambda tx: _keep(tx, practice.files))
    return practice


def _keep(tx: Tx, files: dict[str, bytes]) -> None:
    frames.store(tx, files)
    frames.pin(tx, files)


async def practice_of(connection: HTTPConnection) -> PracticeSets:
    """Return the practice queries of the app that serves a request."""
    return cast(PracticeSets, connection.app.state.practice)


Practice = Annotated[PracticeSets, Depends(practice_of)]
