"""`waypost figures`: runs are gathered, what is missing is named, and all that can be drawn is drawn."""

import shlex
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from waypost_learner.experiments import plan
from waypost_learner.experiments.figures import archive, draw, report, tables
from waypost_learner.experiments.figures.data import Comparison, RunCurves
from waypost_learner.runs.config import TrainConfig

Found = Mapping[TrainConfig, RunCurves]


@dataclass(frozen=True)
class Request:
    """What is drawn, and where it goes.

    Args:
        figure: what `--figure` can name.
        seeds: a run of each series with each.
        out: the folder for figures and tables.
        report: the Markdown document to write; none if None.
        store: the store to name in the command that makes the runs.
        archives: the folders to name in it, whose runs need not be made.
    """

    figure: str
    seeds: tuple[int, ...]
    out: Path
    report: Path | None = None
    store: str = "runs.db"
    archives: tuple[Path, ...] = ()

    @property
    def groups(self) -> list[plan.Group]:
        """The groups to draw.

        Raises:
            ValueError: there is no figure of that name.
        """
        return plan.find_figure(self.figure)

    @property
    def wanted(self) -> list[TrainConfig]:
        """Every run there should be."""
        return plan.runs_of(self.groups, self.seeds)


def merge(sources: Iterable[Found]) -> Found:
    """Return the runs of several sources; of one that several have, what got furthest, or what came first."""
    merged: dict[TrainConfig, RunCurves] = {}
    for source in sources:
        for config, run in source.items():
            if config not in merged or len(run.episode) > len(merged[config].episode):
                merged[config] = run
    return merged


def missing(request: Request, found: Found) -> list[TrainConfig]:
    """Return the wanted runs that are not there, or not whole."""
    return [config for config in request.wanted if config not in found or not found[config].complete]


def describe(config: TrainConfig, found: Found) -> str:
    """Name a missing run by what tells it from the others of the plan, and how far it is."""
    run = found.get(config)
    return ", ".join(
        [
            config.algorithm,
            config.instances,
            *(["redraw"] if config.redraw else []),
            *([] if config.head_start is None else [f"head start {config.head_start:.0%}"]),
            *([] if config.preset == "paper" else [config.preset]),
            *([] if config.values is None else [config.values]),
            f"seed {config.seed}",
            "not begun" if run is None else f"{len(run.episode)} of {config.episodes} episodes",
        ]
    )


def missing_command(request: Request, runs: Sequence[TrainConfig]) -> str:
    """Return the command that makes these runs of a figure, and none that an archive has."""
    archives = [word for folder in request.archives for word in ("--from", str(folder))]
    return shlex.join([*_sweep(request, runs), *archives, "--store", request.store])


def make(request: Request, found: Found) -> dict[str, Any]:
    """Draw what can be drawn and return what was written.

    Raises:
        ValueError: none of the runs is there, or a file cannot be written.
    """
    comparisons = [Comparison.of(group, request.seeds, found) for group in request.groups]
    comparisons = [comparison for comparison in comparisons if comparison.runs]
    if not comparisons:
        raise ValueError("none of the runs is there, so there is nothing to draw")
    lacking = [describe(config, found) for config in missing(request, found)]
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
    """Return the command that draws all this again from the CSV it wrote."""
    words = ["waypost", "figures", "--figure", request.figure, "--seeds", _joined(request.seeds)]
    words += ["--from", _shown(request.out), "--out", _shown(request.out), "--report", _shown(report)]
    return shlex.join([*words, *(["--partial"] if partial else [])])


def _joined(seeds: Iterable[int]) -> str:
    return ",".join(map(str, seeds))


def _shown(path: Path) -> str:
    """Return a path as somebody else can type it: below the working folder, or its name alone."""
    path = path.resolve()
    return str(path.relative_to(Path.cwd()) if path.is_relative_to(Path.cwd()) else path.name)
