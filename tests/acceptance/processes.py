"""Real processes: a server, learners and bots, started and stopped as a user would."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from waypost import wire
from waypost.client import Client

WAYPOST = (sys.executable, "-m", "waypost_learner.cli")


def run_waypost(*arguments: str, env: dict[str, str] | None = None) -> str:
    """Run a command to its end and return what it printed."""
    done = subprocess.run([*WAYPOST, *arguments], env={**os.environ, **(env or {})}, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@dataclass
class ServerProcess:
    """`waypost serve` on a port of its own, which can be killed and started again."""

    folder: Path
    port: int
    process: subprocess.Popen[bytes] | None = None
    tokens: dict[str, str] = field(default_factory=dict)
    clients: list[Client] = field(default_factory=list)

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    @property
    def database(self) -> str:
        return f"sqlite:///{self.folder / 'waypost.db'}"

    def start(self) -> None:
        command = [*WAYPOST, "serve", "--port", str(self.port), "--database", self.database]
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 30
        while True:
            try:
                socket.create_connection(("127.0.0.1", self.port), 0.2).close()
                return
            except OSError:
                assert self.process.poll() is None, "the server did not start"
                assert time.monotonic() < deadline, "the server did not listen within 30 s"
                time.sleep(0.02)

    def kill(self) -> None:
        assert self.process is not None
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def token(self, name: str, role: wire.Role) -> str:
        """Return a token for a user, created the first time."""
        if name not in self.tokens:
            run_waypost("user", "add", name, "--role", role, "--database", self.database)
            made = run_waypost("token", "create", name, "--database", self.database, "--json")
            self.tokens[name] = json.loads(made)["token"]
        return self.tokens[name]

    def login_link(self, name: str) -> str:
        """Return a link that logs a new annotator in."""
        run_waypost("user", "add", name, "--role", "annotator", "--database", self.database)
        made = run_waypost("login-link", name, "--base", self.url, "--database", self.database, "--json")
        return str(json.loads(made)["url"])

    def client(self, name: str, role: wire.Role) -> Client:
        self.clients.append(Client(self.url, self.token(name, role), patience=200))
        return self.clients[-1]

    def stop(self) -> None:
        for client in self.clients:
            client.close()
        self.kill()


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


# A short run that asks every kind of query of Algorithm 2: what is trained so little makes all kinds of mistakes.
LITTLE = " ".join(f"train_{level}.{rows}=192" for level in ("hi", "lo") for rows in ("least", "most", "idle"))
VALUES = ("hg-dagger", "--domain", "maze", "--instances", "corners", "--values", LITTLE, "--seed", "0")
LENGTH = ("--episodes", "40")

Reference = tuple[dict[str, Any], list[Any]]
"""A run's summary and its history."""


def start_learner(server: ServerProcess, values: tuple[str, ...]) -> subprocess.Popen[str]:
    """Start `waypost train --expert queue`."""
    where = ("--server", server.url, "--checkpoints", str(server.folder / "checkpoints"))
    return subprocess.Popen(
        [*WAYPOST, "train", *values, "--expert", "queue", *where, "--json"],
        env={**os.environ, "WAYPOST_TOKEN": server.token("learner", "learner")},
        stdout=subprocess.PIPE,
        text=True,
    )


def finished(learner: subprocess.Popen[str]) -> dict[str, Any]:
    """Wait for a learner to end well, and return its summary."""
    out, _ = learner.communicate(timeout=240)
    assert learner.returncode == 0
    summary: dict[str, Any] = json.loads(out)
    return summary


@contextmanager
def bot(server: ServerProcess, name: str, *options: str) -> Iterator[None]:
    """Run `waypost oracle` for as long as the context lasts."""
    process = subprocess.Popen(
        [*WAYPOST, "oracle", "--server", server.url, *options],
        env={**os.environ, "WAYPOST_TOKEN": server.token(name, "annotator")},
        stderr=subprocess.DEVNULL,
    )
    try:
        yield
    finally:
        process.terminate()
        process.wait()


def answers(client: Client, run: str) -> list[wire.Query]:
    """Return every answered query of a run, in the order of the answers."""
    queries: list[wire.Query] = []
    cursor = 0
    while True:
        page = client.answers(run, cursor)
        if not page.queries:
            return queries
        queries, cursor = queries + page.queries, page.cursor


def history(client: Client, run: str) -> list[tuple[object, ...]]:
    """Return all that was asked, answered and charged in a run, in the order of its episodes."""
    ordered = sorted(answers(client, run), key=lambda query: (query.ask.episode, query.ask.ordinal))
    return [(query.ask, query.answer, query.units) for query in ordered]
