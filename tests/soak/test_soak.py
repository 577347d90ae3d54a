"""`make soak` counts what it did and what was wrong, and its exit status says whether anything was."""

import re
from collections import Counter
from pathlib import Path

import pytest
import typer
from tests.soak import __main__ as soak
from tests.soak import trials
from typer.testing import CliRunner

app = typer.Typer()
app.command()(soak.soak)


@pytest.fixture(autouse=True)
def no_postgresql(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(soak, "postgresql_binaries", lambda: None)


def run(only: str, status: int = 0) -> tuple[dict[str, str], str]:
    """Run one trial once; returns the row of the table by column, and what was said of faults."""
    done = CliRunner().invoke(app, ["--minutes", "0", "--seed", "7", "--only", only])
    assert done.exit_code == status, done.output
    columns, _, row = (line.strip("| ").split(" | ") for line in done.stdout.strip().splitlines())
    return dict(zip(columns, row, strict=True)), done.stderr


@pytest.mark.parametrize(("trial", "what"), [("backups", "backups restored"), ("cuts", "link cuts")])
def test_a_round_loses_nothing_and_is_counted(monkeypatch: pytest.MonkeyPatch, trial: str, what: str) -> None:
    monkeypatch.setattr(trials, "N_QUERIES", 60)
    counted, _ = run(trial)
    assert int(counted["acknowledged"]) > 0
    assert re.fullmatch(f"[1-9][0-9]* {what}", counted["tried"])
    assert [counted[column] for column in ("rounds", *soak.WRONG)] == ["1", "0", "0", "0"]


def lossy(folder: Path, seed: int) -> Counter[str]:
    (folder / "store.db").touch()
    return Counter({"acknowledged": 9, "lost": 2, "The file is sound.": 1})


def broken(folder: Path, seed: int) -> Counter[str]:
    raise RuntimeError("no server")


@pytest.mark.parametrize(("trial", "lost", "others"), [(lossy, "2", "1"), (broken, "0", "1")])
def test_a_fault_is_counted_and_can_be_repeated(
    monkeypatch: pytest.MonkeyPatch, trial: trials.Trial, lost: str, others: str
) -> None:
    monkeypatch.setattr(trials, "every", lambda _: {"a trial": trial})
    counted, said = run("a trial", status=1)
    assert (counted["rounds"], counted["lost"], counted["other faults"]) == ("1", lost, others)
    assert '--seed 7 --only "a trial"' in said
