"""Parquet: one file per part of a run, with a column for each fact, and JSON for queries and answers."""

import base64
import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
from pydantic import TypeAdapter, ValidationError

from waypost import wire
from waypost_learner.exchange.formats.jsonl import complaint

ROWS = 2_000  # in one row group; they are in memory until it is written
BYTES = 16 * 2**20  # of JSON and pictures in one row group, at most (but at least one row)
FIELDS = """\
`run.json` is the run. `queries.parquet` has one row per query, ordered by `episode` and `ordinal`. `ask` is the query
as the learner asked it, in JSON: kind, instance, segments with states and actions. `answer` is the answer that counts,
in JSON. `annotator`, `units`, `seconds`, `active_seconds`, `answered_at`, `leased_at`, `expires_at`, `ended_at`,
`deferring`, `reason` and `revision` belong to this answer; all are null if there is none. `earlier` has all other
assignments in JSON (skipped, expired, retracted or late). `ledger.parquet` has one row per charge or refund in the
order of their booking, `episodes.parquet` one row per episode, `frames.parquet` the pictures (PNG) by SHA-256. Times
are in seconds since the epoch."""

_RECORDS: Mapping[str, TypeAdapter[Any]] = {
    "frame": TypeAdapter(wire.FrameRecord),
    "query": TypeAdapter(wire.QueryRecord),
    "ledger": TypeAdapter(wire.LedgerRecord),
    "episode": TypeAdapter(wire.EpisodeRecord),
}
_TEXT, _REAL, _WHOLE, _TRUTH = pa.string(), pa.float64(), pa.int64(), pa.bool_()
_HELD = {
    "annotator": _TEXT,
    "deferring": _TRUTH,
    "reason": _TEXT,
    "leased_at": _REAL,
    "expires_at": _REAL,
    "ended_at": _REAL,
}
_GIVEN = {"revision": _WHOLE, "units": _REAL, "seconds": _REAL, "active_seconds": _REAL}
_QUERY = {
    "episode": _WHOLE,
    "ordinal": _WHOLE,
    "kind": _TEXT,
    "state": _TEXT,
    "priority": _WHOLE,
    "used": _TRUTH,
    "created_at": _REAL,
    "ask": _TEXT,
    "answer": _TEXT,
    **_HELD,
    **_GIVEN,
    "answered_at": _REAL,
    "earlier": _TEXT,
}
_LEDGER = {
    "entry": _TEXT,
    "kind": _TEXT,
    "episode": _WHOLE,
    "ordinal": _WHOLE,
    "revision": _WHOLE,
    **dict.fromkeys(("units", "lo_units", "seconds", "active_seconds", "at"), _REAL),
}
_EPISODE = {
    "episode": _WHOLE,
    **dict.fromkeys(("warm_start", "train_success", "test_success"), _TRUTH),
    **dict.fromkeys(("train_steps", "test_steps", "hi_labels", "lo_labels"), _WHOLE),
    **dict.fromkeys(("reward", "seconds", "at"), _REAL),
    "attempts": pa.list_(pa.struct([("subgoal", _TEXT), ("reached", _TRUTH)])),
}
_FILES: Mapping[str, tuple[str, pa.Schema]] = {
    # In the order in which another store takes them in.
    "frame": ("frames.parquet", pa.schema({"hash": _TEXT, "png": pa.binary()})),
    "query": ("queries.parquet", pa.schema(_QUERY)),
    "ledger": ("ledger.parquet", pa.schema(_LEDGER)),
    "episode": ("episodes.parquet", pa.schema(_EPISODE)),
}


def write(records: Iterable[wire.Record], folder: Path) -> None:
    """Write all records of a run to `run.json` and one Parquet file per kind of record."""
    with ExitStack() as stack:
        tables = {kind: stack.enter_context(_Table(folder / name, schema)) for kind, (name, schema) in _FILES.items()}
        for record in records:
            match record:
                case wire.RunRecord():
                    (folder / "run.json").write_text(record.model_dump_json() + "\n", encoding="utf-8")
                case wire.FrameRecord(frame=frame):
                    tables["frame"].add({"hash": frame.hash, "png": base64.b64decode(frame.png)})
                case wire.QueryRecord():
                    tables["query"].add(_query_row(record))
                case wire.LedgerRecord():
                    tables["ledger"].add(record.model_dump(exclude={"record"}))
                case wire.EpisodeRecord():
                    tables["episode"].add({**record.result.model_dump(), "at": record.at})


