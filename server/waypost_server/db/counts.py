"""Counts of what this process has committed, for metrics. They begin at 0 when the process starts."""

import threading
from collections import Counter
from collections.abc import Mapping

Count = tuple[str, str]
"""What is counted, and which kind of it."""


class Counts:
    """Counters that threads add to. A transaction counts what it does, and its counts are added after its commit."""

    def __init__(self) -> None:
        self._counts = Counter[Count]()
        self._lock = threading.Lock()

    def add(self, more: Mapping[Count, int]) -> None:
        """Add the counts of a transaction that was committed."""
        with self._lock:
            self._counts.update(more)

    def of(self, what: str, *kinds: str) -> list[tuple[str, int]]:
        """Return the counts of these kinds, also those that are 0."""
        with self._lock:
            return [(kind, self._counts[what, kind]) for kind in kinds]
