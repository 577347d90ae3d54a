"""Shows the progress of long work: in a terminal, in a notebook, and nowhere else."""

from collections.abc import Iterable, Sequence
from importlib.util import find_spec
from typing import TypeVar

T = TypeVar("T")


def progress(items: Sequence[T], doing: str) -> Iterable[T]:
    """Return the items, with a progress bar that counts them as they are taken.

    Args:
        items: the items.
        doing: what happens to them, such as "Waiting for answers".
    """
    from rich.console import Console
    from rich.progress import track

    console = Console()
    shows = find_spec("ipywidgets") is not None if console.is_jupyter else console.is_terminal
    return track(items, doing, console=console, transient=True, disable=not shows)
