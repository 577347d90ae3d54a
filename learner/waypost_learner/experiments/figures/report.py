"""The report: tables and figures in one Markdown document, with the commands that make them again."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from waypost_learner.experiments.figures import archive, tables
from waypost_learner.experiments.figures.data import Comparison

_INTRODUCTION = """\
Written by `waypost figures`; do not edit. Ours is the median over runs that differ by seed alone, with their range;
the published numbers are medians of five, read off the authors' plots
(`learner/experiments/figures/published.py`). Success is the rate over the trailing 100 test episodes, each on an
unseen maze; a level is reached when the rate over a full hundred is. `never` counts as infinite in a median. What
differs from the paper, and why: `docs/paper.md`."""


def write(
    file: Path,
    folder: Path,
    comparisons: Sequence[Comparison],
    figures: Sequence[str],
    commands: Sequence[str],
    missing: Sequence[str],
) -> None:
    """Write the report.

    Args:
        file: the document.
        folder: where the figures are.
        comparisons: what was compared.
        figures: the names of the figures, each beginning with its group's.
        commands: what makes the runs, and what draws them.
        missing: the runs that are not there, or not whole.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    beside = Path(os.path.relpath(folder, file.parent)).as_posix()
    lines = list(_lines(beside, comparisons, figures, commands, missing))
    file.write_text("\n".join(lines), encoding="utf-8")


def _lines(
    beside: str,
    comparisons: Sequence[Comparison],
    figures: Sequence[str],
    commands: Sequence[str],
    missing: Sequence[str],
) -> Iterator[str]:
    yield from ("# Results", "", _INTRODUCTION, "", "```sh", *commands, "```", "")
    yield f"Every row of every run is in [{archive.FILE}]({beside}/{archive.FILE}), the numbers of the tables in"
    yield from (f"[{tables.FILE}]({beside}/{tables.FILE}).", "")
    if missing:
        yield from ("Missing, or unfinished and drawn as far as they are:", "")
        yield from (*(f"- {one}" for one in missing), "")
    for comparison in comparisons:
        group = comparison.group
        yield from (f"## {group.title[:1].upper()}{group.title[1:]}", "", group.counting, "")
        yield from tables.markdown(comparison)
        for name in figures:
            if name.startswith(f"{group.name}-"):
                yield from (f"![{name.replace('-', ' ')}]({beside}/{name}.svg)", "")
