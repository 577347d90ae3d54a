"""Progress bars of the commands `train` and `domain build`. Without a terminal they show nothing."""

from dataclasses import dataclass
from typing import Any

from waypost.wire import EpisodeResult, Run
from waypost_learner.commands import progress_bar


@dataclass
class TrainingProgress:
    """The progress bar of a run, with the success rate of its last tests."""

    episodes: int

    def __enter__(self) -> "TrainingProgress":
        self._bar = progress_bar()
        self._bar.start()
        self._tests: list[bool] = []
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def start(self, run: Run, first: int) -> None:
        """Show a run, of which `first` episodes are there already."""
        self._task = self._bar.add_task(f"run {run.id}", total=self.episodes, completed=first)

    def episode(self, result: EpisodeResult, units: float) -> None:
        """Count an episode."""
        del units
        if result.test_success is not None:
            self._tests = [*self._tests, result.test_success][-100:]
        rate = sum(self._tests) / max(len(self._tests), 1)
        self._bar.update(self._task, advance=1, description=f"success {rate:.0%} (trailing {len(self._tests)})")


class BuildingProgress:
    """One progress bar for each thing that is computed."""

    def __enter__(self) -> "BuildingProgress":
        self._bar, self._tasks = progress_bar(), dict[str, Any]()
        self._bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.stop()

    def show(self, what: str, done: int, known: int) -> None:
        """Show that `done` of the `known` parts of something are computed."""
        if what not in self._tasks:
            self._tasks[what] = self._bar.add_task(what)
        self._bar.update(self._tasks[what], completed=done, total=known)
