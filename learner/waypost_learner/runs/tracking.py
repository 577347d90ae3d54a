"""Write TensorBoard events of a run, beside its checkpoint: `tensorboard --logdir FOLDER`."""

from pathlib import Path
from types import TracebackType

from torch.utils.tensorboard import SummaryWriter

from waypost import wire


class Tracker:
    """Writes the results of episodes as events. Use it as a context manager.

    Args:
        folder: the folder of this run's events.
        first: the first episode of this process; existing events of this and of later episodes are deleted.
    """

    def __init__(self, folder: Path, first: int) -> None:
        self._writer = SummaryWriter(str(folder), purge_step=first)
        self._tests: list[bool] = []

    def __enter__(self) -> "Tracker":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._writer.close()

    def episode(self, result: wire.EpisodeResult, units: float) -> None:
        """Write the events of one episode, whose answers cost `units`."""
        if result.test_success is not None:
            self._tests = [*self._tests, result.test_success][-100:]
        values = {
            # over the last 100 tests, or fewer at the start
            "success/test": sum(self._tests) / max(len(self._tests), 1),
            "expert/units": units,
            "labels/hi": result.hi_labels,
            "labels/lo": result.lo_labels,
            "steps/train": result.train_steps,
            "steps/test": result.test_steps,
            "seconds": result.seconds,
        }
        if result.train_success is not None:
            values["success/train"] = float(result.train_success)
        for name, value in values.items():
            self._writer.add_scalar(name, value, result.episode)
