"""The command `serve`. It imports the app when it runs, because other commands do without and start faster."""

from typing import Annotated

import typer
from pydantic import ValidationError

from waypost_server.cli.shared import DEFAULT_DATABASE, DatabaseOption, NoBackupOption, refuse
from waypost_server.db import backup
from waypost_server.db.engine import BadDatabase
from waypost_server.db.schema import NewerStore
from waypost_server.errors import StorageFailed
from waypost_server.settings import Settings

app = typer.Typer()


@app.command()
def serve(
    host: Annotated[str, typer.Option(help="The address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65_535, help="The port; 0 for any free port.")] = 8000,
    database: DatabaseOption = DEFAULT_DATABASE,
    lease: Annotated[float | None, typer.Option(help="How long a lease lasts without a renewal, in seconds.")] = None,
    login_link: Annotated[
        bool, typer.Option("--login-link", help="Print a login link even if an administrator has logged in before.")
    ] = False,
    no_backup: NoBackupOption = False,
    n_processes: Annotated[
        int, typer.Option("--processes", min=1, max=64, help="How many processes serve; several need PostgreSQL.")
    ] = 1,
) -> None:
    """Serve the API and the web app. Until an administrator has logged in, print a one-time login link."""
    from waypost_server.auth.oidc import BadProvider
    from waypost_server.cli.served import serve_app
    from waypost_server.gold.practice import BadPractice
    from waypost_server.serving import CannotServe

    given = {"database": database} | ({} if lease is None else {"lease_seconds": lease})
    try:
        settings = Settings.model_validate(Settings().model_dump() | given)
        serve_app(settings, host, port, login_link=login_link, with_backup=not no_backup, n_processes=n_processes)
    except ValidationError as error:
        first = error.errors()[0]
        refuse(f"The setting {'.'.join(map(str, first['loc']))} is not valid: {first['msg']}.")
    except (
        CannotServe,
        BadDatabase,
        NewerStore,
        StorageFailed,
        BadPractice,
        BadProvider,
        backup.CannotBackUp,
    ) as error:
        refuse(str(error))
