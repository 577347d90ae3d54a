"""`waypost sweep`: many runs side by side, on this machine's cores or on a Ray cluster.

A sweep keeps no books of its own: the store says which runs are finished, and each run goes on from its checkpoint. So
an interrupted sweep is the same command again.
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
from waypost_learner.remote.connection import Connection, connected
from waypost_learner.remote.embedded import embedded
from waypost_learner.runs.config import TrainConfig, config_values
from waypost_learner.runs.training import RunOptions, train

POLL_SECONDS = 2.0


@dataclass(frozen=True)
class Place:
    """Where runs are kept: a store of this machine, or a server."""

    checkpoints: Path
    store: Path | None = None
    server: str = ""
    token: str = ""
    patience: float = 300.0

    def connect(self) -> AbstractContextManager[Connection]:
        """Connect; an oracle in the same process answers."""
        if self.store is not None:
            return embedded(self.store)
        return connected(self.server, self.token, answers_here=True, patience=self.patience)


@dataclass(frozen=True)
class Progress:
    """How far a sweep is."""

    finished: int  # runs
    episodes: int  # of all runs


def sweep(
    runs: Sequence[TrainConfig],
    place: Place,
    jobs: int,
    ray: str | None = None,
    on_progress: Callable[[Progress], None] = lambda _: None,
    backend: str = "loky",
) -> dict[str, str]:
    """Make the runs that are not finished yet; return what went wrong, by the run's name.

    Args:
        runs: what to make.
        place: where to keep it.
        jobs: how many runs go on at once.
        ray: the address of a Ray cluster ("auto" for the one of this machine); None for processes of this machine.
        on_progress: called every few seconds.
        backend: joblib's, on this machine: "loky" makes a process for each job, "sequential" none.

    Raises:
        ValueError: another sweep is at work on the same store, or a cluster cannot reach the store.
    """
    if ray is not None and place.store is not None:
        raise ValueError("a cluster's machines cannot write a file of this one: give --server instead of --store")
    with _alone(place), place.connect() as connection, _reporting(runs, connection, on_progress):
        done = finished(runs, connection)
        todo = [config for config in runs if config not in done]
        with _backend(backend, ray):
            troubles = joblib.Parallel(n_jobs=jobs, batch_size=1, pre_dispatch=jobs)(
                joblib.delayed(_train)(config, place) for config in todo
            )
    return {name_of(config): trouble for config, trouble in zip(todo, troubles, strict=True) if trouble}


def finished(runs: Sequence[TrainConfig], connection: Connection) -> set[TrainConfig]:
    """Return which of the runs are finished."""
    done = [run.config for run in connection.learner.runs() if run.state == "finished"]
    return {config for config in runs if config_values(config) in done}


def name_of(config: TrainConfig) -> str:
    """Return what a run is called where it is listed."""
    rest = {"redraw": "redrawn", "head_start": "head start"}
    extras = [word for field, word in rest.items() if getattr(config, field)]
    return ", ".join([f"{config.algorithm} {config.instances} seed {config.seed}", *extras])


def _train(config: TrainConfig, place: Place) -> str | None:
    """Make one run, in a process of its own; return what went wrong."""
    parent = os.getppid()

    def stop_with_the_sweep(_result: wire.EpisodeResult, _units: float) -> None:
        if os.getppid() != parent:
            os._exit(1)  # the sweep was killed: what it starts next must find its runs free

    options = RunOptions(resume=True, checkpoints=place.checkpoints, threads=1)
    try:
        with place.connect() as connection:
            train(config, connection, options, on_episode=stop_with_the_sweep)
    except Exception as error:
        return f"{type(error).__name__}: {error}"  # the other runs go on
    return None


@contextmanager
def _alone(place: Place) -> Iterator[None]:
    """Keep a second sweep off the same checkpoints; the lock ends with its process, however that ends."""
    place.checkpoints.mkdir(parents=True, exist_ok=True)
    with (place.checkpoints / "sweep.lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ValueError(f"another sweep is at work in {place.checkpoints}: wait for it, or stop it") from None
        yield


@contextmanager
def _reporting(
    runs: Sequence[TrainConfig], connection: Connection, on_progress: Callable[[Progress], None]
) -> Iterator[None]:
    """Say every few seconds how far the runs are."""
    over = threading.Event()
    wanted = [config_values(config) for config in runs]

    def report() -> None:
        known = [run for run in connection.learner.runs() if run.config in wanted]
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
