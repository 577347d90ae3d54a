"""Finds the records in an exported folder or file."""

from collections.abc import Iterator
from pathlib import Path

from waypost import wire
from waypost_learner.exchange.formats import jsonl


def records_in(path: Path) -> Iterator[wire.Record]:
    """Return the records of an export in the format jsonl or parquet.

    Args:
        path: the folder that `waypost export` wrote, or a file of JSON Lines.

    Raises:
        ValueError: there is no such export; while iterating: a record is not valid, and the message says where.
    """
    if path.is_file():
        return jsonl.read(path)
    if (path / jsonl.FILE).is_file():
        return jsonl.read(path / jsonl.FILE)
    if (path / "run.json").is_file():
        from waypost_learner.exchange.formats import parquet  # an extra, which only this format needs

        return parquet.read(path)
    if not path.exists():
        raise ValueError(f"there is no export {path}")
    raise ValueError(f"{path} has no run.jsonl and no run.json; only exports as jsonl or parquet can be imported")
