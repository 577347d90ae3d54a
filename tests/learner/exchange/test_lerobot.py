"""The export to LeRobot, read by LeRobot's own loader in an environment of its own (`scripts/lerobot-venv FOLDER`)."""

import json
import os
import subprocess
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import minari
import numpy as np
import pytest
from tests.learner.exchange.kit import done, refused, trained

from waypost_learner.domains.corridor import CorridorDomain

ROOT = Path(__file__).parents[3]


def in_lerobots_environment(*arguments: str | Path) -> str:
    """Run Python where LeRobot is installed; return what it prints."""
    folder = os.environ.get("WAYPOST_LEROBOT")
    if not folder:
        pytest.skip(
            "WAYPOST_LEROBOT does not name an environment with LeRobot; `scripts/lerobot-venv FOLDER` makes one"
        )
    sources = os.pathsep.join(str(ROOT / part) for part in ("sdk", "server", "learner"))
    done = subprocess.run(
        [Path(folder) / "bin" / "python", *arguments],
        env={**os.environ, "PYTHONPATH": sources, "HF_HUB_OFFLINE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr[-3_000:]
    return done.stdout


@pytest.fixture(scope="module", params=["hg-dagger", "naive-h-dagger", "flat-dagger"])
def exported(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[dict[str, Any], list[Any], float]:
    """What LeRobot loads of a run, the same run's episodes from Minari, and the run's cost."""
    folder = tmp_path_factory.mktemp("lerobot")
    run = trained(folder, algorithm=request.param, episodes=8)
    source = ("export", run["run"], "--store", folder / "waypost.db")
    in_lerobots_environment("-m", "waypost_learner.cli", *source, "--format", "lerobot", "--out", folder / "data")
    here = Path(__file__).with_name("load_lerobot.py")
    loaded = json.loads(in_lerobots_environment(here, f"waypost/{run['run']}", folder / "data" / "dataset"))
    done(*source, "--format", "minari", "--out", folder / "minari")
    dataset = minari.MinariDataset(folder / "minari" / f"waypost-corridor-{run['run']}-v0" / "data")
    return loaded, list(dataset.iterate_episodes()), run["cost"]["total"]


def joined(episodes: list[Any], name: str, first: int) -> list[Any]:
    """An info of Minari's episodes: of the states before the actions (first = 0), or after them (first = 1)."""
    return [value for one in episodes for value in one.infos[name][first : first + len(one.actions)].tolist()]


def test_frames_are_the_steps_that_minari_has(exported: tuple[dict[str, Any], list[Any], float]) -> None:
    frames, episodes, _ = exported
    assert np.array_equal(frames["observation.state"], np.concatenate([one.observations[:-1] for one in episodes]))
    assert frames["executed_action"] == np.concatenate([one.actions for one in episodes]).tolist()
    assert frames["next.reward"] == np.concatenate([one.rewards for one in episodes]).tolist()
    assert frames["frame_index"] == [place for one in episodes for place in range(len(one.actions))]
    for name in ("segment", "subgoal", "expert_subgoal", "expert_action", "run_episode"):
        assert frames[name] == joined(episodes, name, 0), name
    for name in ("expert_termination", "inspect_lo", "inspect_full"):
        assert frames[f"next.{name}"] == joined(episodes, name, 1), name
    assert frames["next.annotator"] == [one.decode() for one in joined(episodes, "annotator", 1)]


def test_the_cost_is_the_runs(exported: tuple[dict[str, Any], list[Any], float]) -> None:
    frames, _, total = exported
    assert sum(frames["next.units"]) == total > 0


def test_corrections_are_interventions_and_the_action_to_imitate(
    exported: tuple[dict[str, Any], list[Any], float],
) -> None:
    frames, _, _ = exported
    steps = zip(*(frames[name] for name in ("action", "executed_action", "expert_action", "intervention")), strict=True)
    for action, executed, expert, intervention in steps:
        assert action.index(1) == (executed if expert == -1 else expert)
        assert sum(action) == 1
        assert intervention == (expert not in {-1, executed})


def test_subgoals_are_persistent_language_rows(exported: tuple[dict[str, Any], list[Any], float]) -> None:
    """The row in force at a frame is the last one that began, as LeRobot's renderer takes it."""
    frames, _, _ = exported
    names = CorridorDomain().subgoals
    for rows, at, subgoal, episode in zip(
        *(frames[name] for name in ("language", "timestamp", "subgoal", "episode_index")), strict=True
    ):
        begun = [row for row in rows if row["timestamp"] <= at]
        assert (begun[-1]["content"] if begun else None) == (None if subgoal == -1 else names[subgoal])
        assert all(row["style"] == "subtask" for row in rows)
        first = frames["episode_index"].index(episode)
        assert rows == frames["language"][first]


def test_a_training_step_lowers_the_loss(exported: tuple[dict[str, Any], list[Any], float]) -> None:
    before, after = exported[0]["losses"]
    assert after < before


@pytest.mark.skipif(find_spec("lerobot") is not None, reason="LeRobot is installed here")
def test_without_lerobot_the_export_says_what_to_install(tmp_path: Path) -> None:
    run = trained(tmp_path, algorithm="h-bc", episodes=1)["run"]
    sentence = refused(
        "export", run, "--store", tmp_path / "waypost.db", "--format", "lerobot", "--out", tmp_path / "data"
    )
    assert sentence.endswith("install it with `pip install 'waypost[learner,lerobot]'`.")
    assert not (tmp_path / "data").exists()
