"""`waypost train | evaluate | oracle`: one line of JSON for programs, one sentence for what was wrong."""

import json
import re
import sqlite3
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import Result
from tests.learner import kit
from typer.testing import CliRunner

from waypost_learner import cli
from waypost_learner.domains.maze.files import save_mazes
from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.remote.embedded import embedded
from waypost_server import serving
from waypost_server.settings import Settings

TRAIN = ["train", "hg-dagger", "--domain", "corridor", "--preset", "tiny", "--seed", "1"]


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("WAYPOST_TOKEN", raising=False)
    assert kit.PRESETS["tiny"] is kit.TINY


def waypost(*arguments: str) -> Result:
    return CliRunner().invoke(cli.app, arguments)


def refused(*arguments: str, status: int = 2) -> str:
    """The one sentence a command fails with."""
    result = waypost(*arguments)
    assert result.exit_code == status, result.output + repr(result.exception)
    assert result.stdout == ""
    (sentence,) = result.stderr.splitlines()
    assert re.fullmatch(r"([A-Z]|\S+\.(npz|db|safetensors)\b).*[.?]", sentence), sentence
    return sentence


# --- what works


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """The store of a finished run, and what its training printed."""
    file = tmp_path_factory.mktemp("trained") / "waypost.db"
    result = waypost(*TRAIN, "--episodes", "8", "--store", str(file), "--json")
    assert result.exit_code == 0, result.output
    assert result.stderr == ""
    return file, result.stdout


def test_training_with_json_prints_one_line_with_the_documented_keys(trained: tuple[Path, str]) -> None:
    (line,) = trained[1].splitlines()
    summary = json.loads(line)
    expected = {
        "run": str,
        "algorithm": str,
        "domain": str,
        "seed": int,
        "episodes": int,
        "success_rate": float,
        "cost": dict,
        "first_at": dict,
        "wall_seconds": float,
    }
    assert {key: type(summary[key]) for key in expected} == expected
    values = ("hg-dagger", "corridor", 1, 8)
    assert tuple(summary[key] for key in ("algorithm", "domain", "seed", "episodes")) == values
    assert 0 <= summary["success_rate"] <= 1
    assert summary["cost"].keys() == {"total", "by_kind"}
    assert {"0.8", "0.9", "0.95"} <= summary["first_at"].keys()
    assert re.fullmatch("[0-9a-f]{64}", summary["weights"])


def test_the_ledgers_sum_is_the_cost_printed(trained: tuple[Path, str]) -> None:
    file, line = trained
    summary = json.loads(line)
    with sqlite3.connect(file) as store:
        ((micro,),) = store.execute("SELECT sum(units) FROM ledger WHERE run_id = ?", (summary["run"],))
    store.close()
    assert micro == round(1e6 * summary["cost"]["total"]) > 0
    assert summary["cost"]["total"] == sum(summary["cost"]["by_kind"].values())
    with embedded(file) as connection:
        assert connection.learner.costs(summary["run"]).total == summary["cost"]["total"]
        assert connection.learner.run(summary["run"]).result == summary


def test_the_preset_is_lean_unless_another_is_named() -> None:
    result = waypost("train", "h-bc", "--domain", "corridor", "--episodes", "1", "--store", "lean.db", "--json")
    assert result.exit_code == 0, result.output
    with embedded(Path("lean.db")) as connection:
        assert connection.learner.run(json.loads(result.stdout)["run"]).config["preset"] == "lean"


def test_values_that_are_given_one_by_one_are_all_used() -> None:
    one_by_one = ["--values", "warm_start=2", "--values", "h_lo=9"]
    result = waypost(*TRAIN, "--episodes", "1", "--store", "values.db", *one_by_one, "--json")
    assert result.exit_code == 0, result.output
    with embedded(Path("values.db")) as connection:
        assert connection.learner.run(json.loads(result.stdout)["run"]).config["values"] == "warm_start=2 h_lo=9"


def test_training_without_json_prints_a_summary_for_people(trained: tuple[Path, str]) -> None:
    result = waypost(*TRAIN, "--episodes", "8", "--store", str(trained[0]))
    assert result.exit_code == 0
    total = json.loads(trained[1])["cost"]["total"]
    assert f"Expert cost: {total:g} units" in result.stdout
    assert "8 episodes, finished." in result.stdout
    assert "Told of the domain: nothing" in result.stdout


