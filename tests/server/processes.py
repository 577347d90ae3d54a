"""`serve` in a process of its own."""

import os
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx2


@dataclass(frozen=True)
class Served:
    """A server's address, its process, and the file with its log (standard error)."""

    address: str
    process: subprocess.Popen[str]
    log: Path


@contextmanager
def serving(
    url: str, folder: Path, settings: Mapping[str, str], *options: str, variables: Mapping[str, str] | None = None
) -> Iterator[Served]:
    """Run `serve` until the context ends. The settings are named as in `Settings`; other variables as they are."""
    command = [sys.executable, "-u", "-m", "waypost_server.cli", "serve", "--port", "0", "--database", url, *options]
    environment = {f"WAYPOST_{name.upper()}": value for name, value in settings.items()}
    log = folder / "server.log"
    with log.open("w") as stderr:
        process = subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            stderr=stderr,
            text=True,
            env={**os.environ, **environment, **(variables or {})},
        )
    try:
        assert process.stdout is not None
        said = process.stdout.readline().split()
        assert said, log.read_text()
        wait_for(said[-1])
        yield Served(said[-1], process, log)
    finally:
        process.kill()
        process.wait()
        assert process.stdout is not None
        process.stdout.close()


def wait_for(address: str) -> None:
    deadline = time.monotonic() + 30
    while True:
        try:
            assert httpx2.get(f"{address}/readyz").status_code == 200
        except httpx2.TransportError:
            assert time.monotonic() < deadline
            time.sleep(0.1)
        else:
            return
