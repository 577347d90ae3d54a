"""The commands about a whole store: migrate, check, backup, restore."""

import json
import re
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from waypost_server import errors
from waypost_server.cli.shared import DEFAULT_DATABASE, DatabaseOption, JsonOption, NoBackupOption, opened, refuse
from waypost_server.db import audit, backup, checking, migration
from waypost_server.db.engine import BadDatabase
from waypost_server.db.schema import NewerStore, WrongSchema

app = typer.Typer()


@app.command()
def migrate(
    database: DatabaseOption = DEFAULT_DATABASE, no_backup: NoBackupOption = False, as_json: JsonOption = False
) -> None:
    """Bring a store up to this version's schema, after a backup: there is no way back."""
    try:
        found = migration.migrate(database, with_backup=not no_backup)
    except (BadDatabase, NewerStore, backup.CannotBackUp) as error:
        refuse(str(error))
    done = found.migrated
    if found.backup is not None and not as_json:
        typer.echo(f"Backed up to {found.backup}.")
    if as_json:
        typer.echo(json.dumps(asdict(done) | {"backup": str(found.backup) if found.backup else None}))
    elif done.before == done.after:
        typer.echo(f"The store already has schema {done.after}.")
    else:
        typer.echo(f"The store has schema {done.after} now; before, it {_had(done.before)}.")


@app.command()
def check(
    database: DatabaseOption = DEFAULT_DATABASE,
    audit_head: Annotated[
        str | None,
        typer.Option(metavar="NUMBER:HASH", help="A row of the audit log that was noted earlier: it must be there."),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Check a store: file, ledger, leases, audit log. It only reads, so servers may use the store meanwhile."""
    noted = None if audit_head is None else _head(audit_head)
    with opened(database, create=False) as db:
        results = db.read_now(lambda tx: checking.check(tx, noted))
    if as_json:
        typer.echo(json.dumps([asdict(result) for result in results]))
    else:
        for result in results:
            typer.echo(_line(result))
    if any(result.n_faults for result in results):
        raise typer.Exit(1)


def _head(text: str) -> audit.Head:
    number, _, digest = text.partition(":")
    if not re.fullmatch(r"[1-9]\d{0,17}:[0-9a-f]{64}", text):
        refuse(f"{text!r} is not a row of the audit log; `waypost check` prints one as NUMBER:HASH.")
    return audit.Head(int(number), digest)


def _line(result: checking.Result) -> str:
    if not result.n_faults:
        return f"ok    {result.fact}{f' Its newest row: {result.head}' if result.head else ''}"
    more = result.n_faults - len(result.faults)
    return f"WRONG {result.fact} Not so: {', '.join(result.faults)}{f' and {more} more' if more else ''}."


@app.command("backup")
def back_up(file: Path, database: DatabaseOption = DEFAULT_DATABASE) -> None:
    """Back up a store to a new file. Servers may use the store meanwhile."""
    try:
        backup.back_up(database, file)
    except (BadDatabase, backup.CannotBackUp) as error:
        refuse(str(error))
    typer.echo(f"Backed up to {file}. `waypost restore {file}` restores it.")


@app.command()
def restore(
    file: Path,
    database: DatabaseOption = DEFAULT_DATABASE,
    anyway: Annotated[bool, typer.Option("--anyway", help="Restore a store that does not pass the checks.")] = False,
) -> None:
    """Restore a backup as a new SQLite file, or in an empty PostgreSQL database, and check it."""
    try:
        found = backup.restore(file, database, anyway=anyway)
    except (BadDatabase, WrongSchema, backup.CannotBackUp, errors.StorageFailed) as error:
        refuse(str(error))
    if found.older:
        typer.echo("Restored. An earlier version wrote it: `waypost migrate` migrates it.")
    for result in found.wrong:
        typer.echo(_line(result))
    if found.wrong:
        typer.echo("Restored, with these faults.")
        raise typer.Exit(1)
    if not found.older:
        typer.echo("Restored and checked.")


def _had(schema: str | None) -> str:
    return "was empty" if schema is None else f"had {schema}"
