"""Records a run with the loggers that the user chose by name."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from types import TracebackType
from typing import Any

from waypost import wire
from waypost_learner.runs.tracking.background import Background, Tell
from waypost_learner.runs.tracking.contract import Logger, Rows, TrackedRun


@dataclass(frozen=True)
class Known:
    """A logger that users can choose: its module and class, and the package and the extra that it needs."""

    module: str
    name: str
    package: str
    extra: str

    def opener(self, run: TrackedRun) -> Callable[[], Logger]:
        """Return a function that imports the logger and opens it for a run."""
        return lambda: getattr(import_module(f"waypost_learner.runs.tracking.{self.module}"), self.name)(run)


LOGGERS = {
    "tensorboard": Known("tensorboard", "TensorBoard", "tensorboard", "learner"),
    "wandb": Known("wandb", "WandB", "wandb", "wandb"),
    "mlflow": Known("mlflow", "MLflow", "mlflow", "mlflow"),
}
"""The loggers by the name that the user gives. Their modules are imported only when they are used."""


def check(names: Sequence[str]) -> None:
    """Refuse loggers that do not exist or whose package is not installed.

    Raises:
        ValueError: says which loggers there are, or how to install the package.
    """
    for name in names:
        known = LOGGERS.get(name)
        if known is None:
            raise ValueError(f"there is no logger {name!r}; the loggers are: {', '.join(LOGGERS)}")
        if find_spec(known.package) is None:
            raise ValueError(
                f"logging with {name} needs the package {known.package}: `pip install 'waypost[{known.extra}]'`"
            )


class Tracker:
    """Records the episodes of one run with several loggers. Use it as a context manager.

    Args:
        names: the names of the loggers; see `check`.
        run: the run.
        rows: the sums of the run so far.
        tell: shows a sentence of a logger to the user.
    """

    def __init__(self, names: Sequence[str], run: TrackedRun, rows: Rows, tell: Tell) -> None:
        chosen = dict.fromkeys(names)
        self._loggers = [Background(LOGGERS[name].name, LOGGERS[name].opener(run), tell) for name in chosen]
        self._rows = rows
        self._summary: dict[str, Any] | None = None

    def __enter__(self) -> "Tracker":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for logger in self._loggers:
            logger.close(self._summary)

    def episode(self, result: wire.EpisodeResult, units: float) -> None:
        """Record an episode, whose answers cost `units`."""
        row = self._rows.row(result, units)
        for logger in self._loggers:
            logger.write(row)

    def finish(self, summary: dict[str, Any]) -> None:
        """Record the summary of the run when the tracker closes."""
        self._summary = summary
