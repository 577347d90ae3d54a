"""What labels bought is measured after each change of the weights, beside their cost, and measuring changes nothing."""

import csv
from dataclasses import replace
from pathlib import Path

import pytest
from tests.learner.kit import corridor, outcome, store
from typer.testing import CliRunner

from waypost import wire
from waypost_learner.cli import app
from waypost_learner.runs import driver
from waypost_learner.runs.evaluation import evaluate, evaluate_run
from waypost_learner.runs.measuring import COLUMNS, Measuring
from waypost_learner.runs.setup import set_up
from waypost_learner.runs.training import train

CONFIG = corridor(episodes=12)


def measured(folder: Path) -> list[list[str]]:
    (file,) = folder.glob("**/*.measured.csv")
    header, *rows = csv.reader(file.read_text().splitlines())
    assert tuple(header) == COLUMNS
    return rows


@pytest.mark.parametrize("every", [1, 5])
def test_measuring_changes_nothing_of_a_run_and_ends_with_what_an_evaluation_finds(tmp_path: Path, every: int) -> None:
    with store(tmp_path / "plain") as (connection, options):
        expected = outcome(connection, train(CONFIG, connection, options))
    with store(tmp_path / "measured") as (connection, options):
        summary = train(CONFIG, connection, replace(options, measure="random", measure_every=every))
        assert outcome(connection, summary) == expected
        found = evaluate_run(options.checkpoints / f"{summary['run']}.safetensors", None, 0, threads=1)
    *_, last = measured(tmp_path / "measured")
    assert int(last[0]) >= 11  # the training that follows the last episode may have changed nothing
    assert last[2:] == [str(found.episodes), str(found.successes)]
    assert float(last[1]) <= summary["cost"]["total"]


def test_a_row_is_written_only_if_the_weights_have_changed_and_has_the_cost_so_far(tmp_path: Path) -> None:
    learner = set_up(CONFIG, threads=1).learner
    instances = learner.domain.instances("random").test
    cost = iter([3.0, 8.5])
    measuring = Measuring(learner, instances, tmp_path / "a.measured.csv", 0, lambda: next(cost))
    measuring.after(0)
    measuring.after(1)  # nothing has changed
    for policy in learner.imitators.values():
        for parameter in policy.acting.parameters():
            parameter.data.add_(0.5)
    measuring.after(2)
    rows = measured(tmp_path)
    assert [row[:2] for row in rows] == [["0", "3"], ["2", "8.5"]]
    assert rows[1][2:] == [str(len(instances)), str(evaluate(learner, instances, len(instances)).successes)]


def test_fewer_measurements_are_those_after_every_so_many_episodes(tmp_path: Path) -> None:
    for name, every in (("all", 1), ("some", 4)):
        with store(tmp_path / name) as (connection, options):
            train(CONFIG, connection, replace(options, measure="random", measure_every=every))
    every_row, some = ({row[0]: row for row in measured(tmp_path / name)} for name in ("all", "some"))
    assert some
    assert set(some) <= {"3", "7", "11", "12"}  # the last is after the training that follows the last episode
    assert all(every_row[episode] == row for episode, row in some.items() if episode in every_row)


def test_a_resumed_run_continues_its_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(driver, "CHECKPOINT_EVERY", 4)

    def interrupt(result: wire.EpisodeResult, _: float) -> None:
        if result.episode == 9:
            raise KeyboardInterrupt

    with store(tmp_path / "whole") as (connection, options):
        train(CONFIG, connection, replace(options, measure="random"))
    with store(tmp_path / "resumed") as (connection, options):
        with pytest.raises(KeyboardInterrupt):
            train(CONFIG, connection, replace(options, measure="random"), on_episode=interrupt)
        assert measured(tmp_path / "resumed")
        train(CONFIG, connection, replace(options, measure="random", resume=True))
    rows = measured(tmp_path / "resumed")
    again = [row for row in rows if row[0] == "8"][:1]  # the first episode after the checkpoint is always measured
    assert [row for row in rows if row not in again] == [
        row for row in measured(tmp_path / "whole") if row not in again
    ]


def test_unknown_instances_to_measure_on_are_refused_before_a_store_is_made(tmp_path: Path) -> None:
    arguments = [
        "train",
        "hg-dagger",
        "--domain",
        "corridor",
        "--measure",
        "nowhere",
        "--store",
        str(tmp_path / "a.db"),
    ]
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 2
    assert "no instances 'nowhere'" in result.stderr
    assert not (tmp_path / "a.db").exists()
