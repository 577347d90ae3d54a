"""Measure what labels bought: the success of a run's policies on given instances, after each change of their weights.

The test after each episode is free, but it needs a hundred episodes for one rate. This measurement takes computing
time instead: each row of its file is a rate over all the given instances, beside what the answers had cost by then.
"""

import csv
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.runs.checkpoints import weights_hash
from waypost_learner.runs.evaluation import evaluate

COLUMNS = ("episode", "units", "episodes", "successes")


class Measuring:
    """Writes a row after an episode if the weights have changed since the last row.

    Args:
        learner: the learner of the run.
        instances: the instances to measure on; each is rolled out once.
        file: the CSV file to write. A resumed run continues it.
        first: the run's first episode in this process. Rows of it and of later episodes are written again.
        units: returns the cost of all answers of the run.
        every: the number of episodes from one possible row to the next.
    """

    def __init__(
        self,
        learner: Learner,
        instances: Sequence[Any],
        file: Path,
        first: int,
        units: Callable[[], float],
        every: int = 1,
    ) -> None:
        self._learner, self._instances, self._file, self._units, self._every = learner, instances, file, units, every
        self._weights = ""
        kept = [row for row in _rows(file) if int(row[0]) < first]
        file.parent.mkdir(parents=True, exist_ok=True)
        with file.open("w", newline="") as opened:
            csv.writer(opened, lineterminator="\n").writerows([COLUMNS, *kept])

    def after(self, episode: int) -> None:
        """Measure the policies after an episode, if it is one to measure after and their weights have changed."""
        if (episode + 1) % self._every == 0:
            self.now(episode)

    def now(self, episode: int) -> None:
        """Measure the policies if their weights have changed; at the end, `episode` is the number of all episodes."""
        weights = weights_hash(self._learner)
        if weights == self._weights:
            return
        self._weights = weights
        found = evaluate(self._learner, self._instances, len(self._instances))
        with self._file.open("a", newline="") as opened:
            row = (episode, f"{self._units():g}", found.episodes, found.successes)
            csv.writer(opened, lineterminator="\n").writerow(row)


def _rows(file: Path) -> list[list[str]]:
    if not file.exists():
        return []
    with file.open(newline="") as opened:
        return list(csv.reader(opened))[1:]