def test_a_run_is_evaluated_on_as_many_episodes_as_asked_always_with_the_same_result(trained: tuple[Path, str]) -> None:
    file, line = trained
    run = json.loads(line)["run"]
    evaluation = ["evaluate", run, "--store", str(file), "--episodes", "60", "--json"]
    first, second = waypost(*evaluation), waypost(*evaluation)
    assert (first.exit_code, first.stdout) == (0, second.stdout)
    found = json.loads(first.stdout)
    assert found.keys() == {"episodes", "successes", "success_rate"}
    assert found["episodes"] == 60
    assert found["success_rate"] == found["successes"] / 60


def test_an_evaluation_takes_every_unseen_instance_once_unless_told_otherwise(trained: tuple[Path, str]) -> None:
    file, line = trained
    found = waypost("evaluate", json.loads(line)["run"], "--store", str(file), "--json")
    assert json.loads(found.stdout)["episodes"] == 52  # a third of the corridor's 156 pairs
    people = waypost("evaluate", json.loads(line)["run"], "--store", str(file))
    assert re.fullmatch(r"\d+ of 52 episodes succeeded: \d+\.\d%\n", people.stdout)


def test_a_run_is_evaluated_with_other_values_than_its_own(trained: tuple[Path, str]) -> None:
    file, line = trained
    evaluation = ["evaluate", json.loads(line)["run"], "--store", str(file), "--json"]
    own = json.loads(waypost(*evaluation).stdout)
    short = json.loads(waypost(*evaluation, "--values", "h_hi=1", "--values", "h_lo=1").stdout)
    assert short["successes"] < own["successes"]  # one action, instead of as many as the run's episodes have
    assert json.loads(waypost(*evaluation).stdout) == own
    assert "leave out values" in refused(*evaluation, "--values", "network.hidden=8")
    assert "'far'" in refused(*evaluation, "--values", "far=8")


def test_a_run_is_trained_on_the_mazes_of_a_file() -> None:
    save_mazes(Path("few.npz"), list(maze_set("corners")[0][:4]))
    arguments = ["--preset", "tiny", "--instances", "few.npz", "--episodes", "2", "--store", "s.db", "--json"]
    result = waypost("train", "h-bc", *arguments)
    assert result.exit_code == 0, result.output
    summary = json.loads(result.stdout)
    assert summary["cost"]["by_kind"]["hier_demo"] == summary["cost"]["total"] > 80
    found = waypost("evaluate", summary["run"], "--store", "s.db", "--episodes", "6", "--json")
    assert json.loads(found.stdout)["episodes"] == 6


def test_an_oracle_in_this_process_answers_at_a_real_server_too(
    trained: tuple[Path, str], start_server: Callable[[Settings], serving.Served], tmp_path: Path
) -> None:
    from waypost_server.auth import tokens
    from waypost_server.users import service as users

    served = start_server(Settings(database=f"sqlite:///{tmp_path / 'served.db'}"))
    admin = served.db.write_now(lambda tx: users.ensure_user(tx, "ann", "admin"))
    token = served.db.write_now(lambda tx: tokens.create_token(tx, admin.id, "test")).token
    result = waypost(*TRAIN, "--episodes", "8", "--server", served.url, "--token", token, "--json")
    assert result.exit_code == 0, result.output
    over_http, in_process = json.loads(result.stdout), json.loads(trained[1])
    for same in ("weights", "cost", "success_rate", "episodes"):
        assert over_http[same] == in_process[same]


# --- what was wrong


def test_names_that_do_not_exist_are_refused_with_those_that_do() -> None:
    assert "'dagger'; the algorithms are: flat-bc, flat-dagger" in refused("train", "dagger")
    assert re.search(
        r"'chess'; the installed domains are: .*corridor.*maze", refused("train", "h-bc", "--domain", "chess")
    )
    assert re.search(r"'best'; the presets are: .*paper", refused("train", "h-bc", "--preset", "best"))
    assert re.search(r"random, corners, .*or an .npz file", refused("train", "h-bc", "--instances", "circles"))
    assert "the only set is: random" in refused("train", "h-bc", "--domain", "corridor", "--instances", "all")
    kinds = refused("oracle", "--kinds", "inspect_full,label_all", "--token", "t")
    assert "'label_all'" in kinds
    assert all(kind in kinds for kind in ("hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo"))


