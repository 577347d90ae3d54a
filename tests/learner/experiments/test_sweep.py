"""A sweep: every run once, whatever interrupts it."""

import fcntl
import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.learner.kit import corridor, history
from typer.testing import CliRunner

from waypost_learner.cli import app
from waypost_learner.experiments import plan
from waypost_learner.experiments.figures import archive
from waypost_learner.experiments.figures.data import KINDS, RunCurves
from waypost_learner.experiments.sweep import Place, Progress, sweep
from waypost_learner.remote.embedded import embedded
from waypost_learner.runs.config import TrainConfig
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users

# A preset of the product: a sweep's workers know no other.
_LITTLE = " ".join(f"train_{level}.least=640 train_{level}.most=640 train_{level}.idle=0" for level in ("hi", "lo"))
VALUES = {"preset": "lean", "values": _LITTLE}
RUNS = [corridor(algorithm=algorithm, seed=seed, **VALUES) for seed in (0, 1) for algorithm in ("hg-dagger", "h-bc")]
SCRIPT = """
import sys
from pathlib import Path
from waypost_learner.experiments.sweep import Place, sweep
from tests.learner.experiments.test_sweep import RUNS

if __name__ == "__main__":
    store = Path(sys.argv[1])
    print(sweep(RUNS, Place(store.with_suffix(".checkpoints"), store), jobs=2))
"""
RAY_SCRIPT = """
import sys
from pathlib import Path
from waypost_learner.experiments.sweep import Place, sweep
from tests.learner.experiments.test_sweep import RUNS

if __name__ == "__main__":
    place = Place(Path(sys.argv[1]), server=sys.argv[2], token=sys.argv[3])
    print(sweep(RUNS[:2], place, jobs=2, ray="auto"))
"""


def place(folder: Path) -> Place:
    return Place(folder / "checkpoints", folder / "waypost.db")


def contents(store: Path) -> dict[str, tuple[Any, ...]]:
    """All there is in a store, by run: what was asked, answered and charged, and the curves, but no times."""
    with embedded(store) as connection:
        client = connection.learner
        found = {}
        for run in client.runs():
            curves = client.curves(run.id)
            name = f"{run.algorithm} {run.seed}"
            assert name not in found, f"{name} was made twice"
            weights = (run.result or {}).get("weights")
            results = (curves.episode, curves.test_success, curves.cost, curves.cost_by_kind)
            found[name] = (run.state, weights, results, history(client, run.id))
        return found


@pytest.fixture(scope="module")
def uninterrupted(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Any, ...]]:
    folder = tmp_path_factory.mktemp("uninterrupted")
    assert sweep(RUNS, place(folder), jobs=1, backend="sequential") == {}
    return contents(folder / "waypost.db")


def test_every_run_is_made_and_the_next_sweep_makes_nothing(
    tmp_path: Path, uninterrupted: dict[str, tuple[Any, ...]]
) -> None:
    said: list[Progress] = []
    assert sweep(RUNS[:2], place(tmp_path), jobs=1, on_progress=said.append, backend="sequential") == {}
    assert sweep(RUNS, place(tmp_path), jobs=1, on_progress=said.append, backend="sequential") == {}
    assert contents(tmp_path / "waypost.db") == uninterrupted
    assert said[0] == Progress(finished=0, episodes=0)
    assert said[-1] == Progress(finished=4, episodes=48)


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_an_interrupted_sweep_started_again_ends_as_the_one_that_never_was(
    tmp_path: Path, uninterrupted: dict[str, tuple[Any, ...]], how: signal.Signals
) -> None:
    store = tmp_path / "waypost.db"
    env = {**os.environ, "PYTHONPATH": os.pathsep.join([str(Path.cwd()), *filter(None, sys.path)])}
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)

    def begun() -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [sys.executable, script, store], env=env, stdout=subprocess.PIPE, start_new_session=True
        )

    process = begun()
    deadline = time.monotonic() + 120
    while episodes_in(store) < 10:
        assert process.poll() is None, "the sweep ended before it could be interrupted"
        assert time.monotonic() < deadline, "the sweep did not begin"
        time.sleep(0.02)
    assert process.stdout is not None
    process.stdout.close()
    if how == signal.SIGINT:
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
    else:
        os.kill(process.pid, signal.SIGKILL)  # the sweep alone: its workers must notice
    process.wait(60)
    time.sleep(1.0)
    again = begun()
    assert again.communicate(timeout=240)[0].decode().strip().splitlines()[-1] == "{}"
    assert contents(store) == uninterrupted


