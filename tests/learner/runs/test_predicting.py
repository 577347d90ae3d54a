"""While people answer, the learner sends what its policies would answer now, for those who review the answers."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from tests.learner.exchange.kit import AnsweredWhenAwaited
from tests.learner.kit import GREEDY, TINY, corridor, store

from waypost import wire
from waypost.domains import find_domain
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, LabelFull, LabelHi, LabelLo
from waypost_learner.policies.levels import HIERARCHY, Levels
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.rollout import RolloutSpec
from waypost_learner.runs import predicting
from waypost_learner.runs.predicting import Predicting
from waypost_learner.runs.training import train

Sent = dict[int, dict[int, wire.Answer]]


class Server:
    """Remembers what was sent to it: predictions by episode and query."""

    def __init__(self) -> None:
        self.sent: Sent = {}

    def put_predictions(self, _run: str, episode: int, predictions: Sequence[wire.Prediction]) -> None:
        self.sent[episode] = {one.query: one.answer for one in predictions}


def rolled_out(levels: Levels) -> tuple[Any, Any, Any]:
    """A learner that always chooses what it thinks best, with a rollout and its translator."""
    domain = find_domain("corridor")
    learner = Learner(domain, replace(TINY, rollouts=RolloutSpec(GREEDY)), seed=3, levels=levels, threads=1)
    start = learner.start(domain.instances("random").train[0], 0)
    return learner, learner.roll_out(start), Translator(domain, start.instance)


@pytest.mark.parametrize("levels", [HIERARCHY, Levels(flat=True)])
def test_policies_that_have_not_changed_would_answer_as_they_acted(levels: Levels) -> None:
    learner, sigma, translator = rolled_out(levels)
    server: Any = Server()
    now = Predicting(learner, server, "run")
    labels = [LabelFull(sigma)] if levels.flat else [LabelHi(sigma), *(LabelLo(segment) for segment in sigma)]
    for number, query in enumerate([InspectFull(sigma), *labels]):
        now.keep(number, query)
    now.now(5)
    suggested = [translator.ask(query, 0, 0).suggestion for query in labels]
    assert server.sent == {5: dict(enumerate(suggested, 1))}, "nothing is predicted where nothing is labeled"


def test_only_the_newest_queries_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(predicting, "MOST", 2)
    learner, sigma, _ = rolled_out(HIERARCHY)
    server: Any = Server()
    now = Predicting(learner, server, "run")
    for number in range(4):
        now.keep(number, LabelHi(sigma))
    now.now(0)
    assert list(server.sent[0]) == [2, 3]


def test_after_each_episode_a_few_queries_have_their_turn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(predicting, "AT_ONCE", 2)
    learner, sigma, _ = rolled_out(HIERARCHY)
    server: Any = Server()
    now = Predicting(learner, server, "run")
    now.after(0)
    for number in range(3):
        now.keep(number, LabelHi(sigma))
    for episode in range(1, 4):
        now.after(episode)
    assert {episode: list(sent) for episode, sent in server.sent.items()} == {1: [0, 1], 2: [2], 3: [0, 1]}


def test_people_who_review_a_run_see_what_its_policies_would_answer_at_its_end(tmp_path: Path) -> None:
    server = Server()

    class Between(AnsweredWhenAwaited):
        def put_predictions(self, run: str, episode: int, predictions: Sequence[wire.Prediction]) -> None:
            server.put_predictions(run, episode, predictions)
            connection.learner.put_predictions(run, episode, predictions)  # it refuses what does not fit

    with store(tmp_path) as (connection, options):
        client: Any = Between(connection)
        run = train(corridor(episodes=10), Connection(client, None), options)["run"]
        asked = [one for episode in range(10) for one in connection.learner.queries(run, episode)]
    assert set(server.sent[9]) == {one.id for one in asked if one.ask.kind.startswith("label")} != set()