def test_an_expert_that_does_not_exist_is_refused_with_the_choices() -> None:
    sentence = refused("train", "h-bc", "--expert", "me")
    assert "oracle" in sentence
    assert "queue" in sentence


def test_a_queue_needs_a_server() -> None:
    assert "--server URL" in refused("train", "h-bc", "--expert", "queue")


def test_a_server_keeps_its_own_store() -> None:
    sentence = refused("train", "h-bc", "--server", "http://127.0.0.1:9", "--store", "s.db", "--token", "t")
    assert "either --server or --store" in sentence


@pytest.mark.parametrize("command", [("train", "h-bc", "--server", "http://127.0.0.1:9"), ("oracle",)])
def test_a_server_needs_a_token(command: tuple[str, ...]) -> None:
    assert "WAYPOST_TOKEN" in refused(*command)


@pytest.mark.parametrize(
    ("faulty", "at_fault"),
    [
        ({"goal": None}, "no array `goal`"),
        ({"lava": np.zeros((1, 17, 17), int)}, "`lava` must be bool[N, 17, 17]"),
        ({"start": np.array([[0, 0]], np.int8)}, "`start` of maze 0"),
        ({"start": np.ones((2, 2), np.int8)}, "`start` has 2 rows"),
    ],
)
def test_an_npz_that_is_no_maze_set_is_refused_by_the_array_at_fault(faulty: dict[str, Any], at_fault: str) -> None:
    maze = maze_set("random")[0][0]
    arrays = {"lava": maze.lava[None], "start": np.array([maze.start]), "goal": np.array([maze.goal])} | faulty
    np.savez("mazes.npz", **{name: array for name, array in arrays.items() if array is not None})
    assert at_fault in refused("train", "h-bc", "--instances", "mazes.npz")


def test_a_file_that_is_missing_or_no_archive_is_refused_by_its_name() -> None:
    assert "there is no file none.npz" in refused("train", "h-bc", "--instances", "none.npz").lower()
    Path("text.npz").write_text("a maze")
    assert "text.npz is no maze set" in refused("train", "h-bc", "--instances", "text.npz")


def test_a_run_that_is_not_there_cannot_be_evaluated() -> None:
    assert "there is no checkpoint" in refused("evaluate", "no-such-run", "--store", "s.db").lower()


def test_a_torn_checkpoint_cannot_be_evaluated() -> None:
    Path("checkpoints").mkdir()
    Path("checkpoints/run.safetensors").write_bytes(b"torn")
    assert "is no checkpoint" in refused("evaluate", "run", "--checkpoints", "checkpoints")


def test_other_instances_that_do_not_exist_cannot_be_evaluated_on(trained: tuple[Path, str]) -> None:
    run = json.loads(trained[1])["run"]
    assert "'none'" in refused("evaluate", run, "--store", str(trained[0]), "--instances", "none")


def test_a_store_that_is_none_is_refused_by_its_name() -> None:
    Path("notes.db").write_text("no database, but long enough to be looked at as one " * 20)
    assert "notes.db" in refused(*TRAIN, "--episodes", "1", "--store", "notes.db")
    assert "nowhere" in refused(*TRAIN, "--episodes", "1", "--store", "nowhere/s.db")


def test_nothing_is_written_when_the_command_was_wrong() -> None:
    refused("train", "dagger")
    refused("train", "h-bc", "--instances", "circles")
    assert list(Path().iterdir()) == []


@pytest.mark.parametrize("command", [("train", "h-bc"), ("oracle",)])
def test_a_server_that_does_not_answer_ends_the_command_when_patience_is_over(command: tuple[str, ...]) -> None:
    there = ("--server", "http://127.0.0.1:9", "--token", "t", "--patience", "0.1")
    sentence = refused(*command, *there, status=1)
    assert "http://127.0.0.1:9" in sentence
    assert "does not answer" in sentence


def test_a_token_the_server_does_not_know_ends_the_command(
    start_server: Callable[[Settings], serving.Served], tmp_path: Path
) -> None:
    served = start_server(Settings(database=f"sqlite:///{tmp_path / 'served.db'}"))
    refused(*TRAIN, "--server", served.url, "--token", "wrong", status=1)
