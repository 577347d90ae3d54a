"""Runs a logger on a thread of its own, so that a slow or failing logger neither stops nor slows the training."""

import threading
from collections.abc import Callable, Mapping
from queue import Empty, SimpleQueue
from typing import Any

from waypost_learner.runs.tracking.contract import Logger, Row

PATIENCE_SECONDS = 60.0  # how long a run that ends waits for each of its loggers

Tell = Callable[[str], None]
"""Shows a sentence to the user."""


class Background:
    """A logger on its own thread. Rows that arrive while it is busy are written together.

    After its first error the logger is out of use: the user is told once, and the training goes on.

    Args:
        name: the name of the logger, as the user knows it.
        start: opens the logger; called on the thread.
        tell: shows the address of the record, or an error, to the user.
    """

    def __init__(self, name: str, start: Callable[[], Logger], tell: Tell) -> None:
        self._name, self._start, self._tell = name, start, tell
        self._rows: SimpleQueue[Row | None] = SimpleQueue()
        self._summary: Mapping[str, Any] | None = None
        # A daemon: a logger that hangs does not keep the process from ending.
        self._thread = threading.Thread(target=self._work, name=f"waypost-log-{name}", daemon=True)
        self._thread.start()

    def write(self, row: Row) -> None:
        """Pass a row on."""
        self._rows.put(row)

    def close(self, summary: Mapping[str, Any] | None) -> None:
        """Pass the summary on, and wait until the logger has written everything, at most `PATIENCE_SECONDS`."""
        self._summary = summary
        self._rows.put(None)
        self._thread.join(PATIENCE_SECONDS)
        if self._thread.is_alive():
            self._tell(f"{self._name} did not finish within {PATIENCE_SECONDS:g} seconds; its record may lack values.")

    def _work(self) -> None:
        try:
            logger = self._start()
            if logger.url is not None:
                self._tell(f"{self._name} shows this run at {logger.url}.")
            ended = False
            while not ended:
                rows, ended = self._waiting()
                if rows:
                    logger.write(rows)
            logger.close(self._summary)
        except Exception as error:  # whatever a logger does, the run goes on
            cause = str(error).strip().partition("\n")[0] or type(error).__name__
            self._tell(f"{self._name} no longer records this run ({cause}); the training goes on.")

    def _waiting(self) -> tuple[list[Row], bool]:
        """Return all waiting rows, after waiting for the first, and whether they are the last."""
        rows, row = list[Row](), self._rows.get()
        while row is not None:
            rows.append(row)
            try:
                row = self._rows.get_nowait()
            except Empty:
                return rows, False
        return rows, True
