"""Runs the server's commands: `python -m waypost_server.cli`."""

from waypost_server.cli.main import app

app()
