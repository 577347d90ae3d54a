"""The command `waypost`: the server's commands and the learner's.

Each command imports the learner's packages when it runs. So the base installation, which lacks them, can serve.
"""

import json
from contextlib import ExitStack
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from waypost import tracing
from waypost.wire import Assignment, Receipt, RunPatch
from waypost_learner import domain_commands
from waypost_learner.commands import (
    JsonOption,
    PatienceOption,
    ServerOption,
    TokenOption,
    checkpoint_folder,
    learner_errors,
    needed,
    refuse,
)
from waypost_learner.exchange import cli as exchange_cli
from waypost_learner.experiments import cli as experiments_cli
from waypost_learner.progress import TrainingProgress
from waypost_server.cli.main import app as server_app

app = typer.Typer(
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    help="Waypost: a labeling server for hierarchical imitation learning, and its learners.",
)
app.add_typer(server_app)
app.add_typer(experiments_cli.app)
app.add_typer(exchange_cli.app)
app.add_typer(domain_commands.app, name="domain")

StoreOption = Annotated[
    Path | None, typer.Option("--store", help="The SQLite file; it is created if it does not exist.")
]
CheckpointsOption = Annotated[
    Path | None,
    typer.Option(help="Folder of checkpoints. Default: beside the store; with a server, ./checkpoints."),
]
ThreadsOption = Annotated[
    int | None, typer.Option(min=1, help="CPU threads to train with. The result does not depend on their number.")
]


@app.command()
def train(
    algorithm: Annotated[str, typer.Argument(help="The algorithm, such as hg-dagger; an unknown name lists all.")],
    domain: Annotated[str, typer.Option(help="The domain.")] = "maze",
    instances: Annotated[str, typer.Option(help="Instances: a name (maze: random, corners) or a file.")] = "random",
    preset: Annotated[str, typer.Option(help="The preset: lean, general or paper.")] = "lean",
    seed: Annotated[int, typer.Option(min=0, help="The seed of every random choice.")] = 0,
    episodes: Annotated[int, typer.Option(min=1, help="How many episodes.")] = 1000,
    warm_start: Annotated[
        int | None, typer.Option(min=0, help="Demonstrations at the start of the run. Default: the preset's.")
    ] = None,
    redraw: Annotated[bool, typer.Option(help="Draw instances until the learner fails on one.")] = False,
    head_start: Annotated[float | None, typer.Option(help="Share of an optimal trajectory to begin with.")] = None,
    told: Annotated[
        str | None,
        typer.Option(help="What the learner is told of the domain: nothing, symmetries, centered, crop or structure."),
    ] = None,
    values: Annotated[
        list[str] | None, typer.Option(help='Values to replace in the preset: "relabeling=false"; can be repeated.')
    ] = None,
    expert: Annotated[str, typer.Option(help="oracle answers in this process; with queue, others answer.")] = "oracle",
    server: ServerOption = None,
    token: TokenOption = "",
    store: StoreOption = None,
    in_flight: Annotated[int, typer.Option(min=1, help="Episodes open at the same time; 1 is the paper's loop.")] = 1,
    environments: Annotated[
        int | None, typer.Option(min=1, help="Environments that step together in training. Default: 1.")
    ] = None,
    test_every: Annotated[
        int | None, typer.Option(min=1, help="Episodes from one test to the next. Default: the domain's, or 1.")
    ] = None,
    resume: Annotated[bool, typer.Option(help="Continue your newest unfinished run with these options.")] = False,
    name: Annotated[str | None, typer.Option(help="The run's name.")] = None,
    budget: Annotated[float | None, typer.Option(min=0, help="The highest cost of the run, in units.")] = None,
    checkpoints: CheckpointsOption = None,
    threads: ThreadsOption = None,
    measure: Annotated[
        str | None, typer.Option(help="Instances on whose unseen ones to measure success after each change.")
    ] = None,
    measure_every: Annotated[int, typer.Option(min=1, help="Episodes from one possible measurement to the next.")] = 1,
    log: Annotated[list[str] | None, typer.Option(help="Loggers: tensorboard (the default), wandb, mlflow.")] = None,
    patience: PatienceOption = 300.0,
    as_json: JsonOption = False,
) -> None:
    """Train with an algorithm of the paper. The store keeps every answer and its cost."""
    if expert not in {"oracle", "queue"}:
        refuse(f"There is no expert {expert!r}; choose oracle (it answers in this process) or queue (others answer).")
    if server is None and expert == "queue":
        refuse("With --expert queue, others answer at a server: give its address with --server URL.")
    if server is not None and store is not None:
        refuse("A server has its own store: give either --server or --store.")
    with learner_errors("Interrupted; `--resume` continues from the last checkpoint."):
        from waypost_learner.remote.connection import connected
        from waypost_learner.remote.embedded import embedded
        from waypost_learner.runs.config import TrainConfig
        from waypost_learner.runs.setup import set_up
        from waypost_learner.runs.tracking.tracker import check
        from waypost_learner.runs.training import RunOptions
        from waypost_learner.runs.training import train as train_run

        config = TrainConfig(
            algorithm,
            domain,
            instances,
            preset,
            seed,
            episodes,
            in_flight,
            warm_start,
            redraw,
            head_start,
            environments,
            test_every,
            told,
            " ".join(values) if values else None,
        )
        setup = set_up(config, threads)  # refuses a wrong configuration before the store is created
        loggers = tuple(word.strip() for words in log or ["tensorboard"] for word in words.split(","))
        check(loggers)  # likewise
        if measure is not None:
            setup.learner.domain.instances(measure)  # likewise
        for part, instead in setup.missing.items():
            typer.echo(f"The domain {domain!r} provides no {part}. {instead}", err=True)
        folder = checkpoint_folder(checkpoints, store, server)
        asks = expert == "queue"
        options = RunOptions(name, budget, resume, folder, threads, loggers, server, measure, measure_every, asks)
        tracing.install("waypost-learner")
        with ExitStack() as stack:
            connection = stack.enter_context(
                connected(server, needed(token), expert == "oracle", patience)
                if server is not None
                else embedded(store or Path("waypost.db"))
            )
            progress = stack.enter_context(TrainingProgress(episodes))
            stack.callback(tracing.flush)
            summary = train_run(config, connection, options, progress.start, progress.episode, _tell)
    _print_summary(summary, as_json)


