"""Reads and writes `runs.csv.gz`, which has one row per run and episode. All figures can be drawn from this file."""

import csv
import gzip
import io
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import fields
from itertools import groupby
from pathlib import Path
from typing import Any, get_type_hints

import numpy as np

from waypost_learner.experiments.figures.data import KINDS, Column, RunCurves
from waypost_learner.runs.config import TrainConfig

FILE = "runs.csv.gz"

_CONFIG = tuple(field.name for field in fields(TrainConfig))
_CURVES = ("episode", "test_success", "success_rate", "hi_labels", "lo_samples", "learner_seconds", "lo_cost")
COLUMNS = (*_CONFIG, *_CURVES, *KINDS)
"""The configuration, the learner's reports, and the cost in units by kind of query. Missing values are empty fields.

Runs with subgoals that Q-functions learn have two kinds of columns more: `reward`, and `reached SUBGOAL` by subgoal.
"""
_REWARD, _REACHED = "reward", "reached "


def write(folder: Path, runs: Iterable[RunCurves]) -> Path:
    """Write `runs.csv.gz` into `folder` and return its path. The same runs give the same file."""
    text, runs = io.StringIO(), list(runs)
    subgoals = sorted({subgoal for run in runs for subgoal in run.reached})
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow([*COLUMNS, *([_REWARD] if subgoals else []), *(f"{_REACHED}{subgoal}" for subgoal in subgoals)])
    for run in runs:
        config = [_written(getattr(run.config, name)) for name in _CONFIG]
        numbers = [*(getattr(run, name) for name in _CURVES), *(run.units[kind] for kind in KINDS)]
        if subgoals:
            unknown = np.full(len(run.episode), np.nan)
            numbers += [run.reward, *(run.reached.get(subgoal, unknown) for subgoal in subgoals)]
        rows.writerows([*config, *map(_number, row)] for row in zip(*numbers, strict=True))
    path = folder / FILE
    with path.open("wb") as file, gzip.GzipFile("", "wb", 9, file, mtime=0) as packed:  # without name and time
        packed.write(text.getvalue().encode())
    return path


def read(folder: Path) -> dict[TrainConfig, RunCurves]:
    """Return the runs in `runs.csv.gz` of `folder`.

    Raises:
        ValueError: the file does not exist or is not valid; the message names the column or line.
    """
    path = folder / FILE
    if not path.is_file():
        raise ValueError(f"there is no {FILE} in {folder}")
    try:
        with gzip.open(path, "rt", newline="", encoding="utf-8") as file:
            rows = csv.reader(file)
            header = next(rows, [])
            _check_header(path, header)
            parsed = _parsed(path, header, rows)
            return {config: _curves(config, [row for _, row in of]) for config, of in groupby(parsed, lambda r: r[0])}
    except (OSError, EOFError, UnicodeDecodeError) as error:
        raise ValueError(f"{path} cannot be read: {error}") from None


def _check_header(path: Path, header: list[str]) -> None:
    known = {*COLUMNS, _REWARD, *(name for name in header if name.startswith(_REACHED))}
    unknown = [name for name in header if name not in known]
    if unknown:  # a newer version may have added a configuration value: ignoring it would merge different runs
        raise ValueError(f"{path} has a column {unknown[0]!r}, which this version of Waypost does not know")
    lacking = [name for name in (*_CURVES, *KINDS, "algorithm") if name not in header]
    if lacking:
        raise ValueError(f"{path} has no column {lacking[0]!r}")


def _parsed(path: Path, header: list[str], rows: Iterator[list[str]]) -> Iterator[tuple[TrainConfig, dict[str, float]]]:
    numbers = [name for name in header if name not in _CONFIG]
    configs: dict[tuple[str, ...], TrainConfig] = {}
    for line, row in enumerate(rows, start=2):
        if len(row) != len(header):
            raise ValueError(f"{path}, line {line}: has {len(row)} fields; the header has {len(header)}")
        by_name = dict(zip(header, row, strict=True))
        given = {name: by_name[name] for name in _CONFIG if name in by_name}
        key = tuple(given.values())
        try:
            if key not in configs:
                configs[key] = TrainConfig(**{name: _READ[name](text) for name, text in given.items()})
            values = {name: float(by_name[name] or "nan") for name in numbers}
        except ValueError as error:
            raise ValueError(f"{path}, line {line}: {error}") from None
        yield configs[key], values


def _curves(config: TrainConfig, rows: list[Mapping[str, float]]) -> RunCurves:
    def column(name: str) -> Column:
        return np.array([row[name] for row in rows], np.float64)

    curves = {name: column(name) for name in _CURVES}
    reached = {name.removeprefix(_REACHED): column(name) for name in rows[0] if name.startswith(_REACHED)}
    return RunCurves(
        config=config,
        **curves,
        units={kind: column(kind) for kind in KINDS},
        reward=column(_REWARD) if _REWARD in rows[0] else np.full(len(rows), np.nan),
        reached={subgoal: rates for subgoal, rates in reached.items() if not np.isnan(rates).all()},
    )


# --- values as text


def _number(value: float) -> str:
    """Return the shortest text that reads back as the same number."""
    if np.isnan(value):
        return ""
    return str(int(value)) if value == int(value) else repr(float(value))


def _written(value: Any) -> str:
    return "" if value is None else str(value)


def _reader(hint: Any) -> Callable[[str], Any]:
    """Return a function that reads a value of a type from its text; for an optional type, "" gives None."""

    def read_truth(text: str) -> bool:
        if text not in {"True", "False"}:
            raise ValueError(f"{text!r} is neither True nor False")
        return text == "True"

    readers: dict[Any, Callable[[str], Any]] = {
        str: str,
        int: int,
        float: float,
        bool: read_truth,
        str | None: lambda text: text or None,
        int | None: lambda text: int(text) if text else None,
        float | None: lambda text: float(text) if text else None,
    }
    return readers[hint]


_READ = {name: _reader(hint) for name, hint in get_type_hints(TrainConfig).items()}
