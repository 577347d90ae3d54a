"""Starts another library in a process with its own virtual environment (`make bench` installs it), and measures it."""

import json
import subprocess
import tempfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
PYTHON = HERE.parents[1] / ".venv" / "peers" / "bin" / "python"


class Missing(Exception):
    """The peer cannot be measured; the message gives the reason."""


class Peer:
    """A process that does one round of work per request, and waits otherwise (`serve.py`)."""

    def __init__(self, module: str, **settings: Any) -> None:
        if not PYTHON.exists():
            raise Missing("its virtual environment does not exist; `make bench` installs it")
        self._said = tempfile.TemporaryFile("w+")  # noqa: SIM115 - closed with the process
        command = [PYTHON, "-E", HERE / "serve.py", module, json.dumps(settings)]
        pipe = subprocess.PIPE
        self._process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=self._said, text=True)
        self.versions = ", ".join(f"{name} {version}" for name, version in self._answer()["versions"].items())

    def seconds(self, **asked: Any) -> float:
        """Do one round of work; return its duration in seconds, by the peer's clock."""
        print(json.dumps(asked), file=self._process.stdin, flush=True)
        return self._answer()["seconds"]

    def _answer(self) -> dict[str, Any]:
        if line := self._process.stdout.readline():
            return json.loads(line)
        self._process.wait()
        self._said.seek(0)
        raise Missing((self._said.read().strip().splitlines() or ["it ended without a message"])[-1])

    def __enter__(self) -> "Peer":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()
        self._said.close()
