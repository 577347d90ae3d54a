"""`waypost demo`: a server, a learner and an oracle bot that leaves the questions to you while you answer them."""

import os
import signal
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import typer
from sqlalchemy import exists, select

from waypost import wire
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.cli import login_url
from waypost_server.db.engine import Database
from waypost_server.db.tables import queries
from waypost_server.settings import Settings
from waypost_server.users import service as users

DEFER_SECONDS = 25.0  # how long the bot leaves a question to a person at work
THINKING_SECONDS = 1.0  # for each answer: while the link is opened, the run does not race through to its end
LINK_SECONDS = 86_400.0
PATIENCE_SECONDS = 120.0  # the link is printed by then, whatever the learner does


def run_demo(port: int, database: Path, episodes: int, instances: str) -> None:
    """Serve until interrupted, with a learner that asks and a bot that answers what nobody else does.

    Raises:
        CannotServe, BadDatabase, NewerStore: with one sentence for the user.
    """
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # told to stop, take the others along
    settings = Settings(database=f"sqlite:///{database}", link_seconds=LINK_SECONDS)
    with ExitStack() as stack:
        served = stack.enter_context(serving.background(settings, port=port))
        log = stack.enter_context(database.with_name(f"{database.name}.log").open("ab"))

        def start(name: str, role: wire.Role, *command: str) -> subprocess.Popen[bytes]:
            user = served.db.write_now(lambda tx: users.ensure_user(tx, name, role))
            token = served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "demo")).token
            process = subprocess.Popen(  # noqa: S603 (our own command)
                [sys.executable, "-m", "waypost_learner.cli", *command, "--server", served.url],
                env={**os.environ, "WAYPOST_TOKEN": token},
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
            )
            stack.callback(process.wait)
            stack.callback(process.terminate)
            return process

        typer.echo(f"Waypost is at {served.url}; what is answered is kept in {database}.")
        start("oracle-bot", "annotator", "oracle", "--defer", str(DEFER_SECONDS), "--seconds", str(THINKING_SECONDS))
        train = ("train", "hg-dagger", "--expert", "queue", "--name", "demo")
        values = ("--instances", instances, "--episodes", str(episodes))
        checkpoints = ("--checkpoints", str(database.with_name(f"{database.name}.checkpoints")))
        learner = start("demo-learner", "learner", *train, *values, *checkpoints)
        try:
            typer.echo("A bot shows a learner a few ways through mazes; then it begins to ask.")
            wait_for_questions(served.db, learner)
            typer.echo("Answer with the keyboard; a bot answers whatever you leave.")
            typer.echo(f"Open this link, once: {login_url(served.db, served.url, 'you', 'admin', LINK_SECONDS)}")
            typer.echo("Press Ctrl-C to stop.")
            if learner.wait():
                typer.echo(f"The learner stopped before the end; {log.name} says why.", err=True)
            else:
                typer.echo("The run is finished; the page stays until you press Ctrl-C.")
            while True:
                time.sleep(3_600)
        except KeyboardInterrupt:
            typer.echo("Stopped.")


def wait_for_questions(db: Database, learner: subprocess.Popen[bytes]) -> None:
    """Wait until a learner that has just begun asks what is quickly answered: not for demonstrations any more."""
    began = time.time()
    there = exists().where(queries.c.kind != "hier_demo", queries.c.created_at >= began)
    while learner.poll() is None and time.time() < began + PATIENCE_SECONDS:
        if db.read_now(lambda tx: bool(tx.conn.execute(select(there)).scalar_one())):
            return
        time.sleep(0.2)
