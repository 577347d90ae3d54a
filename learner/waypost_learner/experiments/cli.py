"""The commands `waypost figures`, `waypost sweep` and `waypost theory`.

The module imports quickly: each command imports the packages that it needs when it runs.
"""

import json
import os
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer
from rich.console import Console
from rich.progress import TaskID

from waypost_learner.commands import (
    JsonOption,
    PatienceOption,
    ServerOption,
    TokenOption,
    checkpoint_folder,
    learner_errors,
    needed,
    progress_bar,
    refuse,
)

if TYPE_CHECKING:
    from waypost_learner.experiments.sweep import Progress

app = typer.Typer()

SeedsOption = Annotated[str, typer.Option(help="The seeds, separated by commas.")]


@app.command()
def figures(
    store: Annotated[Path | None, typer.Option("--store", help="The SQLite file that contains the runs.")] = None,
    server: ServerOption = None,
    token: TokenOption = "",
    archives: Annotated[
        list[Path] | None, typer.Option("--from", help="A folder that contains runs.csv.gz; can be repeated.")
    ] = None,
    figure: Annotated[
        str, typer.Option(help="A figure (maze, options, lean or montezuma), or one group of it.")
    ] = "maze",
    seeds: SeedsOption = "0,1,2,3,4",
    out: Annotated[Path, typer.Option(help="The folder for figures and tables.")] = Path("docs/results"),
    report: Annotated[Path | None, typer.Option(help="Write a Markdown document with all figures and tables.")] = None,
    partial: Annotated[
        bool, typer.Option("--partial", help="Draw the existing runs even if some are missing.")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """Draw figures and write tables from stored runs, and compare them with the published numbers."""
    if store is not None and server is not None:
        refuse("A server has its own store: give either --server or --store.")
    if store is None and server is None and not archives:
        refuse("Give the source of the runs: --store FILE, --server URL, or --from FOLDER with a runs.csv.gz.")
    with learner_errors():
        from waypost_learner.experiments.figures import archive, make
        from waypost_learner.experiments.figures import store as stores
        from waypost_learner.remote.embedded import stored_runs

        name = str(store) if store is not None else "runs.db"
        request = make.Request(figure, parse_seeds(seeds), out, report, name, tuple(archives or ()))
        wanted = request.wanted
        with ExitStack() as stack:
            stack.enter_context(Console(stderr=True).status("Reading runs."))
            sources = [archive.read(folder) for folder in archives or []]
            if store is not None:
                sources.insert(0, stores.read(stack.enter_context(stored_runs(store)), wanted))
            if server is not None:
                client = stack.enter_context(stores.served(server, needed(token)))
                sources.insert(0, stores.read(client, wanted))
        found = make.merge(sources)
        missing = make.missing(request, found)
        if missing and not partial:
            _refuse_missing(make.describe(missing, found), make.missing_command(request, missing))
        with Console(stderr=True).status("Drawing."):
            done = make.make(request, found)
    typer.echo(json.dumps(done) if as_json else "\n".join(done["files"]))


@app.command()
def sweep(
    figure: Annotated[
        str, typer.Option(help="A figure (maze, options, lean or montezuma), or one group of it.")
    ] = "maze",
    seeds: SeedsOption = "0,1,2,3,4",
    store: Annotated[
        Path | None, typer.Option("--store", help="An SQLite file; it is created if it does not exist.")
    ] = None,
    server: ServerOption = None,
    token: TokenOption = "",
    archives: Annotated[
        list[Path] | None,
        typer.Option("--from", help="A folder that contains runs.csv.gz; complete runs in it are not trained again."),
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="How many runs train at once. Default: the number of processor cores.")
    ] = None,
    ray: Annotated[str | None, typer.Option(help="The address of a Ray cluster to run on, or auto.")] = None,
    episodes: Annotated[int | None, typer.Option(min=1, help="Episodes per run, instead of the figure's.")] = None,
    preset: Annotated[str | None, typer.Option(help="The preset of all runs, instead of the figure's.")] = None,
    checkpoints: Annotated[
        Path | None, typer.Option(help="The folder for checkpoints. Default: beside the store.")
    ] = None,
    patience: PatienceOption = 300.0,
    as_json: JsonOption = False,
) -> None:
    """Train the runs of a figure that are not finished yet. After an interruption, the same command continues."""
    if store is not None and server is not None:
        refuse("A server has its own store: give either --server or --store.")
    with learner_errors("Interrupted. The same command continues and trains no run twice."):
        from waypost_learner.experiments import plan
        from waypost_learner.experiments import sweep as sweeping
        from waypost_learner.experiments.figures import archive
        from waypost_learner.runs.setup import set_up

        runs = plan.runs_of(plan.find_figure(figure), parse_seeds(seeds))
        runs = [replace(run, episodes=episodes or run.episodes, preset=preset or run.preset) for run in runs]
        set_up(runs[0], threads=1)  # reports wrong options before a store is created
        there = {config for folder in archives or [] for config, run in archive.read(folder).items() if run.complete}
        todo = [run for run in runs if run not in there]
        place = sweeping.Place(
            checkpoint_folder(checkpoints, store, server),
            None if server else store or Path("waypost.db"),
            server or "",
            needed(token) if server else "",
            patience,
        )
        with SweepProgress(len(todo), sum(run.episodes for run in todo)) as progress:
            troubles = sweeping.sweep(todo, place, jobs or os.cpu_count() or 1, ray, progress.show)
    for name, trouble in troubles.items():
        typer.echo(f"{name}: {trouble}", err=True)
    done = f"{len(there & set(runs)) + len(todo) - len(troubles)} of {len(runs)} runs are finished."
    typer.echo(json.dumps({"runs": len(runs), "failed": troubles}) if as_json else done)
    if troubles:
        raise typer.Exit(1)


@app.command()
def theory(
    seeds: Annotated[int, typer.Option(min=1, help="The number of seeds in each cell of the grid.")] = 5,
    rounds: Annotated[int, typer.Option(min=1, help="T, the number of episodes of each learner.")] = 100,
    out: Annotated[Path | None, typer.Option(help="A folder for theory.csv, theory.svg and theory.png.")] = None,
    as_json: JsonOption = False,
) -> None:
    """Compare the cost of hg-DAgger and flat DAgger, simulated with halving learners, with Theorems 1 and 2."""
    if out is not None:
        try:
            out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            refuse(f"Cannot write to the folder {out}: {error.strerror}.")
    with learner_errors():
        from waypost_learner.experiments.theory import grid, report

        with progress_bar() as bar:
            task = bar.add_task("cells", total=len(grid.GRID) * len(grid.EPISODES))
            rows = grid.measure(grid.GRID, seeds, rounds, lambda: bar.advance(task))
        if out is not None:
            from waypost_learner.experiments.theory import draw

            draw.save(rows, out)
            grid.write_csv(rows, out / "theory.csv")
        if as_json:
            cells = [row.values() for row in rows]
            typer.echo(json.dumps({"seeds": seeds, "rounds": rounds, "worst": grid.worst(rows), "cells": cells}))
        else:
            typer.echo("\n".join(report.table(rows, seeds, rounds)))


# --- helpers of the commands


class SweepProgress:
    """A progress bar over the episodes of all runs, with the remaining time. Without a terminal it shows nothing."""

    def __init__(self, runs: int, episodes: int) -> None:
        self._runs, self._episodes, self._bar = runs, episodes, progress_bar()
        self._task: TaskID | None = None

    def __enter__(self) -> "SweepProgress":
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def show(self, progress: "Progress") -> None:
        """Show the number of finished runs and of episodes.

        The first call starts the clock: the remaining time is estimated only from the episodes of this sweep.
        """
        if self._task is None:
            self._task = self._bar.add_task("", total=self._episodes, completed=progress.episodes)
        text = f"{progress.finished} of {self._runs} runs, episodes"
        self._bar.update(self._task, completed=progress.episodes, description=text)


def parse_seeds(text: str) -> tuple[int, ...]:
    """Return the seeds in a text such as "0,1,2".

    Raises:
        ValueError: the text is not a list of different numbers.
    """
    words = [word.strip() for word in text.split(",")]
    if not all(word.isdecimal() for word in words) or len(set(map(int, words))) < len(words):
        raise ValueError(f"--seeds must be different numbers, such as 0,1,2; {text!r} is not")
    return tuple(map(int, words))


def _refuse_missing(runs: list[str], command: str) -> NoReturn:
    listed = "\n".join(f"  {run}" for run in runs)
    make, draw = f"This command trains them:\n  {command}", "Use --partial to draw without them."
    refuse(f"These runs are missing:\n{listed}\n{make}\n{draw}")
