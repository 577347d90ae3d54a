"""What the learner's commands share: options, and what can go wrong said in one sentence.

Quick to import, like every module of commands.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from waypost_server.cli import refuse
from waypost_server.db.engine import BadDatabase
from waypost_server.db.schema import NewerStore
from waypost_server.serving import CannotServe

ServerOption = Annotated[str | None, typer.Option("--server", help="A running server, such as http://127.0.0.1:8000.")]
TokenOption = Annotated[
    str,
    typer.Option("--token", envvar="WAYPOST_TOKEN", help="An API token (`waypost token create`).", show_default=False),
]
PatienceOption = Annotated[
    float, typer.Option(min=0, help="How long to go on when the server does not answer, seconds.")
]


@contextmanager
def learner_errors(interrupted: str = "Interrupted.") -> Iterator[None]:
    """Turn what can go wrong into one sentence: exit 2 for wrong usage, 1 for what failed.

    Args:
        interrupted: what is said after Ctrl-C.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        refuse(f"This needs the package {error.name}: install the learner with `pip install 'waypost[learner]'`.")
    except (ValueError, BadDatabase, NewerStore, CannotServe) as error:
        refuse(_sentence(error))
    except KeyboardInterrupt:
        typer.echo(interrupted, err=True)
        raise typer.Exit(130) from None
    except Exception as error:
        from waypost.client import Refused, Unreachable

        if isinstance(error, Refused | Unreachable):
            typer.echo(_sentence(error), err=True)
            raise typer.Exit(1) from None
        raise


def needed(token: str) -> str:
    """Return a token, or say that one must be given."""
    if not token:
        refuse("The server wants a token: give --token or set WAYPOST_TOKEN (`waypost token create USER` makes one).")
    return token


def _sentence(error: Exception) -> str:
    text = str(error)
    if text.split(maxsplit=1)[0].isalpha():  # not the name of a file
        text = text[:1].upper() + text[1:]
    return text if text.endswith((".", "?")) else f"{text}."


def checkpoint_folder(given: Path | None, store: Path | None, server: str | None) -> Path:
    """Return where checkpoints are: the folder given, else beside the store, else ./checkpoints."""
    if given is not None:
        return given
    if server is not None:
        return Path("checkpoints")
    store = store or Path("waypost.db")
    return store.with_name(f"{store.name}.checkpoints")


def progress_bar() -> Progress:
    """Return a bar on a terminal; nothing elsewhere."""
    console = Console(stderr=True)
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
        console=console,
        disable=not console.is_terminal,
    )
