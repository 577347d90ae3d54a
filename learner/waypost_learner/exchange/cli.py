"""The commands `waypost export`, `waypost import` and `waypost clone`.

The module imports quickly: each command imports the packages that it needs when it runs.
"""

import json
import shlex
import sys
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from waypost_learner.commands import (
    JsonOption,
    ServerOption,
    TokenOption,
    checkpoint_folder,
    learner_errors,
    needed,
    refuse,
)

app = typer.Typer()


@app.command("export")
def export_run(
    run: Annotated[str, typer.Argument(help="The run's id.")],
    out: Annotated[Path, typer.Option(help="The folder to write; it must not exist.")],
    form: Annotated[str, typer.Option("--format", help="jsonl, parquet, minari or lerobot.")] = "jsonl",
    store: Annotated[Path | None, typer.Option("--store", help="The SQLite file that contains the run.")] = None,
    server: ServerOption = None,
    token: TokenOption = "",
    names: Annotated[bool, typer.Option("--names", help="Keep the annotators' names instead of pseudonyms.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Write a run's queries, answers and costs to files that other programs read."""
    if (store is None) == (server is None):
        refuse("Give the source of the run: either --store FILE or --server URL.")
    with learner_errors():
        from waypost_learner.exchange.export import export
        from waypost_learner.exchange.source import opened

        command = shlex.join(["waypost", *sys.argv[1:]])
        with (
            Console(stderr=True).status("Exporting."),
            opened(store, server or "", needed(token) if server else "") as source,
        ):
            tally = export(source, run, form, out, names, command)
    answers = sum(kind.answers for kind in tally.kinds.values())
    units = sum(kind.units for kind in tally.kinds.values())
    if as_json:
        found = {"run": run, "format": form, "out": str(out), "answers": answers, "units": units}
        typer.echo(json.dumps(found | {"episodes": tally.episodes}))
    else:
        typer.echo(f"{out}: {tally.episodes} episodes, {answers} answers, {units:g} units.")


@app.command("import")
def import_run(
    path: Annotated[Path, typer.Argument(help="A folder that `waypost export` wrote as jsonl or parquet.")],
    store: Annotated[
        Path | None, typer.Option("--store", help="The SQLite file; it is created if it does not exist.")
    ] = None,
    database: Annotated[
        str | None, typer.Option("--database", help="Instead of a file: sqlite:///FILE or postgresql://USER@HOST/NAME.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Recreate an exported run in a store, with its answers, costs and results."""
    if (store is None) == (database is None):
        refuse("Give the store to import into: either --store FILE or --database URL.")
    with learner_errors():
        from waypost_learner.exchange.files import records_in
        from waypost_learner.remote.embedded import restored

        records_in(path)  # refuses a path without data before a store is created
        with Console(stderr=True).status("Importing."):
            run = restored(database or f"sqlite:///{store}", lambda: records_in(path))
    if as_json:
        typer.echo(json.dumps({"run": run.id, "episodes": run.episodes_done, "units": run.spent}))
    else:
        typer.echo(f"Imported run {run.id} ({run.name}): {run.episodes_done} episodes, {run.spent:g} units.")


@app.command()
def clone(
    labels: Annotated[str, typer.Argument(help="The id of a run, or an export as jsonl or parquet.")],
    algorithm: Annotated[str, typer.Option(help="h-bc, or flat-bc for flat labels.")] = "h-bc",
    preset: Annotated[str, typer.Option(help="The preset: lean, general or paper.")] = "lean",
    values: Annotated[str | None, typer.Option(help='Values to replace in the preset: "relabeling=false".')] = None,
    seed: Annotated[int, typer.Option(min=0, help="The seed of every random choice.")] = 0,
    episodes: Annotated[int | None, typer.Option(min=1, help="How many episodes to use. Default: all.")] = None,
    store: Annotated[Path | None, typer.Option("--store", help="The SQLite file that contains the run.")] = None,
    server: ServerOption = None,
    token: TokenOption = "",
    checkpoints: Annotated[
        Path | None, typer.Option(help="The folder for the checkpoint. Default: as for `train`.")
    ] = None,
    threads: Annotated[int | None, typer.Option(min=1, help="CPU threads to train with.")] = None,
    as_json: JsonOption = False,
) -> None:
    """Train by behavioral cloning on the labels of a run or of an export, without asking anybody."""
    if store is not None and server is not None:
        refuse("A server has its own store: give either --server or --store.")
    with learner_errors("Interrupted."), ExitStack() as stack:
        from waypost_learner.exchange.files import records_in
        from waypost_learner.exchange.source import opened, records_of
        from waypost_learner.exchange.training import train_on

        if store is None and server is None:
            records = records_in(Path(labels))
        else:
            source = stack.enter_context(opened(store, server or "", needed(token) if server else ""))
            records = records_of(source, labels)
        chosen = {"algorithm": algorithm, "preset": preset, "values": values, "seed": seed}
        stack.enter_context(Console(stderr=True).status("Training."))
        found = train_on(records, chosen, checkpoint_folder(checkpoints, store, server), episodes, threads)
    if as_json:
        typer.echo(json.dumps(vars(found)))
    else:
        typer.echo(f"Trained on {found.labels} labels of {found.episodes} episodes of run {found.run}.")
        typer.echo(f"Success on unseen instances, trailing 100: {found.success_rate:.0%}")
        typer.echo(f"`waypost evaluate {found.checkpoint}` finds the policies.")
