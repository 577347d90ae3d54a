"""The wheel in an empty environment without Node: the tutorial works as it is written, and so does the demo."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect
from tests.acceptance.person import Person
from tests.acceptance.processes import free_port
from tests.repository.kit import ROOT
from tests.site.blocks import blocks

from waypost.client import Client
from waypost.domains import find_domain

TUTORIAL = ROOT / "docs" / "tutorial.md"
MOST_LINES = 60
PATIENCE_SECONDS = 120.0


class Terminal:
    """A shell in which commands run one after the other, as in a user's terminal. Node and npm do not work in it."""

    def __init__(self, folder: Path, stubs: Path) -> None:
        self.folder = folder
        folder.mkdir()
        stubs.mkdir()
        self.use_of_node = stubs / "used"
        for name in ("node", "npm", "npx"):
            (stubs / name).write_text(f"#!/bin/sh\ntouch {self.use_of_node}\nexit 1\n")
            (stubs / name).chmod(0o755)
        python = Path(sys.base_prefix) / "bin"
        self._shell = subprocess.Popen(
            ["bash", "-e"],
            cwd=folder,
            env={
                "PATH": f"{stubs}:{python}:/usr/bin:/bin",
                "HOME": str(Path.home()),
                "NO_COLOR": "1",
                "PIP_NO_COMPILE": "1",  # for speed: most of what PyTorch installs is never imported here
            },
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def run(self, commands: str) -> str:
        """Run commands, and return what they printed. A command that fails ends the shell."""
        assert self._shell.stdin is not None
        assert self._shell.stdout is not None
        self._shell.stdin.write(f"{commands}\necho that was all\n")
        self._shell.stdin.flush()
        printed = []
        for line in self._shell.stdout:
            if line == "that was all\n":
                return "".join(printed)
            printed.append(line)
        raise AssertionError(f"this failed, with its errors above:\n{commands}\n{''.join(printed)}")

    def close(self) -> None:
        """End everything that runs in the terminal."""
        with suppress(ProcessLookupError):
            os.killpg(self._shell.pid, signal.SIGTERM)
        self._shell.communicate()


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[Terminal]:
    """A terminal in an empty folder."""
    terminal = Terminal(tmp_path / "folder", tmp_path / "stubs")
    yield terminal
    terminal.close()


def login_link(log: Path) -> str:
    """Wait until a server has printed its link."""
    deadline = time.monotonic() + PATIENCE_SECONDS
    while not (found := re.findall(r"once.*: (http\S+)", log.read_text() if log.exists() else "")):
        assert time.monotonic() < deadline, f"no link in {log}"
        time.sleep(0.1)
    return str(found[0])


@pytest.mark.timeout(1_500)  # it installs PyTorch and trains as the tutorial says
def test_the_tutorial_and_the_demo_work_from_the_wheel_without_node(
    terminal: Terminal, tmp_path: Path, page: Page, monkeypatch: pytest.MonkeyPatch
) -> None:
    build = ["pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(tmp_path), str(ROOT)]
    subprocess.run([sys.executable, "-m", *build], check=True)
    (wheel,) = tmp_path.glob("*.whl")
    install, code, *steps = blocks(TUTORIAL)
    port = str(free_port())

    begun = time.monotonic()
    terminal.run(install.text.replace("'waypost[", f"'{wheel}["))
    installed = time.monotonic()
    (terminal.folder / str(code.file)).write_text(code.text)
    lines = len([line for line in code.text.splitlines() if line.strip()])
    assert lines <= MOST_LINES
    printed, answered = "", list[str]()
    for step in steps:
        text = step.text.replace("waypost serve", f"waypost serve --port {port}").replace("8000", port)
        if found := re.search(r"^Run (\w+):", printed, re.MULTILINE):
            text = text.replace("RUN", found[1])
        printed += terminal.run(text)
        if "--expert queue" in text:
            page.goto(login_link(terminal.folder / "serve.log"))
            page.wait_for_url("**/work")
            answered += answer_everything(page, terminal.folder, port, monkeypatch)
    minutes = (time.monotonic() - installed) / 60
    print(f"installation: {(installed - begun) / 60:.1f} min, the rest: {minutes:.1f} min, code: {lines} lines")
    assert {"hier_demo", "inspect_full"} <= set(answered)
    assert (terminal.folder / "first" / "README.md").is_file()

    terminal.run("waypost demo --port 0 --database demo.db > demo.log 2>&1 &")
    page.goto(login_link(terminal.folder / "demo.log"))
    expect(page.get_by_text(re.compile("^(Inspect|Label)_")).first).to_be_visible(timeout=PATIENCE_SECONDS * 1_000)
    assert not terminal.use_of_node.exists()


def answer_everything(page: Page, folder: Path, port: str, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Answer the tutorial's second run in the page, by keyboard and without mistakes, and return the queries' kinds."""
    monkeypatch.syspath_prepend(folder)
    with closing(Client(f"http://127.0.0.1:{port}", (folder / "learner-token").read_text().strip())) as client:
        person = Person(page, client, find_domain("taxi:domain"))

        def over() -> bool:
            return any(run.state == "finished" for run in client.runs())

        person.work_until(over)
    return list(person.answered)
