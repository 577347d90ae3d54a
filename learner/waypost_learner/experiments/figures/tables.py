"""Writes results as tables: a CSV file with one row per result, and Markdown tables with the published numbers."""

import csv
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path

from waypost_learner.experiments.figures.data import Comparison
from waypost_learner.experiments.figures.measures import Result, Unit, ratios, results, summary, topics
from waypost_learner.experiments.figures.published import NEVER
from waypost_learner.experiments.figures.statistics import Spread

FILE = "summary.csv"
_COLUMNS = ("group", "series", "measure", "unit", "median", "min", "max", "runs", "published")


def write_summary(folder: Path, comparisons: Sequence[Comparison]) -> Path:
    """Write `summary.csv` with one row per result, and return its path. `never` stands for an infinite value."""
    path = folder / FILE
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(_COLUMNS)
        rows.writerows(_row(result) for result in summary(comparisons))
    return path


def _row(result: Result) -> list[str]:
    ours = result.ours
    numbers = [ours.median, ours.low, ours.high] if ours else [None, None, None]
    runs = str(ours.runs if ours else 0)
    texts = [_plain(number) for number in numbers]
    return [result.group, result.series, result.measure, result.unit, *texts, runs, _plain(result.published)]


def _plain(value: float | None) -> str:
    if value is None:
        return ""
    return "never" if value == NEVER else f"{round(value, 4):g}" if abs(value) < 1_000 else f"{round(value, 1):.10g}"


def markdown(comparison: Comparison) -> Iterator[str]:
    """Yield the lines of a group's tables.

    Our numbers are "median (min to max)" over so many runs. The published numbers are in the row below.
    """
    for topic in topics(comparison):
        yield from (f"**{topic.title}**", "")
        yield from _table([measure.name for measure in topic.measures], list(results(comparison, topic)))
        yield ""
    found = list(ratios(comparison))
    if found:
        yield from ("**Ratios per seed**", "", "| | ours | published |", "|---|---|---|")
        for ratio in found:
            yield f"| {ratio.measure} | {_ours(ratio.ours, ratio.unit)} | {_number(ratio.published, ratio.unit)} |"
        yield ""


def _table(head: Sequence[str], found: Sequence[Result]) -> Iterator[str]:
    yield f"| | runs | {' | '.join(head)} |"
    yield "|---" * (len(head) + 2) + "|"
    for series, of in groupby(found, lambda result: result.series):
        row = list(of)
        runs = max((result.ours.runs for result in row if result.ours), default=0)
        yield f"| {series} | {runs} | {' | '.join(_ours(result.ours, result.unit) for result in row)} |"
        if any(result.published is not None for result in row):
            published = " | ".join(_number(result.published, result.unit) for result in row)
            yield f"| {series}, published | | {published} |"


def _ours(spread: Spread | None, unit: Unit) -> str:
    if spread is None:
        return ""
    median = _number(spread.median, unit)
    return (
        median if spread.low == spread.high else f"{median} ({_bare(spread.low, unit)} to {_bare(spread.high, unit)})"
    )


def _number(value: float | None, unit: Unit) -> str:
    if value is None:
        return ""
    text = _bare(value, unit)
    return f"{text} %" if unit == "%" and text != "never" else text


def _bare(value: float, unit: Unit) -> str:
    if value == NEVER:
        return "never"
    whole = abs(value - round(value)) < 0.05
    digits = {
        "%": 0 if whole else 1,
        "hours": 1,
        "minutes": 1,
        "": 2 if value < 100 else 0,
        "labels per 1,000 samples": 1,
    }.get(unit, 0)
    return f"{value:,.{digits}f}"
