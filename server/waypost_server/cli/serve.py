"""The command `serve`, and the login links that it and others print."""

import socket
from contextlib import closing
from typing import Annotated

import typer
from pydantic import ValidationError

from waypost import tracing, wire
from waypost_server import serving
from waypost_server.app import create_app
from waypost_server.auth import sessions
from waypost_server.auth.oidc import BadProvider
from waypost_server.cli import processes
from waypost_server.cli.shared import DEFAULT_DATABASE, DatabaseOption, NoBackupOption, refuse
from waypost_server.db import backup, migration
from waypost_server.db.engine import BadDatabase, Database
from waypost_server.db.schema import NewerStore
from waypost_server.errors import StorageFailed
from waypost_server.gold.practice import BadPractice
from waypost_server.http import logs, spa
from waypost_server.settings import Settings
from waypost_server.users import service as users

app = typer.Typer()


def login_url(
    db: Database, base: str, name: str, role: wire.Role, seconds: float, without: wire.Kind | None = None
) -> str:
    """Return a one-time link that logs in the user with this name; create the user if there is none.

    The web app that the link opens does not ask for queries of the kind `without`.
    """
    user = db.write_now(lambda tx: users.ensure_user(tx, name, role))
    link = db.write_now(lambda tx: sessions.create_login_link(tx, user.id, seconds))
    search = "" if without is None else f"?without={without}"
    return f"{base.rstrip('/')}/login{search}#{link.code}"


def serve_app(
    settings: Settings, host: str, port: int, *, login_link: bool, with_backup: bool = True, n_processes: int = 1
) -> None:
    """Migrate the store after a backup, and serve it until told to stop.

    Print a login link for an administrator if `login_link` is true or if none has ever logged in.

    Raises:
        CannotServe, BadDatabase, NewerStore, CannotBackUp: with one sentence for the user.
    """
    processes.check(settings, n_processes)
    with closing(serving.bind(host, port)) as bound:
        _serve(settings, host, bound, login_link, with_backup, n_processes)


def _serve(
    settings: Settings, host: str, bound: socket.socket, login_link: bool, with_backup: bool, n_processes: int
) -> None:
    named = () if host in {"0.0.0.0", "::"} else (host,)  # noqa: S104 - compared, not bound
    chosen = settings.model_copy(update={"hosts": (*settings.hosts, *named)})
    done = migration.migrate(chosen.database, with_backup=with_backup)
    with closing(Database(chosen.database)) as db:
        welcome = _welcome(db, serving.url_of(bound), chosen.link_seconds, login_link)
    app = create_app(chosen)  # before the link is printed: while it runs, pydantic sometimes swallows a Ctrl-C
    typer.echo(f"Waypost serves {db.url.render_as_string()} at {serving.url_of(bound)}")
    typer.echo(welcome)
    if done.backup is not None:
        typer.echo(f"The store was of an earlier version: it was backed up to {done.backup}, and migrated.")
    if chosen.page is None and spa.find() is None:
        typer.echo("The web app is not built; `make web` builds it.")
    logs.install(chosen.log_format, with_requests=chosen.log_requests)
    if n_processes > 1:
        processes.serve(chosen, bound, n_processes)
    else:
        tracing.install("waypost-server")
        serving.foreground(app, bound, chosen.drain_seconds)


def _welcome(db: Database, base: str, seconds: float, login_link: bool) -> str:
    """Return how to log in. The output of a server is often kept, so a link is in it only if it is needed."""
    name = db.write_now(users.ensure_administrator).name
    if not login_link and db.read_now(sessions.administrator_has_logged_in):
        return f"`waypost login-link {name}` prints a login link."
    link = login_url(db, base, name, "admin", seconds)
    return f"Log in with this link (it works once, for {seconds / 60:.0f} minutes): {link}"


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
    given = {"database": database} | ({} if lease is None else {"lease_seconds": lease})
    try:
        settings = Settings.model_validate(Settings().model_dump() | given)
        serve_app(settings, host, port, login_link=login_link, with_backup=not no_backup, n_processes=n_processes)
    except ValidationError as error:
        first = error.errors()[0]
        refuse(f"The setting {'.'.join(map(str, first['loc']))} is not valid: {first['msg']}.")
    except (
        serving.CannotServe,
        BadDatabase,
        NewerStore,
        StorageFailed,
        BadPractice,
        BadProvider,
        backup.CannotBackUp,
    ) as error:
        refuse(str(error))
