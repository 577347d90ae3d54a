"""The server's commands."""

import typer

from waypost_server.cli import people, runs, serve, store

app = typer.Typer(no_args_is_help=True, help="The Waypost server and its users.")
for part in (serve, store, people):
    app.add_typer(part.app)
app.add_typer(runs.app, name="run")
