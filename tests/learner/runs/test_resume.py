"""A run that was interrupted goes on with `--resume` as if it never had been: weights, queries, costs, results."""

import json
import os
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from tests.learner.kit import corridor, outcome, store
from typer.testing import CliRunner

from waypost_learner.cli import app
from waypost_learner.remote.in_process import InProcessTransport
from waypost_learner.runs import driver
from waypost_learner.runs.checkpoints import read_header
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.training import train


class Interrupted(BaseException):
    """The learner's end, out of the blue."""


@contextmanager
def interrupted_at(call: int, before_it_arrives: bool, route: str = "") -> Iterator[None]:
    """Let everything end with the n-th call (to a route): before it arrives, or after it was carried out."""
    original: Callable[..., Any] = InProcessTransport.handle_request
    calls = 0

    def handle(transport: InProcessTransport, request: Any) -> Any:
        nonlocal calls
        calls += request.url.path.endswith(route)
        if calls == call and before_it_arrives:
            raise Interrupted
        response = original(transport, request)
        if calls == call:
            raise Interrupted
        return response

    InProcessTransport.handle_request = handle  # type: ignore[method-assign]
    try:
        yield
    finally:
        InProcessTransport.handle_request = original  # type: ignore[method-assign]


@pytest.fixture(autouse=True)
def frequent_checkpoints(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(driver, "CHECKPOINT_EVERY", 4)


def uninterrupted(path: Path, config: TrainConfig) -> tuple[Any, ...]:
    with store(path) as (connection, options):
        return outcome(connection, train(config, connection, options))


def interrupted(
    path: Path, config: TrainConfig, call: int, before_it_arrives: bool, route: str = ""
) -> tuple[Any, ...]:
    """The run, interrupted and resumed."""
    with store(path) as (connection, options):
        try:
            with interrupted_at(call, before_it_arrives, route):
                train(config, connection, options)
        except Interrupted:
            pass
        runs = connection.learner.runs()
        summary = train(config, connection, replace(options, resume=bool(runs)))
        assert len(connection.learner.runs()) == 1
        return outcome(connection, summary)


@pytest.mark.parametrize("in_flight", [1, 3])
def test_a_run_interrupted_at_any_call_and_resumed_is_the_run_that_never_was(tmp_path: Path, in_flight: int) -> None:
    config = corridor(in_flight=in_flight)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    # Calls 1 to 9 are of the first episode and there are about 120: around each of the checkpoints.
    for call, before_it_arrives in ((3, True), (25, False), (60, True), (110, False)):
        found = interrupted(tmp_path / f"interrupted-{call}", config, call, before_it_arrives)
        assert found == expected, f"interrupted at call {call}"


@pytest.mark.parametrize("algorithm", ["hg-dagger", "flat-dagger", "hg-dagger-q"])
def test_averages_and_what_they_are_of_survive_an_interruption(tmp_path: Path, algorithm: str) -> None:
    config = corridor(algorithm=algorithm, preset="tiny-lean", domain="maze", episodes=8)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    assert interrupted(tmp_path / "interrupted", config, 40, before_it_arrives=True) == expected


@pytest.mark.parametrize("algorithm", ["hg-dagger-q", "h-dqn", "flat-dqn"])
def test_experience_exploration_and_targets_survive_an_interruption(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, algorithm: str
) -> None:
    monkeypatch.setattr(driver, "CHECKPOINT_EVERY", 1)  # every 20 episodes, of reinforcement learning
    config = corridor(algorithm=algorithm, episodes=50)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    assert interrupted(tmp_path / "interrupted", config, 46, before_it_arrives=True) == expected


@pytest.mark.parametrize("algorithm", ["hg-dagger", "hg-dagger-q"])
def test_a_run_whose_environments_step_together_goes_on_as_it_would_have(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, algorithm: str
) -> None:
    monkeypatch.setattr(driver, "CHECKPOINT_EVERY", 1)  # so a group of 8 ends at a checkpoint
    config = corridor(algorithm=algorithm, episodes=30, environments=8)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    assert interrupted(tmp_path / "interrupted", config, 60, before_it_arrives=True) == expected


def test_a_run_with_redraw_goes_on_with_the_same_instances(tmp_path: Path) -> None:
    config = corridor(redraw=True)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    assert interrupted(tmp_path / "interrupted", config, 60, before_it_arrives=True) == expected


@pytest.mark.parametrize("share", [0.5, 0.0])
def test_what_is_trained_on_and_how_many_passed_survives_an_interruption(tmp_path: Path, share: float) -> None:
    sampled = f"monitoring.share={share} monitoring.rate=0.5 monitoring.confidence=0.5"
    config = corridor(values=f"train_hi.idle=32 train_lo.idle=32 {sampled}", episodes=20)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    for episode in (7, 10, 18):
        path = tmp_path / f"interrupted-{episode}"
        assert interrupted(path, config, episode, before_it_arrives=True, route="/episodes") == expected


def test_what_a_gate_remembers_survives_an_interruption(tmp_path: Path) -> None:
    config = corridor(algorithm="hg-gated", values='gate.kind="aim" gate.share=0.5', episodes=20)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    path = tmp_path / "interrupted"
    assert interrupted(path, config, 14, before_it_arrives=True, route="/episodes") == expected


def test_demonstrations_from_where_a_learner_failed_survive_an_interruption(tmp_path: Path) -> None:
    config = corridor(algorithm="hg-takeover", episodes=20)
    expected = uninterrupted(tmp_path / "uninterrupted", config)
    assert any(row[2]["kind"] == "hier_demo" and row[2]["context"] for row in expected[-1])
    for episode in (6, 14):
        path = tmp_path / f"interrupted-{episode}"
        assert interrupted(path, config, episode, before_it_arrives=True, route="/episodes") == expected


@pytest.mark.timeout(120)
def test_a_question_that_was_in_the_dead_experts_hands_is_given_back_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("WAYPOST_LEASE_SECONDS", "3000")  # its lease does not end by itself
    with store(tmp_path) as (connection, options):
        with pytest.raises(Interrupted), interrupted_at(5, before_it_arrives=True, route="/answer"):
            train(corridor(), connection, options)
        assert connection.annotator is not None
        assert len(connection.annotator.assignments()) == 1
        assert train(corridor(), connection, replace(options, resume=True))["ended"] == "finished"


def test_a_resumed_run_goes_on_from_its_checkpoint(tmp_path: Path) -> None:
    first: list[int] = []
    with store(tmp_path) as (connection, options):
        with pytest.raises(Interrupted), interrupted_at(7, before_it_arrives=False, route="/episodes"):
            train(corridor(), connection, options)
        train(corridor(), connection, replace(options, resume=True), lambda _, episode: first.append(episode))
    assert first == [4]


def test_resuming_a_finished_run_starts_a_new_one(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        first = train(corridor(episodes=2), connection, options)
        second = train(corridor(episodes=2), connection, replace(options, resume=True))
    assert first["run"] != second["run"]
    assert first["weights"] == second["weights"]


def test_only_an_unfinished_run_of_the_same_values_is_resumed(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        for config in (corridor(episodes=3), corridor(episodes=3, seed=2)):
            with pytest.raises(Interrupted), interrupted_at(15, before_it_arrives=True):
                train(config, connection, options)
        older = connection.learner.runs()[1].id
        assert train(corridor(episodes=3), connection, replace(options, resume=True))["run"] == older


def test_the_run_of_another_user_is_not_resumed(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        with pytest.raises(Interrupted), interrupted_at(15, before_it_arrives=True):
            train(corridor(episodes=3), connection, options)
        (others,) = connection.learner.runs()
        give = "UPDATE runs SET user_id = (SELECT id FROM users WHERE name = 'oracle')"
        with closing(sqlite3.connect(tmp_path / "waypost.db")) as file, file:
            file.execute(give)
        assert train(corridor(episodes=3), connection, replace(options, resume=True))["run"] != others.id


def test_a_finished_run_leaves_a_checkpoint_of_its_weights(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        summary = train(corridor(episodes=5), connection, options)
    header = read_header(options.checkpoints / f"{summary['run']}.safetensors")
    assert (header.run, header.progress.episodes, header.config) == (summary["run"], 5, corridor(episodes=5))


IMITATING = ["hg-dagger", "--domain", "corridor", "--preset", "tiny", "--episodes", "12"]
# Q-functions have a checkpoint every 20 episodes. Here they learn from the first on, from short segments.
REINFORCED = [
    "hg-dagger-q",
    "--domain",
    "montezuma",
    "--episodes",
    "28",
    "--values",
    "warm_start_hybrid=1 train_hi_hybrid.least=64 train_hi_hybrid.most=64 h_hi=2 h_lo_hybrid=12 dqn.least=32"
    " dqn.capacity=400 dqn.exploration.wander=8 dqn.exploration.until=2",
]


@pytest.mark.timeout(300)
@pytest.mark.parametrize(("values", "every", "killed_after"), [(IMITATING, 4, 10), (REINFORCED, 1, 24)])
def test_a_killed_waypost_train_resumed_reaches_the_weights_and_the_ledger_of_an_uninterrupted_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, values: list[str], every: int, killed_after: int
) -> None:
    command = ["train", *values, "--seed", "1"]
    killed, whole = str(tmp_path / "killed.db"), str(tmp_path / "whole.db")
    script = (
        "import os, signal\n"
        "from waypost_learner import cli\n"
        "from waypost_learner.remote.in_process import InProcessTransport\n"
        "from waypost_learner.runs import driver\n"
        "import tests.learner.kit\n"
        f"driver.CHECKPOINT_EVERY = {every}\n"
        "handle, reports = InProcessTransport.handle_request, []\n"
        "def handle_request(self, request):\n"
        "    reports.extend([request] * request.url.path.endswith('/episodes'))\n"
        f"    end = len(reports) == {killed_after}\n"
        "    return os.kill(os.getpid(), signal.SIGKILL) if end else handle(self, request)\n"
        "InProcessTransport.handle_request = handle_request\n"
        "cli.main()\n"
    )
    env = {**os.environ, "PYTHONPATH": os.pathsep.join([str(Path.cwd()), *filter(None, sys.path)])}
    done = subprocess.run([sys.executable, "-c", script, *command, "--store", killed], env=env, capture_output=True)
    assert done.returncode == -signal.SIGKILL, done.stderr.decode()
    (checkpoint,) = (tmp_path / "killed.db.checkpoints").glob("*.safetensors")
    assert 0 < read_header(checkpoint).progress.episodes < killed_after

    monkeypatch.setattr(driver, "CHECKPOINT_EVERY", every)
    resumed = CliRunner().invoke(app, [*command, "--store", killed, "--resume", "--json"])
    uninterrupted = CliRunner().invoke(app, [*command, "--store", whole, "--json"])
    one, other = json.loads(resumed.stdout), json.loads(uninterrupted.stdout)
    assert one["run"] == checkpoint.stem
    for same in ("weights", "cost", "episodes", "success_rate", "first_at"):
        assert one[same] == other[same]
