"""The command `waypost theory`. Quick to import: the packages it needs are imported when it runs."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import Progress

from learner.commands import learner_errors
from server.cli import JsonOption, refuse

app = typer.Typer()


@app.command()
def theory(
    seeds: Annotated[int, typer.Option(min=1, help="How many seeds in each cell of the grid.")] = 5,
    rounds: Annotated[int, typer.Option(min=1, help="T, the episodes of each learner.")] = 100,
    out: Annotated[Path | None, typer.Option(help="A folder for theory.csv, theory.svg and theory.png.")] = None,
    as_json: JsonOption = False,
) -> None:
    """Measure hg-DAgger and flat DAgger with halving learners against Theorems 1 and 2."""
    if out is not None:
        try:
            out.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            refuse(f"Cannot write to the folder {out}: {error.strerror}.")
    with learner_errors():
        from learner.experiments.theory import grid, report

        console = Console(stderr=True)
        with Progress(console=console, transient=True, disable=not console.is_terminal) as progress:
            task = progress.add_task("halving", total=len(grid.GRID) * len(grid.EPISODES))
            rows = grid.measure(grid.GRID, seeds, rounds, lambda: progress.advance(task))
        if out is not None:
            from learner.experiments.theory import draw

            draw.save(rows, out)
            grid.write_csv(rows, out / "theory.csv")
        if as_json:
            cells = [row.values() for row in rows]
            typer.echo(json.dumps({"seeds": seeds, "rounds": rounds, "worst": grid.worst(rows), "cells": cells}))
        else:
            typer.echo("\n".join(report.table(rows, seeds, rounds)))
