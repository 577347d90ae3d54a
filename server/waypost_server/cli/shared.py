"""What the commands of the server share: opening a store for one command, refusing, and options."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated, NoReturn

import typer

from waypost_server import errors
from waypost_server.db.engine import BadDatabase, Database
from waypost_server.db.schema import WrongSchema

DatabaseOption = Annotated[
    str, typer.Option("--database", envvar="WAYPOST_DATABASE", help="sqlite:///FILE or postgresql://USER@HOST/NAME.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print the result as one line of JSON.")]
NoBackupOption = Annotated[bool, typer.Option("--no-backup", help="Migrate an older store without a backup.")]
DryRunOption = Annotated[bool, typer.Option("--dry-run", help="Only say what would be deleted.")]

DEFAULT_DATABASE = "sqlite:///waypost.db"


def refuse(message: str) -> NoReturn:
    """Print what was wrong and exit with the status for wrong usage."""
    typer.echo(message, err=True)
    raise typer.Exit(2)


@contextmanager
def opened(url: str, *, create: bool = True) -> Iterator[Database]:
    """Open a store for one command; an error ends the command with a message of one sentence."""
    try:
        db = Database(url, create=create)
    except (BadDatabase, WrongSchema) as error:
        refuse(str(error))
    try:
        yield db
    except errors.Refusal as refusal:
        refuse(refusal.detail)
    finally:
        db.close()
