"""Options, errors and progress bars that the learner's commands share.

Modules of commands must import quickly, so they import the learner's packages only when a command runs.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, NoReturn

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

ServerOption = Annotated[str | None, typer.Option("--server", help="A running server, such as http://127.0.0.1:8000.")]
TokenOption = Annotated[
    str,
    typer.Option("--token", envvar="WAYPOST_TOKEN", help="An API token (`waypost token create`).", show_default=False),
]
PatienceOption = Annotated[
    float, typer.Option(min=0, help="Seconds for which to try again when the server does not answer.")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print the result as one line of JSON.")]


def refuse(message: str) -> NoReturn:
    """Print what is wrong with the command line, and exit with status 2."""
    typer.echo(message, err=True)
    raise typer.Exit(2)


@contextmanager
def learner_errors(interrupted: str = "Interrupted.") -> Iterator[None]:
    """Turn errors into one sentence on standard error.

    The exit status is 2 for a ValueError or a missing package, 1 if the server refused or did not answer, and 130 after
    Ctrl-C.

    Args:
        interrupted: printed after Ctrl-C.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        extra, what = ("atari", "it") if error.name == "ale_py" else ("learner", "the learner")
        refuse(f"This needs the package {error.name}: install {what} with `pip install 'waypost[{extra}]'`.")
    except ValueError as error:
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
    """Return a token; refuse an empty one."""
    if not token:
        refuse("The server needs a token: give --token or set WAYPOST_TOKEN (`waypost token create USER` makes one).")
    return token


def _sentence(error: Exception) -> str:
    text = str(error)
    if text.split(maxsplit=1)[0].isalpha():  # a word, not a file name
        text = text[:1].upper() + text[1:]
    return text if text.endswith((".", "?")) else f"{text}."


def checkpoint_folder(given: Path | None, store: Path | None, server: str | None) -> Path:
    """Return the folder of checkpoints.

    Args:
        given: the folder that the user named; it is returned unless it is None.
        store: the SQLite file; checkpoints are beside it unless there is a server. "waypost.db" if None.
        server: the server's address; with a server, checkpoints are in "checkpoints".
    """
    if given is not None:
        return given
    if server is not None:
        return Path("checkpoints")
    store = store or Path("waypost.db")
    return store.with_name(f"{store.name}.checkpoints")


def progress_bar() -> Progress:
    """Return a progress bar that shows nothing if standard error is not a terminal."""
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