def episodes_in(store: Path) -> int:
    if not store.exists():
        return 0
    try:
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as connection:
            return int(connection.execute("SELECT count(*) FROM episodes").fetchone()[0])
    except sqlite3.Error:  # not made yet
        return 0


def test_what_goes_wrong_in_one_run_is_told_and_the_others_go_on(tmp_path: Path) -> None:
    wrong = corridor(instances="no-such-instances")
    troubles = sweep([wrong, RUNS[0]], place(tmp_path), jobs=1, backend="sequential")
    assert list(troubles) == [plan.name_of(wrong)]
    assert "no-such-instances" in troubles[plan.name_of(wrong)]
    assert [run[0] for run in contents(tmp_path / "waypost.db").values()] == ["finished"]


def test_two_sweeps_do_not_work_in_the_same_place(tmp_path: Path) -> None:
    (tmp_path / "checkpoints").mkdir()
    with (tmp_path / "checkpoints" / "sweep.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        with pytest.raises(ValueError, match="another sweep is running"):
            sweep(RUNS[:1], place(tmp_path), jobs=1, backend="sequential")


def test_a_cluster_cannot_write_a_file_of_this_machine(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="give --server instead of --store"):
        sweep(RUNS[:1], place(tmp_path), jobs=1, ray="auto")


@pytest.fixture
def token(tmp_path: Path) -> Iterator[tuple[str, str]]:
    with serving.background(Settings(database=f"sqlite:///{tmp_path / 'server.db'}"), port=0) as server:
        user = server.db.write_now(lambda tx: users.ensure_user(tx, "sweeper", "admin"))
        yield server.url, server.db.write_now(lambda tx: tokens.create_token(tx, user.id, "sweep")).token


def test_a_sweep_can_write_to_a_server(tmp_path: Path, token: tuple[str, str]) -> None:
    at = Place(tmp_path / "checkpoints", server=token[0], token=token[1])
    assert sweep(RUNS[:1], at, jobs=1, backend="sequential") == {}
    assert sweep(RUNS[:1], at, jobs=1, backend="sequential") == {}
    with at.connect() as connection:
        assert [run.state for run in connection.learner.runs()] == ["finished"]


def test_the_command_refuses_a_figure_that_does_not_exist(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["sweep", "--figure", "mazes", "--store", str(tmp_path / "a.db")])
    assert done.exit_code == 2
    assert "the figures are: maze, options, lean, montezuma" in done.output
    assert list(tmp_path.iterdir()) == []


def test_the_command_lists_algorithms_domains_and_presets_that_exist(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["sweep", "--preset", "no-such", "--store", str(tmp_path / "a.db")])
    assert done.exit_code == 2
    assert "the presets are:" in done.output
    assert list(tmp_path.iterdir()) == []


def test_every_figure_is_made_of_runs_that_can_be_built() -> None:
    from waypost_learner.runs.setup import build_learner

    runs = plan.runs_of(plan.find_figure("maze"), seeds=(0,))
    assert len(set(runs)) == len(runs) > 10
    for config in runs:
        build_learner(config, threads=1)
    assert {type(config) for config in runs} == {TrainConfig}


def test_the_same_sweep_runs_on_a_ray_cluster(tmp_path: Path, token: tuple[str, str]) -> None:
    pytest.importorskip("ray", reason="Ray has no wheel for this Python")
    at = Place(tmp_path / "checkpoints", server=token[0], token=token[1])
    command = [sys.executable, "-c", RAY_SCRIPT, str(at.checkpoints), at.server, at.token]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join([str(Path.cwd()), *filter(None, sys.path)])}
    done = subprocess.run(command, env=env, capture_output=True, text=True)  # Ray leaves threads and sockets behind
    assert "{}" in done.stdout.splitlines(), done.stdout + done.stderr  # Ray may have more to say
    with at.connect() as connection:
        assert sorted(run.state for run in connection.learner.runs()) == ["finished", "finished"]


def test_runs_that_an_archive_holds_are_not_made_again(tmp_path: Path) -> None:
    there = plan.runs_of(plan.find_figure("naive"), seeds=(0,))
    numbers = np.arange(1_000.0)
    archive.write(
        tmp_path, [RunCurves(config, *[numbers] * 7, dict.fromkeys(KINDS, numbers), numbers, {}) for config in there]
    )
    command = ["sweep", "--figure", "naive", "--seeds", "0", "--from", str(tmp_path), "--store", str(tmp_path / "a.db")]
    done = CliRunner().invoke(app, [*command, "--json"])
    assert json.loads(done.stdout) == {"runs": 2, "failed": {}}
    assert "2 of 2 runs are finished" in CliRunner().invoke(app, command).stdout
