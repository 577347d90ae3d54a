"""Writes TensorBoard events of a run, beside its checkpoint: `tensorboard --logdir FOLDER`."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

from torch.utils.tensorboard import SummaryWriter

from waypost_learner.runs.tracking.contract import Row, TrackedRun


class TensorBoard:
    """Writes events. On resumption, TensorBoard ignores earlier events of the episodes that the run repeats."""

    url = None

    def __init__(self, run: TrackedRun) -> None:
        self._writer = SummaryWriter(str(run.folder / f"{run.id}.events"), purge_step=run.first)
        if run.first == 0:
            self._writer.add_text("config", _block(run.config))

    def write(self, rows: Sequence[Row]) -> None:
        """Write the values of episodes; the step is the episode."""
        for row in rows:
            for name, value in row.values.items():
                self._writer.add_scalar(name, value, row.episode)
        self._writer.flush()

    def close(self, summary: Mapping[str, Any] | None) -> None:
        """Write the summary and close the file."""
        if summary is not None:
            self._writer.add_text("summary", _block(summary), summary["episodes"])
        self._writer.close()


def _block(values: Mapping[str, Any]) -> str:
    """Return values as a block of Markdown, which TensorBoard shows as written."""
    return "".join(f"    {line}\n" for line in json.dumps(values, indent=2).splitlines())
