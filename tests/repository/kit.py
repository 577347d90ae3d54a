"""What the repository's tests look at: tracked files, documents, and the command line as it is."""

import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import typer

from waypost_learner.cli import app

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = tuple(
    path for pattern in ("*.md", "docs/**/*.md", "examples/**/*.md") for path in sorted(ROOT.glob(pattern))
)

Command = Any  # typer brings its own copy of click, whose classes are private


def name_of(path: Path) -> str:
    """A path as it is written in the repository."""
    return str(path.relative_to(ROOT))


def tracked() -> list[Path]:
    """Every file git knows; without git (a release's archive) there is nothing to say about them."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=False)
    if listed.returncode != 0:
        pytest.skip("not a git checkout")
    return [ROOT / name for name in listed.stdout.decode().split("\0") if name and (ROOT / name).is_file()]


def commands(command: Command | None = None, words: tuple[str, ...] = ("waypost",)) -> Iterator[tuple[str, Command]]:
    """Yield every command of the command line with its full name."""
    command = command or typer.main.get_command(app)
    below = getattr(command, "commands", {})
    if not below:
        yield " ".join(words), command
    for word, one in below.items():
        yield from commands(one, (*words, word))


def options(command: Command) -> set[str]:
    """The long names of a command's options."""
    return {name for param in command.params for name in (*param.opts, *param.secondary_opts) if name.startswith("--")}


def complaint(line: str) -> str | None:
    """Say what is wrong with a command as somebody wrote it; nothing if the command line takes it."""
    words = shlex.split(line, comments=True)
    command: Command = typer.main.get_command(app)
    place = 1
    while place < len(words) and words[place] in getattr(command, "commands", {}):
        command = command.commands[words[place]]
        place += 1
    if getattr(command, "commands", {}):
        return None if words[place:] in ([], ["--help"]) else f"no command {words[place]!r}"
    by_name = {name: param for param in command.params for name in (*param.opts, *param.secondary_opts)}
    arguments, rest = 0, iter(words[place:])
    for word in rest:
        if not word.startswith("-"):
            arguments += 1
        elif word == "--help":
            return None
        elif word not in by_name:
            return f"no option {word}"
        elif not by_name[word].is_flag and next(rest, None) is None:
            return f"{word} lacks its value"
    wanted = sum(param.param_type_name == "argument" for param in command.params)
    return None if arguments == wanted else f"{arguments} arguments instead of {wanted}"


def invocations(text: str) -> list[str]:
    """The `waypost` commands in a shell text: alone, after assignments, or within $(...)."""
    text = text.replace("\\\n", " ").replace("$$", "$")
    found = []
    for line in text.splitlines():
        line = re.sub(r"\s#.*", "", line)
        for inner in re.findall(r"\$\((waypost [^()]*)\)", line):
            found.append(inner.strip())
        outer = re.sub(r"\$\([^()]*\)", "x", line)
        match = re.match(r"\s*(?:exec\s+)?(?:\w+=\S*\s+)*(waypost [^|&<>;]*)", outer)
        if match:
            found.append(match[1].strip())
    return found


def shell_blocks(document: Path) -> str:
    """What a document shows to be typed."""
    return "\n".join(re.findall(r"^```sh\n(.*?)^```", document.read_text(), re.MULTILINE | re.DOTALL))
