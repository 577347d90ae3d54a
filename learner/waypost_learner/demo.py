"""`waypost demo`: a server, a learner and an oracle bot on this machine.

The run waits at its first question until somebody opens the web app, so that a newcomer sees the learner learn. Then
the bot answers a query only after leaving it to you for some seconds.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import typer
from sqlalchemy import exists, select

from waypost import wire
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.cli.login import login_url
from waypost_server.db.engine import BadDatabase, Database
from waypost_server.db.schema import WrongSchema
from waypost_server.db.tables import presence
from waypost_server.db.tables import users as annotators
from waypost_server.settings import Settings
from waypost_server.users import service as users

DEFER_SECONDS = 25.0  # for which the bot leaves a query to a person who is working
THINKING_SECONDS = 1.0  # the bot waits before each answer, so that you can follow the learner
LINK_SECONDS = 86_400.0  # for which the login link is valid
BOT = "oracle-bot"


def run_demo(port: int, database: Path, episodes: int, domain: str, instances: str, *, wait: bool) -> None:
    """Serve until interrupted, with a learner that asks queries and a bot that answers what people leave.

    Args:
        port: the port to serve on; 0 takes a free port.
        database: the SQLite file; it is created if it does not exist.
        episodes: the number of episodes of the learner's run.
        domain: the domain of the learner's run; it has an oracle.
        instances: the name of the run's instances.
        wait: whether the bot answers questions only after somebody has opened the web app.

    Raises:
        ValueError: the server cannot start; the message is one sentence for the user.
    """
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # so that SIGTERM also stops the other processes
    settings = Settings(database=f"sqlite:///{database}", link_seconds=LINK_SECONDS)
    with _server_errors(), ExitStack() as stack:
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

        def start_bot(*options: str) -> None:
            start(BOT, "annotator", "oracle", "--domain", domain, "--defer", str(DEFER_SECONDS), *options)

        # Without demonstrations, because the bot gives the few that the learner begins with.
        link = login_url(served.db, served.url, "you", "admin", LINK_SECONDS, without="hier_demo")
        typer.echo(f"Waypost is at {served.url}; answers are kept in {database}.")
        typer.echo(f"Open this link; it works once: {link}")
        typer.echo("Answer with the keyboard; the bot answers the queries that you leave. Press Ctrl-C to stop.")
        began = time.time()
        start_bot("--kinds", "hier_demo")
        train = ("train", "hg-dagger", "--expert", "queue", "--name", "demo")
        values = ("--domain", domain, "--instances", instances, "--episodes", str(episodes))
        checkpoints = ("--checkpoints", str(database.with_name(f"{database.name}.checkpoints")))
        learner = start("demo-learner", "learner", *train, *values, *checkpoints)
        try:
            if wait:
                typer.echo("The learner starts. It waits at its first question until you have opened the link.")
                wait_for_somebody(served.db, began, learner)
            start_bot("--seconds", str(THINKING_SECONDS))
            if learner.wait():
                typer.echo(f"The learner stopped before its end; {log.name} says why.", err=True)
            else:
                typer.echo("The run is finished; the server runs until you press Ctrl-C.")
            while True:
                time.sleep(3_600)
        except KeyboardInterrupt:
            typer.echo("Stopped.")


def wait_for_somebody(db: Database, since: float, learner: subprocess.Popen[bytes]) -> None:
    """Wait until somebody other than the bot asks for a query, or the learner ends."""
    somebody = exists().where(
        presence.c.user_id == annotators.c.id, annotators.c.name != BOT, presence.c.asked_at >= since
    )
    while learner.poll() is None and not db.read_now(lambda tx: bool(tx.conn.execute(select(somebody)).scalar_one())):
        time.sleep(0.2)


@contextmanager
def _server_errors() -> Iterator[None]:
    """Turn errors at the server's start into ValueErrors with the same message."""
    try:
        yield
    except (serving.CannotServe, BadDatabase, WrongSchema) as error:
        raise ValueError(str(error)) from error
