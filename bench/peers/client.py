"""Another library, measured in the same run though it needs a virtual environment of its own (`make bench`)."""

import json
import subprocess
import tempfile
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
PYTHON = HERE.parents[1] / ".venv" / "peers" / "bin" / "python"


class Missing(Exception):
    """The peer cannot be measured; says why."""


class Peer:
    """A process that does a round of work when it is asked to, and rests in between (`serve.py`)."""

    def __init__(self, module: str, **settings: Any) -> None:
        if not PYTHON.exists():
            raise Missing("its environment is not there, which `make bench` installs where it can")
        self._said = tempfile.TemporaryFile("w+")  # noqa: SIM115 - closed with the process
        command = [PYTHON, "-E", HERE / "serve.py", module, json.dumps(settings)]
        pipe = subprocess.PIPE
        self._process = subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=self._said, text=True)
        self.versions = ", ".join(f"{name} {version}" for name, version in self._answer()["versions"].items())

    def seconds(self, **asked: Any) -> float:
        """Have one round done; how long it took, by the peer's own clock."""
        print(json.dumps(asked), file=self._process.stdin, flush=True)
        return self._answer()["seconds"]

    def _answer(self) -> dict[str, Any]:
        if line := self._process.stdout.readline():
            return json.loads(line)
        self._process.wait()
        self._said.seek(0)
        raise Missing((self._said.read().strip().splitlines() or ["it ended without a word"])[-1])

    def __enter__(self) -> "Peer":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()
        self._said.close()
