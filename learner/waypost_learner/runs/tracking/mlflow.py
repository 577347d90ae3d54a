"""Records a run with MLflow: at the server of `MLFLOW_TRACKING_URI`, or else in the file `mlflow.db`."""

import os
import time
from collections.abc import Mapping, Sequence
from typing import Any

from mlflow import MlflowClient
from mlflow.entities import Metric, Param, RunTag

from waypost_learner.runs.tracking.contract import Row, TrackedRun

TAG = "waypost.run"  # the tag that holds the id of the Waypost run
BY_UNITS = "by_units/success"  # the success rate; its step is the cost of the run in whole units
ROWS_AT_ONCE = 50  # MLflow accepts 1,000 metrics in one call


class MLflow:
    """Records a run as one MLflow run, which a resumed run finds by its tag.

    MLflow keeps every value that it is sent. So episodes that are on record are left out when a run repeats them.
    """

    def __init__(self, run: TrackedRun) -> None:
        self._client = MlflowClient()
        name = os.environ.get("MLFLOW_EXPERIMENT_NAME", "waypost")
        experiment = self._client.get_experiment_by_name(name)
        number = self._client.create_experiment(name) if experiment is None else experiment.experiment_id
        earlier = self._client.search_runs([number], f"tags.`{TAG}` = '{run.id}'")
        if earlier:
            self._id = earlier[0].info.run_id
            self._client.update_run(self._id, status="RUNNING")
        else:
            self._id = self._create(run, number)
        history = self._client.get_metric_history(self._id, "success/test")
        self._next = max((metric.step + 1 for metric in history), default=0)
        server = self._client.tracking_uri.rstrip("/")
        self.url = f"{server}/#/experiments/{number}/runs/{self._id}" if server.startswith("http") else None

    def _create(self, run: TrackedRun, experiment: str) -> str:
        tags = {TAG: run.id} | ({} if run.page is None else {"waypost.url": run.page})
        created: str = self._client.create_run(experiment, run_name=run.name, tags=tags).info.run_id
        self._client.log_batch(created, params=[Param(key, str(value)) for key, value in run.config.items()])
        return created

    def write(self, rows: Sequence[Row]) -> None:
        """Record the values of episodes that are not on record yet, many in one call."""
        new = [row for row in rows if row.episode >= self._next]
        for start in range(0, len(new), ROWS_AT_ONCE):
            chunk = new[start : start + ROWS_AT_ONCE]
            self._client.log_batch(self._id, metrics=[metric for row in chunk for metric in _metrics(row)])
            self._next = chunk[-1].episode + 1

    def close(self, summary: Mapping[str, Any] | None) -> None:
        """Record the summary as tags, and end the MLflow run."""
        if summary is not None:
            tags = [RunTag(f"final.{name}", str(value)) for name, value in summary.items()]
            self._client.log_batch(self._id, tags=tags)
        self._client.set_terminated(self._id, "FINISHED" if summary is not None else "KILLED")


def _metrics(row: Row) -> list[Metric]:
    now = int(1000 * time.time())
    by_units = Metric(BY_UNITS, row.values["success/test"], now, round(row.values["expert/total_units"]))
    return [by_units, *(Metric(name, value, now, row.episode) for name, value in row.values.items())]
