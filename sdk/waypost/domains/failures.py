"""Says in one sentence where the code of a domain's author failed."""

import traceback
from pathlib import Path


class DomainFailed(ValueError):
    """A function of a domain raised an exception, or returned what it must not. The message is for its author."""


def explained(what: str, error: Exception) -> str:
    """Return where an exception was raised, and why.

    Args:
        what: what was done, such as "step".
        error: the exception.
    """
    ours = str(Path(__file__).parent)
    frames = traceback.extract_tb(error.__traceback__)
    last = next((frame for frame in reversed(frames) if not frame.filename.startswith(ours)), frames[-1])
    place = f"{Path(last.filename).name}, line {last.lineno}, in {last.name}"
    return f"{what} raised {type(error).__name__}: {error} ({place})"
