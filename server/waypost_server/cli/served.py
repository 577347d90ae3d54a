"""What the command `serve` does: it migrates the store, prints a login link, and serves."""

import socket
from contextlib import closing

import typer

from waypost import tracing
from waypost_server import serving
from waypost_server.app import create_app
from waypost_server.auth import sessions
from waypost_server.cli import processes
from waypost_server.cli.login import login_url
from waypost_server.db import migration
from waypost_server.db.engine import Database
from waypost_server.http import logs, spa
from waypost_server.settings import Settings
from waypost_server.users import service as users


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
