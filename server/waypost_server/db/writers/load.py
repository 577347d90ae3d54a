"""How much a writer has to do. With all places taken, the next transaction is refused."""

import threading
from concurrent.futures import Future
from typing import Any

from waypost_server import errors

# Far more than wait in a store that keeps up. Each keeps its request in memory, and the last one waits for all others.
MOST_WAITING = 1_000


class Load:
    """The places of transactions that wait or run, and the commits so far."""

    def __init__(self) -> None:
        self.waiting = 0
        self.commits = 0
        self.transactions = 0
        self.largest = 0  # the most transactions that one commit had
        self._lock = threading.Lock()

    def take(self) -> None:
        """Take a place.

        Raises:
            StoreBusy: there is none.
        """
        with self._lock:
            if self.waiting >= MOST_WAITING:
                raise errors.StoreBusy(
                    "Too many requests wait to be stored, so nothing was stored; send the same request again.",
                    retry_after=1,
                )
            self.waiting += 1

    def leave(self, _future: Future[Any]) -> None:
        """Free the place of a transaction that is done."""
        with self._lock:
            self.waiting -= 1

    def committed(self, n: int) -> None:
        """Count a commit of so many transactions."""
        with self._lock:
            self.commits += 1
            self.transactions += n
            self.largest = max(self.largest, n)