@app.command()
def evaluate(
    run: Annotated[str, typer.Argument(help="The run's id, as `waypost train` printed it.")],
    instances: Annotated[
        str | None, typer.Option(help="Instances to evaluate on. Default: the run's own unseen ones.")
    ] = None,
    episodes: Annotated[int, typer.Option(min=0, help="How many episodes; 0 for one on each instance.")] = 0,
    values: Annotated[
        list[str] | None,
        typer.Option(help='Values that replace the run\'s own: "fields.far=96"; can be repeated.'),
    ] = None,
    store: StoreOption = None,
    server: ServerOption = None,
    checkpoints: CheckpointsOption = None,
    threads: ThreadsOption = None,
    as_json: JsonOption = False,
) -> None:
    """Measure the success rate of a run's policies on unseen or given instances."""
    with learner_errors():
        from waypost_learner.runs.evaluation import evaluate_run

        path = checkpoint_folder(checkpoints, store, server) / f"{run}.safetensors"
        found = evaluate_run(path, instances, episodes, threads, " ".join(values) if values else None)
    if as_json:
        typer.echo(json.dumps({**vars(found), "success_rate": found.success_rate}))
    else:
        typer.echo(f"{found.successes} of {found.episodes} episodes succeeded: {found.success_rate:.1%}")


@app.command()
def forecast(
    run: Annotated[str, typer.Argument(help="The run's id.")],
    target: Annotated[str, typer.Option(help="The success rate: 0.8, 0.9, 0.95 or 0.99.")] = "0.9",
    server: Annotated[str, typer.Option(help="The server.")] = "http://127.0.0.1:8000",
    token: TokenOption = "",
    as_json: JsonOption = False,
) -> None:
    """Forecast how many more units a run needs to reach a success rate."""
    with learner_errors():
        from waypost.client import Client
        from waypost_learner.runs.forecast import level, sentence

        found = Client(server, needed(token)).forecast(run, level(target))
    typer.echo(found.model_dump_json() if as_json else sentence(found))


@app.command()
def oracle(
    server: Annotated[str, typer.Option(help="The server.")] = "http://127.0.0.1:8000",
    token: TokenOption = "",
    run: Annotated[str | None, typer.Option(help="Answer only this run's queries.")] = None,
    kinds: Annotated[str | None, typer.Option(help="Answer only these kinds, comma-separated.")] = None,
    domain: Annotated[
        str | None, typer.Option(help="A domain that is not installed, MODULE:ATTRIBUTE, whose queries to answer.")
    ] = None,
    error_rate: Annotated[float, typer.Option(min=0, max=1, help="Share of answers with random labels.")] = 0.0,
    seconds: Annotated[float, typer.Option(min=0, help="Seconds to wait before each answer.")] = 0.0,
    defer: Annotated[float, typer.Option(min=0, help="Seconds for which to leave queries to people.")] = 0.0,
    seed: Annotated[int, typer.Option(min=0, help="The seed of random answers.")] = 0,
    patience: PatienceOption = 300.0,
) -> None:
    """Answer queries with the oracle of their domain, until interrupted."""
    chosen = _kinds(kinds)
    with learner_errors():
        from waypost.client import Client
        from waypost.domains import find_domain
        from waypost_learner.experts.bot import Bot, BotSettings

        client = Client(server, needed(token), patience=patience)
        domains = [] if domain is None else [find_domain(domain)]
        bot = Bot(client, BotSettings(run, chosen, error_rate, seconds, defer, seed), domains, _report_failure)
        answers, units = 0, 0.0

        console = Console(stderr=True)
        with console.status("Waiting for queries.") as status:

            def count(receipt: Receipt) -> None:
                nonlocal answers, units
                answers, units = answers + 1, units + receipt.units
                status.update(f"{answers} answers, {units:g} units; the last answer was to query {receipt.query}.")

            try:
                bot.work_forever(count)
            except KeyboardInterrupt:
                console.print(f"{answers} answers, {units:g} units.")


