"""`waypost train` and `waypost evaluate`: a configuration, a connection and a folder for checkpoints make a run."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from waypost import wire
from waypost.client import Client
from waypost.domain import InstanceSets, find_domain
from waypost_learner.algorithms import ALGORITHMS, find_algorithm
from waypost_learner.algorithms.learner import Learner
from waypost_learner.experts.bot import Bot, BotSettings
from waypost_learner.experts.head_start import head_start
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.presets import find_preset
from waypost_learner.remote import stage
from waypost_learner.remote.in_process import InProcessTransport
from waypost_learner.remote.translation import vocabulary
from waypost_learner.runs import checkpoints
from waypost_learner.runs.config import START, Progress, TrainConfig
from waypost_learner.runs.driver import BudgetExhausted, Driver, Offer
from waypost_learner.runs.evaluation import Evaluation, evaluate
from waypost_learner.runs.tracking import Tracker
from waypost_server.app import create_app
from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users


@dataclass(frozen=True)
class Connection:
    """A server, as a learner and, for an expert in this process, as an annotator."""

    learner: Client
    annotator: Client | None


@dataclass(frozen=True)
class RunOptions:
    """What does not change what is learned."""

    name: str | None = None
    budget: float | None = None
    resume: bool = False
    checkpoints: Path = Path("checkpoints")
    threads: int | None = None


@contextmanager
def embedded(store: Path) -> Iterator[Connection]:
    """Connect to the server's app in this process, on an SQLite store.

    Raises:
        BadDatabase, NewerStore: with one sentence for the user.
    """
    app = create_app(Settings(database=f"sqlite:///{store}"))
    with InProcessTransport(app) as transport, ExitStack() as stack:
        db = app.state.context.db

        def connect(name: str, role: wire.Role) -> Client:
            user = db.write_now(lambda tx: users.ensure_user(tx, name, role))
            token = db.write_now(lambda tx: tokens.create_token(tx, user.id, "embedded"))
            stack.callback(db.write_now, lambda tx: tokens.revoke_token(tx, token.id))
            client = Client("http://localhost", token.token, transport)
            stack.callback(client.close)
            return client

        yield Connection(connect("learner", "learner"), connect("oracle", "annotator"))


@contextmanager
def remote(server: str, token: str, answers_here: bool, patience: float) -> Iterator[Connection]:
    """Connect to a server; with `answers_here` an oracle in this process answers (the token must be an admin's)."""
    client = Client(server, token, patience=patience)
    try:
        yield Connection(client, client if answers_here else None)
    finally:
        client.close()


def config_values(config: TrainConfig) -> dict[str, Any]:
    """Return a configuration as a run carries it: without what is not set."""
    return {key: value for key, value in asdict(config).items() if value is not None}


def build_learner(config: TrainConfig, threads: int | None) -> tuple[Learner, InstanceSets]:
    """Return what a configuration describes.

    Raises:
        ValueError: a name that does not exist, or a file that is no set of instances.
    """
    algorithm = find_algorithm(config.algorithm)
    if config.redraw and not algorithm.interactive:
        raise ValueError(f"{config.algorithm} takes every instance as it comes: leave out --redraw")
    if config.head_start is not None and not algorithm.structure.reinforced:
        raise ValueError(f"{config.algorithm} has an expert to learn from: leave out --head-start")
    preset = find_preset(config.preset, config.values)
    if preset.monitoring.share < 1 and (config.redraw or not algorithm.monitored):
        monitored = ", ".join(name for name, one in ALGORITHMS.items() if one.monitored)
        raise ValueError(f"monitoring.share below 1 is for {monitored}, without --redraw")
    if config.warm_start is not None:
        preset = replace(preset, warm_start=config.warm_start)
    domain = find_domain(config.domain)
    start = None if config.head_start is None else head_start(domain, config.head_start)
    return Learner(domain, preset, config.seed, algorithm.structure, threads, start), domain.instances(config.instances)


def train(
    config: TrainConfig,
    connection: Connection,
    options: RunOptions,
    on_start: Callable[[wire.Run, int], None] = lambda _run, _first: None,
    on_episode: Callable[[wire.EpisodeResult, float], None] = lambda _result, _units: None,
) -> dict[str, Any]:
    """Train a run to its end and return its summary (DESIGN: the line that `--json` prints).

    Raises:
        ValueError: the configuration names something that does not exist.
        Refused, Unreachable: the server would not, or did not, go on.
    """
    began = time.monotonic()
    learner, instances = build_learner(config, options.threads)
    if connection.annotator is not None:
        OracleExpert(learner.domain)  # says so at once if the domain has none
    run = _run(config, learner, connection.learner, options)
    path = options.checkpoints / f"{run.id}.safetensors"
    first = _resume(path, learner) if options.resume else START
    on_start(run, first.episodes)

    def save(progress: Progress, weights_only: bool) -> None:
        checkpoints.write(path, learner, checkpoints.Header(run.id, config, progress), weights_only)

    ended = "finished"
    with Tracker(path.with_suffix(".events"), first.episodes) as tracker:

        def report(result: wire.EpisodeResult, units: float) -> None:
            tracker.episode(result, units)
            on_episode(result, units)

        driver = Driver(
            config,
            find_algorithm(config.algorithm),
            learner,
            instances,
            connection.learner,
            run.id,
            _answering(connection, run.id),
            report,
            partial(save, weights_only=False),
            _offering(connection),
            first,
            pictures=connection.annotator is None,
        )
        try:
            driver.train()
        except BudgetExhausted:
            ended = "budget exhausted"
    learner.train_on()  # no further question comes, with which to do it
    save(driver.progress, weights_only=True)
    return _summary(config, learner, connection.learner, run.id, ended, time.monotonic() - began)


def evaluate_run(path: Path, instances: str | None, episodes: int, threads: int | None) -> Evaluation:
    """Evaluate a checkpoint on unseen instances: the run's own test set, or another set or file.

    Raises:
        ValueError: no checkpoint, or no such instances.
    """
    header = checkpoints.read_header(path)
    learner, _ = build_learner(header.config, threads)
    checkpoints.load(path, learner)
    chosen = learner.domain.instances(instances or header.config.instances)
    return evaluate(learner, chosen.test, episodes or len(chosen.test))


def _run(config: TrainConfig, learner: Learner, client: Client, options: RunOptions) -> wire.Run:
    """Return the run to train: a new one, or the newest unfinished one of this configuration to go on with."""
    values = config_values(config)
    if options.resume:
        for run in client.runs():
            if run.config == values and run.state != "finished" and options.name in (None, run.name):
                return run
    return client.create_run(
        wire.RunCreate(
            name=options.name or f"{config.algorithm} {config.domain} {config.instances} seed {config.seed}",
            algorithm=config.algorithm,
            seed=config.seed,
            vocabulary=vocabulary(learner.domain),
            config=values,
            budget=options.budget,
            episodes=config.episodes,
        )
    )


def _resume(path: Path, learner: Learner) -> Progress:
    """Load the run's checkpoint, if there is one, and return where to go on."""
    if not path.exists():
        return START
    checkpoints.load(path, learner)
    return checkpoints.read_header(path).progress


def _answering(connection: Connection, run: str) -> Callable[[], None]:
    """Return what lets an expert in this process answer what has been asked."""
    if connection.annotator is None:
        return lambda: None
    for assignment in connection.annotator.assignments():
        if assignment.run.id == run:  # left by an expert that was killed together with its learner
            connection.annotator.release(assignment)
    bot = Bot(connection.annotator, BotSettings(run=run))
    return lambda: bot.work(wait=0)


def _offering(connection: Connection) -> Offer:
    """Return what lets people play demonstrations, unless an expert in this process gives them."""
    if connection.annotator is not None:
        return lambda _query, _translator: lambda: None
    client = connection.learner
    return lambda query, translator: stage.offer(partial(client.play, query), translator, client.upload)


def _summary(
    config: TrainConfig, learner: Learner, client: Client, run: str, ended: str, seconds: float
) -> dict[str, Any]:
    costs, state = client.costs(run), client.run(run)
    summary: dict[str, Any] = {
        "run": run,
        "algorithm": config.algorithm,
        "domain": config.domain,
        "seed": config.seed,
        "episodes": state.episodes_done,
        "success_rate": state.success_rate,
        "cost": {"total": costs.total, "by_kind": {kind: cost.units for kind, cost in costs.by_kind.items()}},
        "first_at": {
            level: milestone.model_dump() if milestone else None for level, milestone in costs.first_at.items()
        },
        "wall_seconds": round(seconds, 3),
        "ended": ended,
        "weights": checkpoints.weights_hash(learner),
    }
    if state.state != "finished":
        client.patch_run(run, wire.RunPatch(state="finished", result=summary))
    return summary
