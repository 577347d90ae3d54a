"""Records a run with Weights & Biases. Its own environment variables, such as `WANDB_MODE=offline`, apply."""

import os
from collections.abc import Mapping, Sequence
from typing import Any

import wandb

from waypost_learner.runs.tracking.contract import Row, TrackedRun

BY_UNITS = "by_units/"
"""The prefix of the values that are drawn against the units spent. All other values are drawn against the episode."""


class WandB:
    """Records a run under the id of the Waypost run, so that a resumed run continues the same record.

    Rows of W&B cannot be replaced. So episodes that an earlier process recorded are left out when a run repeats them.
    Online, W&B knows their number. Offline it does not: episodes that an earlier process reported count as recorded.
    """

    def __init__(self, run: TrackedRun) -> None:
        run.folder.mkdir(parents=True, exist_ok=True)
        quiet = wandb.Settings(console="off", silent=True, disable_git=True, save_code=False)
        about = {"waypost/run": run.id} | ({} if run.page is None else {"waypost/url": run.page})
        self._run = wandb.init(
            id=run.id,
            project=os.environ.get("WANDB_PROJECT", "waypost"),
            name=run.name,
            config=dict(run.config) | about,
            dir=str(run.folder.resolve()),  # W&B writes from another process
            resume="allow",
            reinit="create_new",
            settings=quiet,
        )
        self._next = run.reported if self._run.offline else self._run.step
        self.url = None if self._run.offline else self._run.url
        self._run.define_metric("episode")
        self._run.define_metric("expert/total_units")
        self._run.define_metric("*", step_metric="episode")
        self._run.define_metric(f"{BY_UNITS}*", step_metric="expert/total_units")

    def write(self, rows: Sequence[Row]) -> None:
        """Record the values of episodes that are not on record yet."""
        for row in rows:
            if row.episode < self._next:
                continue
            by_units = {f"{BY_UNITS}success": row.values["success/test"]}
            self._run.log({"episode": row.episode, **row.values, **by_units}, step=row.episode, commit=True)
            self._next = row.episode + 1

    def close(self, summary: Mapping[str, Any] | None) -> None:
        """Record the summary, and wait until W&B has stored everything."""
        if summary is not None:
            self._run.summary.update({f"final/{name}": value for name, value in summary.items()})
        self._run.finish(exit_code=0 if summary is not None else 1)
