"""Trains many runs in parallel for `waypost sweep`, on this machine's cores or on a Ray cluster.

A sweep has no state of its own: the store knows which runs are finished, and each other run continues from its
checkpoint. So the same command continues an interrupted sweep.
"""

import fcntl
import os
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import joblib

from waypost import wire
from waypost_learner.experiments.plan import name_of
from waypost_learner.remote.connection import Connection, connected
from waypost_learner.remote.embedded import embedded
from waypost_learner.runs.config import TrainConfig, config_values, settings_of
from waypost_learner.runs.training import RunOptions, train

POLL_SECONDS = 2.0


@dataclass(frozen=True)
class Place:
    """Where a sweep stores its runs: an SQLite file on this machine (`store`), or a server (`server`, `token`)."""

    checkpoints: Path
    store: Path | None = None
    server: str = ""
    token: str = ""
    patience: float = 300.0  # seconds to keep trying when the server does not answer

    def connect(self) -> AbstractContextManager[Connection]:
        """Return a connection to the store; to the server if there is no store. The oracle answers in this process."""
        if self.store is not None:
            return embedded(self.store)
        return connected(self.server, self.token, answers_here=True, patience=self.patience)


@dataclass(frozen=True)
class Progress:
    """The progress of a sweep."""

    finished: int  # number of finished runs
    episodes: int  # reported episodes of all runs


def sweep(
    runs: Sequence[TrainConfig],
    place: Place,
    jobs: int,
    ray: str | None = None,
    on_progress: Callable[[Progress], None] = lambda _: None,
    backend: str = "loky",
) -> dict[str, str]:
    """Train the runs that are not finished yet, and return the error message of each failed run by the run's name.

    Args:
        runs: the runs to train.
        place: where to store them.
        jobs: how many runs train at once.
        ray: the address of a Ray cluster ("auto" for this machine's cluster); None for processes on this machine.
        on_progress: called every few seconds.
        backend: joblib's backend without Ray: "loky" starts one process per job, "sequential" starts none.

    Raises:
        ValueError: another sweep uses the same checkpoint folder, or a Ray cluster was given with a local store.
    """
    if ray is not None and place.store is not None:
        raise ValueError("the machines of a cluster cannot write to a local file: give --server instead of --store")
    with _alone(place), place.connect() as connection, _reporting(runs, connection, on_progress):
        done = finished(runs, connection)
        todo = [config for config in runs if config not in done]
        with _backend(backend, ray):
            troubles = joblib.Parallel(n_jobs=jobs, batch_size=1, pre_dispatch=jobs)(
                joblib.delayed(_train)(config, place) for config in todo
            )
    return {name_of(config): trouble for config, trouble in zip(todo, troubles, strict=True) if trouble}


def finished(runs: Sequence[TrainConfig], connection: Connection) -> set[TrainConfig]:
    """Return the finished runs among `runs`."""
    done = [settings_of(run.config) for run in connection.learner.runs() if run.state == "finished"]
    return {config for config in runs if config_values(config) in done}


def _train(config: TrainConfig, place: Place) -> str | None:
    """Train one run in its own process, and return an error message or None."""
    parent = os.getppid()

    def stop_with_the_sweep(_result: wire.EpisodeResult, _units: float) -> None:
        if os.getppid() != parent:
            os._exit(1)  # the sweep was killed: stop, so that the next sweep can continue this run

    options = RunOptions(resume=True, checkpoints=place.checkpoints, threads=1)
    try:
        with place.connect() as connection:
            train(config, connection, options, on_episode=stop_with_the_sweep)
    except Exception as error:
        return f"{type(error).__name__}: {error}"  # the other runs continue
    return None


@contextmanager
def _alone(place: Place) -> Iterator[None]:
    """Lock the checkpoint folder, so that no second sweep uses it. The lock ends with the process, even if killed."""
    place.checkpoints.mkdir(parents=True, exist_ok=True)
    with (place.checkpoints / "sweep.lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ValueError(f"another sweep is running in {place.checkpoints}: wait for it, or stop it") from None
        yield


@contextmanager
def _reporting(
    runs: Sequence[TrainConfig], connection: Connection, on_progress: Callable[[Progress], None]
) -> Iterator[None]:
    """Call `on_progress` at the start, every few seconds, and at the end."""
    over = threading.Event()
    wanted = [config_values(config) for config in runs]

    def report() -> None:
        known = [run for run in connection.learner.runs() if settings_of(run.config) in wanted]
        on_progress(Progress(sum(run.state == "finished" for run in known), sum(run.episodes_done for run in known)))

    def keep_reporting() -> None:
        while not over.wait(POLL_SECONDS):
            report()

    report()
    thread = threading.Thread(target=keep_reporting, name="progress", daemon=True)
    thread.start()
    try:
        yield
    finally:
        over.set()
        thread.join()
    report()


def _backend(backend: str, address: str | None) -> AbstractContextManager[Any]:
    if address is not None:
        import ray
        from ray.util.joblib import register_ray

        ray.init(address=None if address == "auto" else address, ignore_reinit_error=True)
        register_ray()
        backend = "ray"
    configured: AbstractContextManager[Any] = joblib.parallel_config(backend=backend)
    return configured
