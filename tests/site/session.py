"""Runs the code blocks of one page as a reader would: in one folder, one after the other."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from tests.acceptance.processes import free_port
from tests.site.blocks import Block

PATIENCE_SECONDS = 240.0
DEFAULT_SERVER = "http://127.0.0.1:8000"
DATABASE = "postgresql://waypost@db.example.org/waypost"  # in the documents; a test uses one of its own

# Runs each line of JSON from its input as Python, all in one namespace, and says after each how it went.
INTERPRETER = """
import json, os, sys, traceback
namespace = {"__name__": "__main__"}
for line in sys.stdin:
    block = json.loads(line)
    os.environ.update(block["environment"])
    try:
        exec(compile(block["text"], block["place"], "exec"), namespace)
        wrong = ""
    except BaseException:
        wrong = traceback.format_exc()
    print(json.dumps({"wrong": wrong}), file=sys.__stderr__, flush=True)
"""


class Session:
    """A folder, an environment and the programs that run in it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.postgresql = DATABASE  # the database to use instead
        kept = {name: value for name, value in os.environ.items() if not name.startswith(("WAYPOST_", "PYTEST_"))}
        binaries = str(Path(sys.prefix) / "bin")
        self._environment = {**kept, "PATH": f"{binaries}:{kept['PATH']}", "NO_COLOR": "1", "PYTHONUNBUFFERED": "1"}
        self._set_port(free_port())
        self._printed = folder.parent / "printed"  # what the shell blocks wrote to their standard output
        self._printed.touch()
        self._programs: list[subprocess.Popen[bytes]] = []
        self._endless: list[tuple[Block, subprocess.Popen[bytes]]] = []
        self._python: subprocess.Popen[str] | None = None
        (folder / ".venv").symlink_to(sys.prefix)  # as in a checkout

    def _set_port(self, port: int) -> None:
        """Set the port of the newest server; nothing may reach another server that listens on 8000."""
        self.port = port
        self._environment["WAYPOST_SERVER"] = DEFAULT_SERVER.replace("8000", str(port))

    def run(self, block: Block) -> None:
        """Run a block of shell commands or of Python; an `endless` one is started, and must then listen."""
        text = self._filled_in(block.tested)
        if block.file:
            (self.folder / block.file).write_text(text)
        elif block.language == "python":
            self._run_python(block.place, text)
        elif block.endless:
            self._endless.append((block, self._start(text)))
            if "waypost serve" in text:
                self._wait_until_it_listens(block)
        else:
            self._run_shell(block.place, text)

    def _filled_in(self, text: str) -> str:
        """Return the text with the session's port, and with what earlier blocks printed in place of RUN and wp_..."""
        if "waypost serve" in text:
            self._set_port(free_port())
            text = re.sub(r"\bwaypost serve\b", f"waypost serve --port {self.port}", text)
        text = re.sub(r"\bwaypost (oracle|gold)\b(?!.*--server)", rf"waypost \1 --server {DEFAULT_SERVER}", text)
        text = re.sub(r"(?<=:)8000\b", str(self.port), text).replace(DATABASE, self.postgresql)
        printed = self._printed.read_text()
        for placeholder, pattern in ((r"\bRUN\b", r'(?:"run": "|^Run )(\w{12})'), (r"\bwp_\.\.\.", r"^(wp_[\w-]+)")):
            if found := re.findall(pattern, printed, re.MULTILINE):
                text = re.sub(placeholder, found[-1], text)
        return text

    def _start(self, text: str) -> subprocess.Popen[bytes]:
        script = self.folder.parent / f"{len(self._programs)}.sh"
        script.write_text(text)
        with self._printed.open("ab") as out, script.with_suffix(".err").open("wb") as err:
            program = subprocess.Popen(
                ["bash", "-euo", "pipefail", script],
                cwd=self.folder,
                env=self._environment,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=err,
                start_new_session=True,  # so that `close` also ends what the block left in the background
            )
        self._programs.append(program)
        return program

    def _run_shell(self, place: str, text: str) -> None:
        after = self.folder.parent / "environment"
        number = len(self._programs)
        program = self._start(f"{text}\nenv -0 > {after}\n")
        assert program.wait(PATIENCE_SECONDS) == 0, f"{place}\n{text}\n{self._complaint(number)}"
        pairs = (pair.partition("=") for pair in after.read_text().split("\0") if pair)
        self._environment = {name: value for name, _, value in pairs}

    def _complaint(self, number: int) -> str:
        return (self.folder.parent / f"{number}.err").read_text()[-4_000:]

    def _wait_until_it_listens(self, block: Block) -> None:
        number, deadline = len(self._programs) - 1, time.monotonic() + PATIENCE_SECONDS
        while f":{self.port}" not in self._printed.read_text():
            assert self._programs[number].poll() is None, f"{block.place} ended: {self._complaint(number)}"
            assert time.monotonic() < deadline, f"{block.place} printed no address: {self._complaint(number)}"
            time.sleep(0.1)

    def _run_python(self, place: str, text: str) -> None:
        if self._python is None:
            self._python = subprocess.Popen(
                [sys.executable, "-c", INTERPRETER],
                cwd=self.folder,
                env=self._environment,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            )
        assert self._python.stdin is not None
        assert self._python.stderr is not None
        sent = {"place": place, "text": text, "environment": self._environment}
        print(json.dumps(sent), file=self._python.stdin, flush=True)
        heard = []
        for line in self._python.stderr:
            if line.startswith('{"wrong": '):
                assert json.loads(line)["wrong"] == "", f"{place}\n{json.loads(line)['wrong']}"
                return
            heard.append(line)
        raise AssertionError(f"{place}: the interpreter ended: {''.join(heard)}")

    def close(self) -> None:
        """Stop everything. A program that should run until it is stopped must still run, and stop without an error."""
        ended = [block.place for block, program in self._endless if program.poll() is not None]
        for _, program in self._endless:
            if program.poll() is None:
                os.killpg(program.pid, signal.SIGINT)
        codes = {block.place: exit_code(program) for block, program in self._endless}
        for program in self._programs:
            with suppress(ProcessLookupError):
                os.killpg(program.pid, signal.SIGKILL)
            program.wait()
        if self._python is not None:
            self._python.communicate()
        assert ended == [], "these blocks ended by themselves"
        assert set(codes.values()) <= {0, 130, -signal.SIGINT}, codes


def exit_code(program: subprocess.Popen[bytes]) -> int | None:
    """Wait for a program to end; return None if it does not."""
    try:
        return program.wait(PATIENCE_SECONDS)
    except subprocess.TimeoutExpired:
        return None


@contextmanager
def session(folder: Path) -> Iterator[Session]:
    """A session in an empty folder."""
    work = folder / "work"
    work.mkdir()
    opened = Session(work)
    try:
        yield opened
    finally:
        opened.close()
