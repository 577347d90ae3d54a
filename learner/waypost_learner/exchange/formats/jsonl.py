"""JSON Lines: one record per line, in the order in which another store takes them in."""

from collections.abc import Iterable, Iterator
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from waypost import wire

FILE = "run.jsonl"
FIELDS = """\
`run.jsonl` has one record per line; `record` names its kind. The first line is the `run`. Then come the `query`
records, ordered by episode and ordinal. A `frame` (a picture, as a PNG in base64) comes before the first query that
shows it. The `ledger` entries follow in the order of their booking, and the `episode` results at the end.

A `query` has the query as the learner asked it (`ask`: kind, instance, segments with states and actions), the
assignment with the answer that counts (`answered`: annotator, times, units, seconds), and all other assignments
(`earlier`: skipped, expired, retracted or late)."""

_RECORD: TypeAdapter[wire.Record] = TypeAdapter(wire.Record)


def write(records: Iterable[wire.Record], folder: Path) -> None:
    """Write all records of a run to `run.jsonl`."""
    with (folder / FILE).open("w", encoding="utf-8", newline="\n") as file:
        for record in records:
            file.write(record.model_dump_json() + "\n")


def read(file: Path) -> Iterator[wire.Record]:
    """Yield the records of a file.

    Raises:
        ValueError: a line is no record; the message names the line.
    """
    with file.open("rb") as lines:
        for number, line in enumerate(lines, 1):
            try:
                yield _RECORD.validate_json(line)
            except ValidationError as error:
                raise ValueError(f"{file}, line {number}: {complaint(error)}") from error


def complaint(error: ValidationError) -> str:
    """Return the first thing that is wrong with a record, in a few words."""
    first = error.errors(include_url=False, include_input=False)[0]
    place = ".".join(str(part) for part in first["loc"])
    return f"{place}: {first['msg']}" if place else str(first["msg"])
