"""Runs the trials until the time is over, and prints what they counted: `make soak ARGS="--minutes 60 --seed 7"`."""

import itertools
import shutil
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import pytest
import typer
from tests.conftest import Cluster, postgresql_binaries
from tests.soak import trials

TRIED = ("kills", "power losses", "faults", "backups restored", "link cuts", "late answers", "clock steps", "schedules")
DONE = ("rounds", "acknowledged", "refused")
WRONG = ("lost", "charged twice", "other faults")


def soak(
    minutes: Annotated[float, typer.Option(min=0, help="How long to go on. Every trial has one round at least.")] = 10,
    seed: Annotated[
        int, typer.Option(min=0, help="The seed of the first rounds; the next ones have the next seed.")
    ] = 0,
    only: Annotated[str | None, typer.Option(help="The name of the only trial to run.")] = None,
) -> None:
    """Try to make stores lose answers until the time is over, and print a table; exit with 1 if anything was wrong."""
    until = time.monotonic() + 60 * minutes
    with cluster() as databases:
        every = trials.every(databases)
        chosen = {name: trial for name, trial in every.items() if only in {None, name}}
        if not chosen:
            raise typer.BadParameter(f"There is no trial {only!r}. There are: {', '.join(every)}.")
        counts: dict[str, Counter[str]] = {name: Counter() for name in chosen}
        for number in itertools.count(seed):
            for name, trial in chosen.items():
                if number == seed or time.monotonic() < until:
                    counts[name] += one_round(name, trial, number)
            if time.monotonic() >= until:
                break
    typer.echo(table(counts))
    raise typer.Exit(any(found[fault] for found in counts.values() for fault in WRONG))


def one_round(name: str, trial: trials.Trial, seed: int) -> Counter[str]:
    """Return what one round of a trial counted. If anything was wrong, say how to repeat it, and keep its files."""
    folder = Path(tempfile.mkdtemp(prefix="waypost-soak-"))
    try:
        found = trial(folder, seed)
    except pytest.skip.Exception as reason:
        typer.echo(f"{name}: not run: {reason}", err=True)
        found = Counter({"rounds": -1})
    except Exception:
        traceback.print_exc()
        found = Counter({"broken off": 1})
    others = {fault: n for fault, n in found.items() if fault not in {*TRIED, *DONE, *WRONG}}
    found = Counter({one: n for one, n in found.items() if one not in others})
    found += Counter({"rounds": 1, "other faults": sum(others.values())})
    if any(found[fault] for fault in WRONG):
        again = f"make soak ARGS='--minutes 0 --seed {seed} --only \"{name}\"'"
        typer.echo(f"{name}, seed {seed}: {dict(found)} {others}. The files are in {folder}. Again: {again}", err=True)
    else:
        shutil.rmtree(folder)
    return found


def table(counts: Mapping[str, Counter[str]]) -> str:
    """Return the counts as a table in Markdown."""
    columns = (*DONE, *WRONG)
    rows = [["trial", "tried", *columns], ["---"] * (len(columns) + 2)]
    for name, found in counts.items():
        tried = ", ".join(f"{found[what]:,} {what}" for what in TRIED if found[what])
        rows.append([name, tried, *(f"{found[column]:,}" for column in columns)])
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


@contextmanager
def cluster() -> Iterator[Cluster | None]:
    """Run a PostgreSQL cluster that syncs; None where PostgreSQL is not installed."""
    binaries = postgresql_binaries()
    if binaries is None:
        typer.echo("PostgreSQL: not run: there are no PostgreSQL binaries (initdb, pg_ctl) on this machine", err=True)
        yield None
        return
    with tempfile.TemporaryDirectory(prefix="wp") as folder:
        made = Cluster(binaries, Path(folder), fsync=True)
        try:
            yield made
        finally:
            made.stop()


if __name__ == "__main__":
    typer.run(soak)
