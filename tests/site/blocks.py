"""The code blocks of the documents, and what a comment before a block says about running it in a test.

A block is run as it is written. A comment on the line before it can change this; readers do not see it:

    <!-- not run: REASON; FILE -->                         FILE is the test that checks this instead
    <!-- tested with `NEW` instead of `OLD` -->            for example less training
    <!-- tested with a short training -->                  every `waypost train` runs two episodes with little training
    <!-- runs until it is stopped -->                      the rest of the page runs beside it
    <!-- saved as `FILE` -->                               the block is a file, which later blocks use

docs/client.md is one program, which tests/repository/test_client_page.py runs beside a bot.

A block with `waypost sweep` takes hours, so it is not run, either. Below the title of a page, the comment `<!-- tested
beside a server with a query -->` starts a server first.
"""

import re
from dataclasses import dataclass
from itertools import repeat
from pathlib import Path

from markdown_it import MarkdownIt
from tests.repository.kit import DOCUMENTS, ROOT, name_of

PAGES = (*(page for page in DOCUMENTS if page != ROOT / "docs" / "client.md"), ROOT / "bench" / "RESULTS.md")
LANGUAGES = {"sh", "python", "json", "toml", "yaml", "text"}  # text is what a program prints

_COMMENT = re.compile(r"<!-- (.+?) -->", re.DOTALL)
_NOT_RUN = re.compile(r"not run: (.+); (\S+)")
_INSTEAD = re.compile(r"tested with `([^`]+)` instead of `([^`]+)`")
_SAVED = re.compile(r"saved as `([^`]+)`")
_BESIDE = "<!-- tested beside a server with a query -->"


@dataclass(frozen=True)
class Block:
    """A code block, with the comments before it."""

    place: str  # such as README.md:10
    language: str
    text: str
    comments: tuple[str, ...] = ()

    @property
    def unknown_comments(self) -> list[str]:
        """The comments that this module does not know."""
        known = {"tested with a short training", "runs until it is stopped"}
        patterns = (_NOT_RUN, _INSTEAD, _SAVED)
        return [
            one
            for one in self.comments
            if one not in known and not any(map(re.Pattern.fullmatch, patterns, repeat(one)))
        ]

    @property
    def not_run(self) -> tuple[str, Path] | None:
        """Why the block is not run, and the test that checks it instead."""
        if "waypost sweep" in self.text:
            return "a sweep takes hours", ROOT / "tests" / "learner" / "experiments" / "test_sweep.py"
        found = next(filter(None, map(_NOT_RUN.fullmatch, self.comments)), None)
        return (found[1], ROOT / found[2]) if found else None

    @property
    def file(self) -> str | None:
        """The name of the file that the reader saves the block as."""
        found = next(filter(None, map(_SAVED.fullmatch, self.comments)), None)
        return found[1] if found else None

    @property
    def endless(self) -> bool:
        """Whether the block runs until it is stopped."""
        return "runs until it is stopped" in self.comments

    @property
    def tested(self) -> str:
        """The text to run: the block's text with the replacements that its comments name."""
        text = self.text
        for one in self.comments:
            if found := _INSTEAD.fullmatch(one):
                assert found[2] in text, f"{self.place}: the block does not contain {found[2]}"
                text = text.replace(found[2], found[1])
        return shortened(text) if "tested with a short training" in self.comments else text


def shortened(text: str) -> str:
    """Return the text with two episodes and little training in every `waypost train`."""
    lines = []
    for line in text.splitlines():
        if "waypost train" in line:
            line = re.sub(r"--episodes \d+", "", line)
            values = re.search(r'--values "([^"]*)"', line)
            line = line.replace(values[0], "") if values else line
            networks = ("shared",) if "--preset general" in line else ("hi", "lo")
            little = " ".join(f"train_{one}.{rows}=64" for one in networks for rows in ("least", "most", "idle"))
            short = f'--episodes 2 --threads 1 --values "{values[1] if values else ""} {little}"'
            line = re.sub(r"(waypost train [\w-]+)", rf"\1 {short}", line)
        lines.append(line)
    return "\n".join(lines)


def blocks(page: Path) -> list[Block]:
    """Return the code blocks of a document, in their order."""
    found, comments = [], list[str]()
    for token in MarkdownIt("commonmark").parse(page.read_text()):
        if token.type == "html_block":
            comments += _COMMENT.findall(token.content)
        elif token.type == "fence":
            assert token.map is not None
            place = f"{name_of(page)}:{token.map[0] + 1}"
            found.append(
                Block(place, token.info.strip(), token.content, tuple(" ".join(one.split()) for one in comments))
            )
            comments = []
        else:
            comments = []
    return found


def beside_server(page: Path) -> bool:
    """Return whether a page is tested beside a server with a query."""
    return _BESIDE in page.read_text()
