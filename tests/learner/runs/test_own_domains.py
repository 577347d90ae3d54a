"""Runs on domains that bring little: what is missing is said, and what fails is explained."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.learner import domains_kit
from tests.learner.kit import history, store
from typer.testing import CliRunner

from waypost import wire
from waypost.client import Client
from waypost.domains import find_domain
from waypost.trajectory import Segment
from waypost_learner.algorithms.queries import HierDemo, InspectFull
from waypost_learner.cli import app
from waypost_learner.experts.bot import Bot
from waypost_learner.policies.datasets import Dataset, Row
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.stage import Stage
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.training import train

HERE = "tests.learner.domains_kit"


def config(domain: str = "plain", **values: Any) -> TrainConfig:
    common = {"algorithm": "hg-dagger", "domain": f"{HERE}:{domain}", "preset": "tiny-lean", "episodes": 10}
    return TrainConfig(**common | values)


def moves(*actions: str, known: int = 1) -> wire.PlayMoves:
    segments = [wire.DemoSegment(subgoal="last", actions=list(actions))] if actions else []
    return wire.PlayMoves(type="moves", number=1, segments=segments, known=known)


def test_what_the_domain_lacks_is_printed_and_kept_in_the_configuration(tmp_path: Path) -> None:
    arguments = ["train", "hg-dagger", "--domain", f"{HERE}:plain", "--preset", "tiny-lean", "--episodes", "2"]
    done = CliRunner().invoke(app, [*arguments, "--store", str(tmp_path / "waypost.db"), "--json"])
    assert done.exit_code == 0, done.output
    assert "provides no views. Policies see whole observations." in done.stderr
    with store(tmp_path) as (connection, _):
        (run,) = connection.learner.runs()
    assert isinstance(run.config["not_provided"], dict)
    assert set(run.config["not_provided"]) == {"symmetries", "views", "planning", "places", "relabeling", "retracing"}


def test_a_domain_that_provides_everything_lacks_nothing(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        run = train(TrainConfig("hg-dagger", preset="tiny-lean", episodes=1), connection, options)["run"]
        assert "not_provided" not in connection.learner.run(run).config


def test_reinforcement_learning_refuses_a_domain_that_does_not_say_how_subgoals_end(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options), pytest.raises(ValueError, match="does not say how subgoals end"):
        train(config("bare", algorithm="hg-dagger-q", preset="tiny"), connection, options)


def test_pictures_in_bytes_are_learned_as_fractions_of_255(tmp_path: Path) -> None:
    data = Dataset((3, 12, 12))
    bright = np.full((3, 12, 12), 255, np.uint8)
    data.append([Row(bright, 0), Row(bright.astype(np.float32) / 255, 1)])
    observations, _ = data[[0, 1]]
    assert (observations[0] == observations[1]).all()
    assert float(observations.max()) == 1
    kept = Dataset((3, 12, 12))
    kept.load(data.tensors())
    assert (kept[[0, 1]][0] == observations).all()
    with store(tmp_path) as (connection, options):
        assert train(config(preset="tiny", episodes=4), connection, options)["episodes"] == 4


def test_a_domain_says_how_often_it_is_tested(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        run = train(config("rarely_tested"), connection, options)["run"]
        tests = connection.learner.curves(run).test_success
    assert [episode for episode, passed in enumerate(tests) if passed is not None] == [4, 9]


@pytest.mark.parametrize("name", ["recorded", "restorable"])
def test_pictures_of_an_environment_that_may_be_random_show_the_states_that_were_seen(name: str) -> None:
    domain = find_domain(f"{HERE}:{name}")
    simulator = Simulator(domain, pictures=True)
    states, actions = [simulator.reset(3)], list[int]()
    while not simulator.ended:
        actions.append(len(actions) % 2)
        states.append(simulator.step(actions[-1]))
    camera = Camera(domain, 3)
    frames = camera.frames([Segment(0, tuple(states), tuple(actions), terminated=False)])[0]
    cells = [state.view["cell"] for state in states]
    shown = {}
    for cell, frame in zip(cells, frames, strict=True):
        assert shown.setdefault(cell, frame) == frame, "one cell has one picture"
    assert len(set(shown.values())) == len(shown), "different cells have different pictures"


@pytest.mark.parametrize("name", ["recorded", "restorable"])
def test_a_demonstration_in_a_random_environment_is_learned_as_it_was_played(name: str) -> None:
    domain = find_domain(f"{HERE}:{name}")
    translator = Translator(domain, 3, Camera(domain, 3))
    stage = Stage(translator, lambda frames: None)
    stage.perform(moves("forth", "back"))
    played = stage.perform(moves("forth", "forth", "back", "forth", known=0))
    answer = wire.HierDemoAnswer(
        kind="hier_demo", segments=[wire.DemoSegment(subgoal="last", actions=["forth", "forth", "back", "forth"])]
    )
    learned: Any = translator.answer(answer)
    views = [state.view for segment in learned for state in segment.states]
    assert views == played.states[: len(views)]


def test_snapshots_keep_what_was_played_before_an_action_was_taken_back() -> None:
    domain = find_domain(f"{HERE}:restorable")
    stage = Stage(Translator(domain, 3), lambda frames: None)
    first = stage.perform(moves("back", "back", "forth", known=0))
    again = stage.perform(moves("back", "back", "back", known=0))
    assert again.states[:3] == first.states[:3]


def test_a_run_of_a_random_environment_goes_on_after_a_restart(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with store(tmp_path) as (connection, options):
        stopping: Any = _Stopping(connection.learner)
        values = {"warm_start": 0, "episodes": 3}
        monkeypatch.setattr(domains_kit.weather, "share", 0.0)
        with pytest.raises(Stopped):
            train(config("recorded", **values), Connection(stopping, None), options)
        monkeypatch.setattr(domains_kit.weather, "share", 1.0)
        resumed = replace(options, resume=True)
        summary = train(config("recorded", **values), connection, resumed)
        asked = history(connection.learner, summary["run"])
    assert summary["episodes"] == 3
    assert {row[1] for row in asked if row[0] == 0} >= {0, 1}, "the other episode was asked under a new number"


class Stopped(Exception):
    """The learner was stopped."""


class _Stopping:
    """Stands between a learner and its server, and stops the learner when it waits for the first answer."""

    def __init__(self, client: Client) -> None:
        self._client = client

    def __getattr__(self, name: str) -> Any:
        return getattr(self._client, name)

    def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
        raise Stopped


def test_code_that_fails_in_an_episode_is_explained_in_one_sentence(tmp_path: Path) -> None:
    arguments = ["train", "hg-dagger", "--domain", f"{HERE}:falling", "--preset", "tiny", "--episodes", "2"]
    done = CliRunner().invoke(app, [*arguments, "--store", str(tmp_path / "waypost.db")])
    assert done.exit_code == 2
    assert "'walk' failed: step raised RuntimeError: the motor is off (domains_kit.py, line" in done.stderr
    assert "Traceback" not in done.output


def test_an_oracle_that_is_stuck_is_explained(tmp_path: Path) -> None:
    arguments = ["train", "hg-dagger", "--domain", f"{HERE}:stuck", "--preset", "tiny", "--episodes", "1"]
    done = CliRunner().invoke(app, [*arguments, "--store", str(tmp_path / "waypost.db")])
    assert done.exit_code == 2
    assert "good_subgoals is empty in the state" in done.stderr


def test_a_bot_leaves_what_its_oracle_cannot_answer_to_others(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, _):
        assert connection.annotator is not None
        told: list[str] = []
        bot = Bot(
            connection.annotator,
            domains=[find_domain(f"{HERE}:stuck")],
            on_failure=lambda assignment, error: told.append(str(error)),
        )
        domain = find_domain(f"{HERE}:stuck")
        translator = Translator(domain, 1)
        run = connection.learner.create_run(
            wire.RunCreate(name="r", algorithm="h-bc", seed=0, vocabulary=vocabulary(domain))
        )
        simulator = Simulator(domain)
        start = simulator.reset(1)
        sigma = (Segment(0, (start, simulator.step(1)), (1,), terminated=True),)
        connection.learner.ask(
            run.id,
            [translator.ask(HierDemo(start), 0, 0), translator.ask(InspectFull(sigma), 0, 1)],
        )
        bot.work(wait=0)
        answered = [query.ask.kind for query in connection.learner.answers(run.id, 0).queries]
    assert len(told) == 1
    assert answered == ["inspect_full"]
