"""Real processes: a server, learners and bots, started and stopped as a user would."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from learner.client import Client
from server import wire

WAYPOST = (sys.executable, "-m", "learner.cli")


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

    def client(self, name: str, role: wire.Role) -> Client:
        self.clients.append(Client(self.url, self.token(name, role), patience=60))
        return self.clients[-1]

    def stop(self) -> None:
        for client in self.clients:
            client.close()
        self.kill()


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def history(client: Client, run: str) -> list[tuple[object, ...]]:
    """Return all that was asked, answered and charged in a run, in the order of its episodes."""
    rows = []
    after = 0
    while page := client.answers(run, after).queries:
        after = client.answers(run, after).cursor
        for query in page:
            answer = query.answer.model_dump() if query.answer else None
            rows.append((query.ask.episode, query.ask.ordinal, query.ask.model_dump(), answer, query.units))
    return sorted(rows, key=lambda row: row[:2])
