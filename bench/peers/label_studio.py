"""Runs Label Studio, which `make bench-label-studio` installs, for `bench/label_studio.py`.

It runs as its users run it: `label-studio start`, with SQLite. But it sends nothing to its makers, and all its files
are in a folder of the caller. People sign up at its sign-up page, and each has a token.
"""

import os
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import httpx2
from bench.peers.client import Missing

PROGRAM = Path(__file__).parents[2] / ".venv" / "label-studio" / "bin" / "label-studio"
OWNER = {"username": "owner@example.org", "password": "of the benchmark", "user-token": "0123456789" * 4}
SILENT = {  # it calls nobody on the network
    "COLLECT_ANALYTICS": "False",
    "LATEST_VERSION_CHECK": "False",
    "SENTRY_DSN": "",
    "FRONTEND_SENTRY_DSN": "",
}
STARTS_WITHIN = 180.0  # seconds
IMPORTED = 1_000  # tasks at a time
FORM = """<View><Text name="question" value="$question"/>
<Choices name="verdict" toName="question"><Choice value="pass"/><Choice value="fail"/></Choices></View>"""


@contextmanager
def running(folder: Path) -> Iterator["LabelStudio"]:
    """Make a store in this folder and run the server on it; raise `Missing` if it cannot run."""
    if not PROGRAM.exists():
        raise Missing("Label Studio is not installed; `make bench-label-studio` installs it")
    # Of our environment it gets only the PATH: it would take names such as PORT or USERNAME for its settings.
    environment = {"PATH": os.environ["PATH"], "HOME": str(folder), **SILENT}
    owner = [word for name, value in OWNER.items() for word in (f"--{name}", value)]
    at = ["--data-dir", str(folder)]
    port = _free_port()
    listen = ["--no-browser", "--internal-host", "127.0.0.1", "--port", str(port)]
    with (folder / "said.txt").open("w+") as said:
        output = {"stdin": subprocess.DEVNULL, "stdout": said, "stderr": said, "env": environment}
        init = [PROGRAM, "init", "--quiet", "--enable-legacy-api-token", *owner, *at]
        if subprocess.run(init, check=False, **output).returncode:
            raise Missing(f"Label Studio made no store: {_last_line(said)}")
        with subprocess.Popen([PROGRAM, "start", *listen, *at], **output) as process:
            try:
                server = LabelStudio(f"http://127.0.0.1:{port}", process.pid)
                if not server.is_ready_within(STARTS_WITHIN, process):
                    raise Missing(f"Label Studio did not start: {_last_line(said)}")
                yield server
            finally:
                process.terminate()


class LabelStudio:
    """A running server, as its owner uses it."""

    def __init__(self, url: str, pid: int) -> None:
        self.url, self.pid = url, pid
        headers = {"Authorization": f"Token {OWNER['user-token']}"}
        self._client = httpx2.Client(base_url=url, headers=headers, timeout=300)

    def is_ready_within(self, seconds: float, process: subprocess.Popen[Any]) -> bool:
        """Wait until the server answers; return whether it does."""
        until = time.perf_counter() + seconds
        while process.poll() is None and time.perf_counter() < until:
            try:
                return self._client.get("/health").is_success
            except httpx2.TransportError:
                time.sleep(0.2)
        return False

    def version(self) -> str:
        """Return its version."""
        return str(self._client.get("/api/version").json()["release"])

    def sign_up(self, name: str) -> dict[str, str]:
        """Make an account on the sign-up page; return the headers of its token."""
        with httpx2.Client(base_url=self.url, timeout=300) as browser:
            browser.get("/user/signup/").raise_for_status()
            form = {"email": f"{name}@example.org", "password": f"password of {name}"}
            form["csrfmiddlewaretoken"] = browser.cookies["csrftoken"]
            browser.post("/user/signup/", data=form)
            token = browser.get("/api/current-user/token").raise_for_status().json()["token"]
        return {"Authorization": f"Token {token}"}

    def project(self, tasks: list[dict[str, Any]]) -> int:
        """Make a project in which each task wants one annotation; return its number."""
        wanted = {"title": "bench", "label_config": FORM, "maximum_annotations": 1}
        made = self._client.post("/api/projects", json=wanted).raise_for_status().json()
        for first in range(0, len(tasks), IMPORTED):
            imported = [{"data": task} for task in tasks[first : first + IMPORTED]]
            self._client.post(f"/api/projects/{made['id']}/import", json=imported).raise_for_status()
        return int(made["id"])


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _last_line(said: Any) -> str:
    said.seek(0)
    return (said.read().strip().splitlines() or ["it ended without a message"])[-1]
