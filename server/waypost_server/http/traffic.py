"""How long this process took to answer the requests of each operation, and how they ended."""

from bisect import bisect_left
from collections import Counter, defaultdict
from collections.abc import Sequence

BOUNDS = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0)  # in seconds
UNKNOWN = "none"  # the operation of a request that reaches none: a file of the web app, an unknown address, a refusal


class Traffic:
    """Counts the requests of each operation, by the class of their status and by the time to the head of the reply."""

    def __init__(self) -> None:
        self.requests = Counter[tuple[str, str]]()  # by operation and class of status: ("lease", "2xx")
        self.seconds = defaultdict[str, float](float)  # the sum for each operation
        self._buckets = defaultdict[str, list[int]](lambda: [0] * (len(BOUNDS) + 1))

    def count(self, operation: str | None, status: int, seconds: float) -> None:
        """Count a request."""
        name = operation or UNKNOWN
        self.requests[name, f"{status // 100}xx"] += 1
        self.seconds[name] += seconds
        self._buckets[name][bisect_left(BOUNDS, seconds)] += 1

    def at_most(self, operation: str) -> Sequence[tuple[str, int]]:
        """Return for each bound how many requests of an operation took at most so long; the last is for all."""
        total, found = 0, list[tuple[str, int]]()
        for bound, n in zip((*map(str, BOUNDS), "+Inf"), self._buckets[operation], strict=True):
            total += n
            found.append((bound, total))
        return found