@app.command()
def demo(
    port: Annotated[int, typer.Option(min=0, max=65_535, help="The port; 0 takes a free one.")] = 8000,
    database: Annotated[Path, typer.Option(help="The SQLite file; it is created if it does not exist.")] = Path(
        "waypost-demo.db"
    ),
    episodes: Annotated[int, typer.Option(min=1, help="How many episodes.")] = 300,
    domain: Annotated[str, typer.Option(help="The domain that the queries are about.")] = "maze",
    instances: Annotated[
        str | None, typer.Option(help="Instances: a name or a file.", show_default="corners for the maze, else random")
    ] = None,
    no_wait: Annotated[
        bool, typer.Option("--no-wait", help="Do not wait at the first question until somebody opens the web app.")
    ] = False,
) -> None:
    """Run a server, a learner and a bot on this machine, and print a link that logs you in."""
    with learner_errors():
        from waypost.domains import find_domain
        from waypost_learner.demo import run_demo
        from waypost_learner.experts.oracle import OracleExpert

        OracleExpert(find_domain(domain))  # refuses a domain that the bot could not answer about
        named = instances or ("corners" if domain == "maze" else "random")
        run_demo(port, database, episodes, domain, named, wait=not no_wait)


@app.command()
def gold(
    run: Annotated[str, typer.Argument(help="The run's id.")],
    server: Annotated[str, typer.Option(help="The server.")] = "http://127.0.0.1:8000",
    token: TokenOption = "",
    queries: Annotated[
        int, typer.Option(min=1, max=1_000, help="How many of its answered queries, newest first.")
    ] = 20,
    rate: Annotated[
        float | None, typer.Option(min=0, max=0.5, help="Share of each annotator's queries that are gold.")
    ] = None,
    patience: PatienceOption = 300.0,
) -> None:
    """Make gold queries from answered queries of a run, with the right answers from the oracle of its domain."""
    with learner_errors():
        from waypost.client import Client
        from waypost_learner.experts.gold import make_gold

        client = Client(server, needed(token), patience=patience)
        found = make_gold(client, run, queries)
        share = client.patch_run(run, RunPatch(gold_rate=rate)) if rate is not None else client.run(run)
    typer.echo(f"The run has {found} gold queries; {share.gold_rate:.1%} of each annotator's queries are gold.")


@app.command()
def practice(
    file: Annotated[Path, typer.Argument(help="The file to write.")],
    domain: Annotated[str, typer.Option(help="The domain.")] = "maze",
    instances: Annotated[str, typer.Option(help="Instances: a name (maze: random, corners) or a file.")] = "random",
    seed: Annotated[int, typer.Option(min=0, help="The seed of the rollouts.")] = 0,
) -> None:
    """Write practice queries with the oracle's right answers. `WAYPOST_PRACTICE=FILE` makes a server offer them."""
    with learner_errors():
        from waypost.domains import find_domain
        from waypost_learner.experts.practice import practice as made

        found = made(find_domain(domain), instances, seed)
    file.write_text(found, encoding="utf-8")
    typer.echo(f"The practice queries are in {file}.")


def main() -> None:
    """Run `waypost`."""
    app()


# --- used by the commands


def _kinds(text: str | None) -> Any:
    from typing import get_args

    from waypost.wire import Kind

    if text is None:
        return None
    kinds = tuple(kind.strip() for kind in text.split(","))
    unknown = [kind for kind in kinds if kind not in get_args(Kind)]
    if unknown:
        refuse(f"There is no kind of query {unknown[0]!r}; the kinds are: {', '.join(get_args(Kind))}.")
    return kinds


def _report_failure(assignment: Assignment, error: Exception) -> None:
    """Say which query the bot left to others, and why."""
    query = assignment.query
    typer.echo(f"Query {query.id} of run {assignment.run.id} is left to others: {error}", err=True)


def _tell(sentence: str) -> None:
    typer.echo(sentence, err=True)


def _print_summary(summary: dict[str, Any], as_json: bool) -> None:
    if as_json:
        typer.echo(json.dumps(summary))
        return
    cost = summary["cost"]
    typer.echo(f"Run {summary['run']}: {summary['episodes']} episodes, {summary['ended']}.")
    typer.echo(f"Told of the domain: {summary['told']}")
    typer.echo(f"Success on unseen instances, trailing 100: {summary['success_rate']:.0%}")
    typer.echo(f"Expert cost: {cost['total']:g} units")
    for kind, units in cost["by_kind"].items():
        typer.echo(f"  {kind:<13}{units:>10g}")
    for level, milestone in summary["first_at"].items():
        if milestone:
            typer.echo(f"{float(level):.0%} at episode {milestone['episode']}, {milestone['cost']:g} units")


if __name__ == "__main__":
    main()
