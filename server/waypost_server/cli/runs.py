"""The commands that delete runs."""

import json
from typing import Annotated

import typer

from waypost import wire
from waypost_server.cli.shared import DEFAULT_DATABASE, DatabaseOption, DryRunOption, JsonOption, opened
from waypost_server.db.engine import Database
from waypost_server.runs import deletion
from waypost_server.runs import service as runs

app = typer.Typer(no_args_is_help=True, help="Runs of a store.")


@app.command("delete")
def delete_run(
    run: str, dry_run: DryRunOption = False, database: DatabaseOption = DEFAULT_DATABASE, as_json: JsonOption = False
) -> None:
    """Delete what a finished run contains, for good. Its costs and its ledger stay."""
    with opened(database, create=False) as db:
        done = _delete(db, run, dry_run)
    typer.echo(done.model_dump_json() if as_json else _words(done))


@app.command("delete-old")
def delete_old_runs(
    days: Annotated[float, typer.Option(min=0, max=36_500, help="How many days a run must have been finished.")],
    dry_run: DryRunOption = False,
    database: DatabaseOption = DEFAULT_DATABASE,
    as_json: JsonOption = False,
) -> None:
    """Delete what all runs contain that finished long ago, for good. Their costs and their ledgers stay."""
    with opened(database, create=False) as db:
        found = db.read_now(lambda tx: deletion.finished_before(tx, days))
        done = [_delete(db, run, dry_run) for run in found]
    if as_json:
        typer.echo(json.dumps([one.model_dump() for one in done]))
        return
    for one in done:
        typer.echo(_words(one))
    if not done:
        typer.echo(f"No run finished more than {days:g} days ago.")


def _delete(db: Database, run: str, dry_run: bool) -> wire.RunDeletion:
    """Delete one run in a transaction of its own, so that others do not wait long for the store."""
    if dry_run:
        return db.read_now(lambda tx: deletion.preview(tx, runs.find(tx, run)))
    return db.write_now(lambda tx: deletion.delete(tx, runs.lock(tx, run)))


def _words(done: wire.RunDeletion) -> str:
    return (
        f"{'Would delete' if done.dry_run else 'Deleted'} {done.queries} queries, {done.answers} answers, "
        f"{done.comments} comments and {done.frames} pictures ({done.frame_bytes} bytes) of run {done.run}. Its ledger "
        f"stays: {done.kept_units:g} units."
    )
