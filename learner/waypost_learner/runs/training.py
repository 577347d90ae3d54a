"""`waypost train`: create or resume a run, train it to its end, and write its checkpoints and events."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from waypost import wire
from waypost.client import BudgetExhausted, Client
from waypost.domains import Domain
from waypost_learner.algorithms.learner import Learner
from waypost_learner.experts.bot import Bot, BotSettings
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote import stage
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.translation import vocabulary
from waypost_learner.runs import checkpoints
from waypost_learner.runs.config import NOT_PROVIDED, START, Progress, TrainConfig, config_values, settings_of
from waypost_learner.runs.driver import Driver, Hooks, Offer
from waypost_learner.runs.measuring import Measuring
from waypost_learner.runs.practice import send_practice
from waypost_learner.runs.predicting import Predicting
from waypost_learner.runs.run_queue import RunQueue
from waypost_learner.runs.setup import Setup, set_up
from waypost_learner.runs.summary import finish
from waypost_learner.runs.tracking.contract import Rows, TrackedRun, rows_after
from waypost_learner.runs.tracking.tracker import Tracker, check


@dataclass(frozen=True)
class RunOptions:
    """The options of `waypost train` that do not change what is learned."""

    name: str | None = None  # of the run; made from the configuration if None
    budget: float | None = None  # units; no limit if None
    resume: bool = False  # whether to continue the user's newest unfinished run of the configuration
    checkpoints: Path = Path("checkpoints")
    threads: int | None = None  # CPU threads; one per core if None
    loggers: tuple[str, ...] = ("tensorboard",)
    server: str | None = None  # the server's address, for the links of loggers to the run's page
    measure: str | None = None  # instances to measure the policies on after each change; no measurement if None
    measure_every: int = 1  # episodes from one possible measurement to the next
    practice: bool = False  # whether people practice for this run: the server gets practice queries if it has none


def train(
    config: TrainConfig,
    connection: Connection,
    options: RunOptions,
    on_start: Callable[[wire.Run, int], None] = lambda _run, _first: None,
    on_episode: Callable[[wire.EpisodeResult, float], None] = lambda _result, _units: None,
    tell: Callable[[str], None] = lambda _sentence: None,
) -> dict[str, Any]:
    """Train a run to its end and return its summary.

    Args:
        config: the run's configuration.
        connection: the connection to the server, for the learner and perhaps for an expert in this process.
        options: the options that do not change what is learned.
        on_start: called with the run and the number of its first episode in this process.
        on_episode: called with each episode's result and the units that its answers cost.
        tell: called with sentences of loggers: where they show the run, and errors.

    Raises:
        ValueError: the configuration cannot be trained, or a logger cannot be used; see `set_up` and `check`.
        Refused: the server refused a call.
        Unreachable: the server did not answer.
    """
    began = time.monotonic()
    check(options.loggers)
    setup = set_up(config, options.threads)
    learner = setup.learner
    measured = None if options.measure is None else learner.domain.instances(options.measure).test
    if connection.annotator is not None:
        OracleExpert(learner.domain)  # refuses a domain without an oracle before a run is created
    run = _find_or_create_run(setup, connection.learner, options)
    path = options.checkpoints / f"{run.id}.safetensors"
    first = _load_checkpoint(path, learner) if options.resume else START
    on_start(run, first.episodes)
    if options.practice and (trouble := send_practice(connection.learner, run.id, learner.domain, config.instances)):
        tell(trouble)
    measuring = None
    if measured is not None:
        file = path.with_suffix(".measured.csv")
        costs = connection.learner.costs
        measuring = Measuring(
            learner, measured, file, first.episodes, lambda: costs(run.id).total, options.measure_every
        )

    people = connection.annotator is None  # who may review the run
    predicting = Predicting(learner, connection.learner, run.id) if people else None

    def save(progress: Progress, weights_only: bool) -> None:
        checkpoints.write(path, learner, checkpoints.Header(run.id, config, progress), weights_only)

    with _tracker(run, first, connection.learner, options, tell) as tracker:

        def report(result: wire.EpisodeResult, units: float) -> None:
            tracker.episode(result, units)
            if measuring is not None:
                measuring.after(result.episode)
            if predicting is not None:
                predicting.after(result.episode)
            on_episode(result, units)

        hooks = Hooks(
            let_answer=_expert_here(connection, run.id, learner.domain),
            on_answer=predicting.keep if predicting is not None else lambda _id, _query: None,
            on_episode=report,
            checkpoint=partial(save, weights_only=False),
            offer=_offer_to_people(connection),
        )
        ended, progress = _drive(setup, _queue(connection, run.id), hooks, first)
        learner.train_idle()  # the training that would follow the next query
        if measuring is not None:
            measuring.now(progress.episodes)
        if predicting is not None and progress.episodes:
            predicting.now(progress.episodes - 1)
        save(progress, weights_only=True)
        summary = finish(setup, connection.learner, run.id, ended, time.monotonic() - began)
        tracker.finish(summary)
    return summary


def _drive(setup: Setup, queue: RunQueue, hooks: Hooks, first: Progress) -> tuple[str, Progress]:
    """Train to the end; return why the run ended, and its progress."""
    driver, ended = Driver(setup, queue, hooks, first), "finished"
    try:
        driver.train()
    except BudgetExhausted:
        ended = "budget exhausted"
    return ended, driver.progress


def _tracker(
    run: wire.Run, first: Progress, client: Client, options: RunOptions, tell: Callable[[str], None]
) -> Tracker:
    """Return the tracker of a run, which continues the records of a resumed run."""
    page = None if options.server is None else f"{options.server.rstrip('/')}/runs/{run.id}"
    tracked = TrackedRun(
        run.id, run.name, run.config, options.checkpoints, first.episodes, max(run.episodes_done, first.episodes), page
    )
    rows = rows_after(client.curves(run.id), first.episodes) if first.episodes else Rows()
    return Tracker(options.loggers, tracked, rows, tell)


def _queue(connection: Connection, run: str) -> RunQueue:
    return RunQueue(connection.learner, run, pictures=connection.annotator is None)


def _find_or_create_run(setup: Setup, client: Client, options: RunOptions) -> wire.Run:
    """Return the run to train: with `resume` the user's newest unfinished run of this configuration, else a new one."""
    config = setup.config
    values = config_values(config)
    if options.resume:
        for run in client.runs(mine=True):
            same = settings_of(run.config) == values
            if same and run.state != "finished" and options.name in (None, run.name):
                return run
    return client.create_run(
        wire.RunCreate(
            name=options.name or f"{config.algorithm} {config.domain} {config.instances} seed {config.seed}",
            algorithm=config.algorithm,
            seed=config.seed,
            vocabulary=vocabulary(setup.learner.domain),
            config=values | ({NOT_PROVIDED: setup.missing} if setup.missing else {}),
            budget=options.budget,
            episodes=config.episodes,
        )
    )


def _load_checkpoint(path: Path, learner: Learner) -> Progress:
    """Load a run's checkpoint if there is one, and return the progress to continue from."""
    if not path.exists():
        return START
    checkpoints.load(path, learner)
    return checkpoints.read_header(path).progress


def _expert_here(connection: Connection, run: str, domain: Domain) -> Callable[[], None]:
    """Return a function that lets an expert in this process answer open queries. If others answer, it does nothing."""
    if connection.annotator is None:
        return lambda: None
    for assignment in connection.annotator.assignments():
        if assignment.run.id == run:  # held by an expert that was killed together with its learner
            connection.annotator.release(assignment)
    bot = Bot(connection.annotator, BotSettings(run=run), [domain])
    return lambda: bot.work(wait=0)


def _offer_to_people(connection: Connection) -> Offer:
    """Return a function that offers demonstrations to people. If an expert in this process answers, it does nothing."""
    if connection.annotator is not None:
        return lambda _query, _translator: lambda: None
    client = connection.learner
    return lambda query, translator: stage.offer(partial(client.play, query), translator, client.upload)
