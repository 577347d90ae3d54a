"""Loggers: every episode is recorded once, at its cost, also over an interruption; and no logger stops a run."""

import json
import math
import struct
import sys
import threading
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from tensorboard.backend.event_processing.event_accumulator import EventAccumulator
from tests.learner.kit import corridor, store
from typer.testing import CliRunner

from waypost_learner.cli import app
from waypost_learner.remote.in_process import InProcessTransport
from waypost_learner.runs import driver
from waypost_learner.runs.tracking import background, tracker
from waypost_learner.runs.tracking.contract import Row, TrackedRun
from waypost_learner.runs.training import RunOptions, train

# MLflow's own use of SQLAlchemy.
pytestmark = pytest.mark.filterwarnings("ignore:The ``noload`` loader strategy:DeprecationWarning")

EPISODES = 12
Values = dict[str, float]


class Interrupted(BaseException):
    """The end of the learner's process."""


@pytest.fixture(autouse=True)
def without_network(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("WANDB_MODE", "offline")
    monkeypatch.setenv("WANDB_X_DISABLE_STATS", "true")
    monkeypatch.setenv("MLFLOW_TRACKING_URI", f"sqlite:///{tmp_path / 'mlflow.db'}")
    monkeypatch.setenv("MLFLOW_DISABLE_TELEMETRY", "true")
    monkeypatch.setattr(driver, "CHECKPOINT_EVERY", 4)


# --- read the records back


def wandb_records(folder: Path, run: str) -> Iterator[Any]:
    """Yield the records of the files of an offline run. The format is LevelDB's log: blocks of 32 KiB."""
    from wandb.proto.wandb_internal_pb2 import Record

    for file in sorted(folder.glob(f"wandb/offline-run-*/run-{run}.wandb")):
        data, place, parts = file.read_bytes(), 7, b""
        while place + 7 <= len(data):
            if (left := 32_768 - place % 32_768) < 7:
                place += left
                continue
            _crc, length, kind = struct.unpack("<IHB", data[place : place + 7])
            parts += data[place + 7 : place + 7 + length]
            place += 7 + length
            if kind in (1, 4):  # a whole record, or the last part of one
                record = Record()
                record.ParseFromString(parts)
                parts = b""
                yield record


def wandb_rows(folder: Path, run: str) -> list[Values]:
    rows = []
    for record in wandb_records(folder, run):
        if record.WhichOneof("record_type") == "history":
            items = record.history.item
            rows.append({item.key or "/".join(item.nested_key): json.loads(item.value_json) for item in items})
    return rows


def mlflow_history(run: str, name: str) -> list[tuple[int, float]]:
    from mlflow import MlflowClient

    client = MlflowClient()
    experiment = client.get_experiment_by_name("waypost")
    assert experiment is not None
    (found,) = client.search_runs([experiment.experiment_id], f"tags.`waypost.run` = '{run}'")
    return [(metric.step, metric.value) for metric in client.get_metric_history(found.info.run_id, name)]


def tensorboard_history(folder: Path, run: str, name: str) -> list[tuple[int, float]]:
    events = EventAccumulator(str(folder / f"{run}.events"), {"scalars": 0})
    events.Reload()
    return [(event.step, event.value) for event in events.Scalars(name)]


def train_interrupted(connection: Any, options: RunOptions, *, after: int, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Train until `after` episodes are reported, end as if the process ended, then resume to the end."""
    original, reports = InProcessTransport.handle_request, 0

    def handle(transport: InProcessTransport, request: Any) -> Any:
        nonlocal reports
        reports += request.url.path.endswith("/episodes")
        if reports > after:
            raise Interrupted
        return original(transport, request)

    with monkeypatch.context() as patch:
        patch.setattr(InProcessTransport, "handle_request", handle)
        with pytest.raises(Interrupted):
            train(corridor(episodes=EPISODES), connection, options)
    return train(corridor(episodes=EPISODES), connection, replace(options, resume=True))


# --- what is recorded


@pytest.mark.parametrize("resumed", [False, True])
@pytest.mark.parametrize("logger", ["tensorboard", "wandb", "mlflow"])
def test_every_episode_is_recorded_once_with_the_cost_of_the_ledger(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, logger: str, resumed: bool
) -> None:
    with store(tmp_path) as (connection, options):
        options = replace(options, loggers=(logger,))
        if resumed:  # after episode 6; the checkpoint is of episode 4, so episodes 4 and 5 are repeated
            summary = train_interrupted(connection, options, after=6, monkeypatch=monkeypatch)
        else:
            summary = train(corridor(episodes=EPISODES), connection, options)
        curves = connection.learner.curves(summary["run"])
    run, expected = summary["run"], dict(zip(curves.episode, curves.cost, strict=True))
    if logger == "wandb":
        rows = wandb_rows(options.checkpoints, run)
        found = [(int(row["episode"]), row["expert/total_units"]) for row in rows]
        rates = [row["success/test"] for row in rows]
    elif logger == "mlflow":
        found, rates = mlflow_history(run, "expert/total_units"), [v for _, v in mlflow_history(run, "success/test")]
    else:
        found = tensorboard_history(options.checkpoints, run, "expert/total_units")
        rates = [value for _, value in tensorboard_history(options.checkpoints, run, "success/test")]
    assert [episode for episode, _ in found] == list(range(EPISODES))
    assert {episode: round(units, 3) for episode, units in found} == expected
    assert rates == pytest.approx(curves.success_rate)


def test_wandb_draws_success_against_the_episode_and_against_the_units_spent(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        options = replace(options, loggers=("wandb",), server="http://127.0.0.1:8000/")
        summary = train(corridor(episodes=2), connection, options)
    run = summary["run"]
    records = list(wandb_records(options.checkpoints, run))
    metrics = [record.metric for record in records if record.WhichOneof("record_type") == "metric"]
    steps = {metric.name or metric.glob_name: metric.step_metric for metric in metrics}
    assert steps["*"] == "episode"
    assert steps["by_units/*"] == "expert/total_units"
    rows = wandb_rows(options.checkpoints, run)
    assert [row["by_units/success"] for row in rows] == [row["success/test"] for row in rows]
    (begun,) = [record.run for record in records if record.WhichOneof("record_type") == "run"][:1]
    config = {item.key: json.loads(item.value_json) for item in begun.config.update}
    assert begun.run_id == run
    assert (config["algorithm"], config["seed"], config["waypost/run"]) == ("hg-dagger", 1, run)
    assert config["waypost/url"] == f"http://127.0.0.1:8000/runs/{run}"
    final = {
        item.key or item.nested_key[0]: json.loads(item.value_json)
        for record in records
        if record.WhichOneof("record_type") == "summary"
        for item in record.summary.update
    }
    assert final["final/weights"] == summary["weights"]
    assert final["final/success_rate"] == summary["success_rate"]


def test_mlflow_has_the_configuration_the_summary_and_success_by_units(tmp_path: Path) -> None:
    from mlflow import MlflowClient

    with store(tmp_path) as (connection, options):
        summary = train(corridor(episodes=3), connection, replace(options, loggers=("mlflow",), name="mine"))
        curves = connection.learner.curves(summary["run"])
    (run,) = MlflowClient().search_runs(["1"])
    assert (run.info.run_name, run.info.status) == ("mine", "FINISHED")
    assert (run.data.params["algorithm"], run.data.params["seed"]) == ("hg-dagger", "1")
    assert run.data.tags["final.weights"] == summary["weights"]
    by_units = mlflow_history(summary["run"], "by_units/success")
    assert sorted(step for step, _ in by_units) == [round(cost) for cost in curves.cost]


def test_an_interrupted_run_is_marked_in_mlflow_until_it_is_resumed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from mlflow import MlflowClient

    states = []
    with store(tmp_path) as (connection, options):
        options = replace(options, loggers=("mlflow",))
        original = tracker.Tracker.__exit__

        def exit_and_look(one: tracker.Tracker, *about: Any) -> None:
            original(one, *about)
            (run,) = MlflowClient().search_runs(["1"])
            states.append(run.info.status)

        monkeypatch.setattr(tracker.Tracker, "__exit__", exit_and_look)
        train_interrupted(connection, options, after=6, monkeypatch=monkeypatch)
    assert states == ["KILLED", "FINISHED"]


def test_tensorboard_has_the_configuration_and_the_summary(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        summary = train(corridor(episodes=2), connection, options)
    events = EventAccumulator(str(options.checkpoints / f"{summary['run']}.events"))
    events.Reload()
    texts = {
        tag.removesuffix("/text_summary"): events.Tensors(tag)[0].tensor_proto.string_val[0].decode()
        for tag in events.Tags()["tensors"]
    }
    assert '"algorithm": "hg-dagger"' in texts["config"]
    assert summary["weights"] in texts["summary"]


# --- what goes wrong


class Failing:
    """A logger that fails when it is opened, at its third episode, or at the end."""

    url = "https://logs.example.org/1"

    def __init__(self, at: str) -> None:
        self._at, self._rows = at, 0
        if at == "start":
            raise ConnectionError("the network is down")

    def write(self, rows: Sequence[Row]) -> None:
        self._rows += len(rows)
        if self._at == "write" and self._rows >= 3:
            raise ConnectionError("the network is down")

    def close(self, _summary: Mapping[str, Any] | None) -> None:
        if self._at == "close":
            raise ConnectionError("the network is down")


def use(monkeypatch: pytest.MonkeyPatch, opened: Any) -> None:
    """Make `--log wandb` open this logger."""
    monkeypatch.setattr(tracker.Known, "opener", lambda _, run: lambda: opened(run))


@pytest.mark.parametrize("at", ["start", "write", "close"])
def test_a_failing_logger_says_so_once_and_the_run_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, at: str
) -> None:
    use(monkeypatch, lambda _run: Failing(at))
    said: list[str] = []
    with store(tmp_path) as (connection, options):
        summary = train(corridor(episodes=6), connection, replace(options, loggers=("wandb",)), tell=said.append)
        assert connection.learner.run(summary["run"]).state == "finished"
    assert summary["episodes"] == 6
    assert said[-1] == "WandB no longer records this run (the network is down); the training goes on."
    assert said[:-1] == ([] if at == "start" else ["WandB shows this run at https://logs.example.org/1."])


def test_a_logger_that_hangs_neither_slows_the_run_nor_keeps_it_from_ending(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    let_go = threading.Event()

    def hang(_run: TrackedRun) -> Any:
        let_go.wait()
        raise ConnectionError("too late")

    use(monkeypatch, hang)
    monkeypatch.setattr(background, "PATIENCE_SECONDS", 0.1)
    said: list[str] = []
    with store(tmp_path) as (connection, options):
        summary = train(corridor(episodes=3), connection, replace(options, loggers=("wandb",)), tell=said.append)
    try:
        assert summary["episodes"] == 3
        assert said == ["WandB did not finish within 0.1 seconds; its record may lack values."]
    finally:
        let_go.set()


def test_loggers_are_named_one_by_one_or_in_a_list(tmp_path: Path) -> None:
    arguments = ["train", "hg-dagger", "--domain", "corridor", "--preset", "tiny", "--episodes", "1", "--json"]
    done = CliRunner().invoke(app, [*arguments, "--store", "s.db", "--log", "tensorboard,mlflow", "--log", "wandb"])
    assert done.exit_code == 0, done.output
    run = json.loads(done.stdout)["run"]
    folder = Path("s.db.checkpoints")
    assert [step for step, _ in tensorboard_history(folder, run, "seconds")] == [0]
    assert [step for step, _ in mlflow_history(run, "seconds")] == [0]
    assert [row["episode"] for row in wandb_rows(folder, run)] == [0]
    assert math.isfinite(wandb_rows(folder, run)[0]["seconds"])


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("wandb", "Logging with wandb needs the package wandb: `pip install 'waypost[wandb]'`."),
        ("mlflow", "Logging with mlflow needs the package mlflow: `pip install 'waypost[mlflow]'`."),
        ("comet", "There is no logger 'comet'; the loggers are: tensorboard, wandb, mlflow."),
    ],
)
def test_a_logger_that_is_not_there_is_refused_before_anything_is_written(
    monkeypatch: pytest.MonkeyPatch, name: str, sentence: str
) -> None:
    monkeypatch.setitem(sys.modules, name, None)
    done = CliRunner().invoke(app, ["train", "h-bc", "--domain", "corridor", "--log", name])
    assert (done.exit_code, done.stderr.strip()) == (2, sentence)
    assert list(Path().iterdir()) == []