def read(folder: Path) -> Iterator[wire.Record]:
    """Yield the records of a folder that `write` wrote.

    Raises:
        ValueError: a file is missing or is not valid; the message names the file and the row.
    """
    missing = [name for name in ("run.json", *(name for name, _ in _FILES.values())) if not (folder / name).is_file()]
    if missing:
        raise ValueError(f"{folder} is not a complete export: it has no {missing[0]}")
    try:
        yield wire.RunRecord.model_validate_json((folder / "run.json").read_bytes())
    except ValidationError as error:
        raise ValueError(f"{folder / 'run.json'}: {complaint(error)}") from error
    for kind, (name, _) in _FILES.items():
        for number, row in enumerate(_rows(folder / name)):
            try:
                yield _RECORDS[kind].validate_python(_OF_ROW[kind](row))
            except (ValidationError, KeyError, TypeError, json.JSONDecodeError) as error:
                reason = complaint(error) if isinstance(error, ValidationError) else repr(error)
                raise ValueError(f"{folder / name}, row {number}: {reason}") from error


class _Table:
    """A Parquet file that is written in row groups of limited size."""

    def __init__(self, file: Path, schema: pa.Schema) -> None:
        self._file = pq.ParquetWriter(file, schema, compression="zstd")
        self._schema = schema
        self._rows: list[dict[str, Any]] = []
        self._bytes = 0

    def __enter__(self) -> "_Table":
        return self

    def __exit__(self, *_: object) -> None:
        self._flush()
        self._file.close()

    def add(self, row: dict[str, Any]) -> None:
        """Append a row."""
        self._rows.append(row)
        self._bytes += sum(len(value) for value in row.values() if isinstance(value, str | bytes))
        if len(self._rows) == ROWS or self._bytes >= BYTES:
            self._flush()

    def _flush(self) -> None:
        if self._rows:
            self._file.write_table(pa.Table.from_pylist(self._rows, self._schema))
            self._rows, self._bytes = [], 0


def _rows(file: Path) -> Iterator[dict[str, Any]]:
    try:
        with pq.ParquetFile(file) as opened:
            for batch in opened.iter_batches(batch_size=200):
                yield from batch.to_pylist()
    except pa.ArrowException as error:
        raise ValueError(f"{file} is no Parquet file of an export: {error}") from error


def _query_row(record: wire.QueryRecord) -> dict[str, Any]:
    row: dict[str, Any] = {
        "episode": record.ask.episode,
        "ordinal": record.ask.ordinal,
        "kind": record.ask.kind,
        **record.model_dump(include={"state", "priority", "used", "created_at"}),
        "ask": record.ask.model_dump_json(),
        "earlier": _json([one.model_dump(mode="json") for one in record.earlier]),
    }
    if record.answered is not None and record.answered.answer is not None:
        held, given = record.answered, record.answered.answer
        row |= held.model_dump(include=set(_HELD)) | given.model_dump(include=set(_GIVEN))
        row |= {"answer": given.content.model_dump_json(), "answered_at": given.at}
    return row


def _query_of(row: Mapping[str, Any]) -> dict[str, Any]:
    answered = None
    if row["answer"] is not None:
        given = {name: row[name] for name in _GIVEN} | {"content": json.loads(row["answer"]), "at": row["answered_at"]}
        answered = {name: row[name] for name in _HELD} | {"state": "answered", "answer": given}
    return {
        **{name: row[name] for name in ("state", "priority", "used", "created_at")},
        "ask": json.loads(row["ask"]),
        "answered": answered,
        "earlier": json.loads(row["earlier"]),
    }


def _episode_of(row: Mapping[str, Any]) -> dict[str, Any]:
    return {"result": {name: value for name, value in row.items() if name != "at"}, "at": row["at"]}


_OF_ROW: Mapping[str, Callable[[Mapping[str, Any]], dict[str, Any]]] = {
    "frame": lambda row: {"frame": {"hash": row["hash"], "png": base64.b64encode(row["png"]).decode()}},
    "query": _query_of,
    "ledger": dict,
    "episode": _episode_of,
}


def _json(value: Any) -> str:
    return json.dumps(value, separators=(",", ":"))
