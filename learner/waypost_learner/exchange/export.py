"""Writes a run to a folder in one of the formats, with its data card. Records stream, so memory does not grow."""

import shutil
from collections.abc import Callable, Iterable
from importlib import import_module
from pathlib import Path

from waypost import wire
from waypost_learner.exchange.card import FILE as CARD
from waypost_learner.exchange.card import card
from waypost_learner.exchange.source import Source, records_of
from waypost_learner.exchange.tally import Tally

FORMATS = ("jsonl", "lerobot", "minari", "parquet")

Write = Callable[[Iterable[wire.Record], Path], None]


def export(source: Source, run: str, form: str, out: Path, names: bool, command: str) -> Tally:
    """Write a run to a new folder, and return the sums over its records.

    The folder gets its name when it is complete, so an interrupted export leaves nothing that looks like one.

    Args:
        source: the source of the run.
        run: the run's id.
        form: one of `FORMATS`.
        out: the folder; it must not exist.
        names: whether annotators keep their names; otherwise they get pseudonyms.
        command: the command line, for the data card.

    Raises:
        ValueError: the format is unknown or needs a package that is not installed, the folder exists, there is no such
            run, or the format cannot express it.
    """
    if form not in FORMATS:
        raise ValueError(f"there is no format {form!r}; the formats are: {', '.join(FORMATS)}")
    try:
        module = import_module(f"waypost_learner.exchange.formats.{form}")
    except ImportError as error:
        raise ValueError(
            f"the format {form} needs a package ({error}): install it with `pip install 'waypost[learner,{form}]'`"
        ) from error
    write: Write = module.write
    if out.exists():
        raise ValueError(f"{out} exists; give --out a folder that does not exist")
    tally, partial = Tally(), out.with_name(f"{out.name}.partial")
    shutil.rmtree(partial, ignore_errors=True)
    try:
        partial.mkdir(parents=True)
        records = tally.count(records_of(source, run, names))
        write(records, partial)
        for _ in records:
            pass  # a format that uses only the first records must not change the sums on the card
        (partial / CARD).write_text(card(tally, form, module.FIELDS, command, names), encoding="utf-8")
        partial.rename(out)
    finally:
        shutil.rmtree(partial, ignore_errors=True)
    return tally
