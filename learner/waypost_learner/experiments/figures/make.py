"""Does the work of `waypost figures`: merges the runs of several sources, lists the missing ones, writes all files."""

import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from waypost_learner.experiments import plan
from waypost_learner.experiments.figures import archive, draw, report, tables
from waypost_learner.experiments.figures.data import Comparison, RunCurves
from waypost_learner.experiments.plan.series import Group
from waypost_learner.runs.config import TrainConfig

Found = Mapping[TrainConfig, RunCurves]


@dataclass(frozen=True)
class Request:
    """The options of `waypost figures`.

    Args:
        figure: a name in `plan.FIGURES`.
        seeds: the seeds of every series.
        out: the folder for figures and tables.
        report: the Markdown document to write; None for no document.
        store: the store named in the printed `waypost sweep` command.
        archives: the `--from` folders named in that command; it does not train their runs again.
    """

    figure: str
    seeds: tuple[int, ...]
    out: Path
    report: Path | None = None
    store: str = "runs.db"
    archives: tuple[Path, ...] = ()

    @property
    def groups(self) -> list[Group]:
        """The groups to draw.

        Raises:
            ValueError: no figure has this name.
        """
        return plan.find_figure(self.figure)

    @property
    def wanted(self) -> list[TrainConfig]:
        """The configurations of all runs that the figure needs."""
        return plan.runs_of(self.groups, self.seeds)


def merge(sources: Iterable[Found]) -> Found:
    """Return the runs of all sources. If several have a run, take the one with most episodes, else the first."""
    merged: dict[TrainConfig, RunCurves] = {}
    for source in sources:
        for config, run in source.items():
            if config not in merged or len(run.episode) > len(merged[config].episode):
                merged[config] = run
    return merged


def missing(request: Request, found: Found) -> list[TrainConfig]:
    """Return the needed runs that are missing or incomplete."""
    return [config for config in request.wanted if config not in found or not found[config].complete]


def describe(runs: Sequence[TrainConfig], found: Found) -> list[str]:
    """Return the names of missing runs, with their numbers of finished episodes; seeds that are equally far as one."""
    seeds: dict[tuple[str, str], list[int]] = {}
    for config in runs:
        run = found.get(config)
        how_far = "not started" if run is None else f"{len(run.episode)} of {config.episodes} episodes"
        seeds.setdefault((plan.name_without_seed(config), how_far), []).append(config.seed)
    return [
        f"{name}, seed{'s' * (len(some) > 1)} {', '.join(map(str, some))}, {how_far}"
        for (name, how_far), some in seeds.items()
    ]


def missing_command(request: Request, runs: Sequence[TrainConfig]) -> str:
    """Return the `waypost sweep` command that trains these runs of a figure, except those in an archive."""
    archives = [word for folder in request.archives for word in ("--from", str(folder))]
    return shlex.join([*_sweep(request, runs), *archives, "--store", request.store])


def make(request: Request, found: Found) -> dict[str, Any]:
    """Draw all figures that have runs, write the tables, and return a summary as JSON data.

    Raises:
        ValueError: no run exists, or a file cannot be written.
    """
    comparisons = [Comparison.of(group, request.seeds, found) for group in request.groups]
    comparisons = [comparison for comparison in comparisons if comparison.runs]
    if not comparisons:
        raise ValueError("none of the runs exists, so there is nothing to draw")
    lacking = describe(missing(request, found), found)
    try:
        files = _write(request, comparisons, found, lacking)
    except OSError as error:
        raise ValueError(f"cannot write {error.filename}: {error.strerror}") from None
    runs = sum(config in found for config in request.wanted)
    return {"figure": request.figure, "runs": runs, "missing": lacking, "files": [str(file) for file in files]}


def _write(request: Request, comparisons: Sequence[Comparison], found: Found, lacking: Sequence[str]) -> list[Path]:
    request.out.mkdir(parents=True, exist_ok=True)
    runs = [found[config] for config in request.wanted if config in found]
    files = [archive.write(request.out, runs), tables.write_summary(request.out, comparisons)]
    names = []
    for comparison in comparisons:
        for name, figure in draw.figures_of(comparison):
            names.append(name)
            files += draw.save(figure, request.out, name)
    if request.report is not None:
        commands = [
            shlex.join([*_sweep(request, request.wanted), "--store", _shown(Path(request.store))]),
            _own_command(request, request.report, partial=bool(lacking)),
        ]
        report.write(request.report, request.out, comparisons, names, commands, lacking)
        files.append(request.report)
    return files


def _sweep(request: Request, runs: Sequence[TrainConfig]) -> list[str]:
    return ["waypost", "sweep", "--figure", request.figure, "--seeds", _joined(sorted({run.seed for run in runs}))]


def _own_command(request: Request, report: Path, partial: bool) -> str:
    """Return the `waypost figures` command that draws the same figures from the written archive."""
    words = ["waypost", "figures", "--figure", request.figure, "--seeds", _joined(request.seeds)]
    words += ["--from", _shown(request.out), "--out", _shown(request.out), "--report", _shown(report)]
    return shlex.join([*words, *(["--partial"] if partial else [])])


def _joined(seeds: Iterable[int]) -> str:
    return ",".join(map(str, seeds))


def _shown(path: Path) -> str:
    """Return a path for another machine: relative to the working folder if inside it, else only the file name."""
    path = path.resolve()
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path.name)
