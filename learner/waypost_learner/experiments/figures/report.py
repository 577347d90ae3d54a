"""Writes the report: one Markdown document with all tables and figures, and the commands that reproduce them."""

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from waypost_learner.experiments.figures import archive, tables
from waypost_learner.experiments.figures.data import Comparison

_INTRODUCTION = """\
`waypost figures` writes this document; do not edit it. Our numbers are medians over runs that differ only in the seed,
with the range in parentheses. Published numbers are medians of five runs, read from the authors' plots and logs
(`learner/waypost_learner/experiments/figures/published.py`). Success is the success rate over the trailing 100 test
episodes, each on an unseen instance unless the section says otherwise. A success rate is reached in the first episode
where the rate over a full 100 tests is at least as high. A median treats `never` as infinite. `docs/paper.md` explains
the deviations from the paper."""


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
        folder: the folder that contains the figures and the CSV files.
        comparisons: the groups with their runs, in the order of the document.
        figures: the names of the figures; each starts with the name of its group.
        commands: the commands that train the runs and draw the figures.
        missing: descriptions of the missing and unfinished runs.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    link = Path(os.path.relpath(folder, file.parent)).as_posix()
    lines = list(_lines(link, comparisons, figures, commands, missing))
    file.write_text("\n".join(lines), encoding="utf-8")


def _shown(commands: Sequence[str]) -> Iterator[str]:
    """Yield a block for each command: the first takes hours, the second does not."""
    for command in commands:
        yield from ("```sh", command, "```", "")


def _lines(
    link: str,
    comparisons: Sequence[Comparison],
    figures: Sequence[str],
    commands: Sequence[str],
    missing: Sequence[str],
) -> Iterator[str]:
    yield from ("# Results", "", _INTRODUCTION, "", *_shown(commands))
    yield f"[{archive.FILE}]({link}/{archive.FILE}) has one row per run and episode."
    yield from (f"[{tables.FILE}]({link}/{tables.FILE}) has the numbers of the tables.", "")
    if missing:
        yield from ("These runs are missing or unfinished. An unfinished run is drawn up to its last episode.", "")
        yield from (*(f"- {one}" for one in missing), "")
    for comparison in comparisons:
        group = comparison.group
        yield from (f"## {group.title[:1].upper()}{group.title[1:]}", "", group.counting, "")
        yield from tables.markdown(comparison)
        for name in figures:
            if name.startswith(f"{group.name}-"):
                yield from (f"![{name.replace('-', ' ')}]({link}/{name}.svg)", "")
