"""Pictures of states: of every state that a query shows, taken once, uploaded once, before the query is asked."""

import hashlib
import io
import json
from pathlib import Path
from typing import Any

import httpx2
import numpy as np
from PIL import Image
from tests.learner.kit import corridor, store

from waypost import wire
from waypost.client import Client
from waypost.trajectory import Segment, Trajectory
from waypost_learner.algorithms.queries import InspectFull, InspectLo
from waypost_learner.domains.corridor import AGENT, PIXELS, Corridor, CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.experts.bot import Bot
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.training import train
from waypost_server.queries import checks

WEST, EAST, TARGET = range(3)
domain = CorridorDomain()
instance = Corridor(3, 6)


def walked(*segments: tuple[int, list[int]]) -> Trajectory:
    simulator = Simulator(domain)
    state, sigma = simulator.reset(instance), []
    for subgoal, actions in segments:
        states = [state, *(simulator.step(action) for action in actions)]
        sigma.append(Segment(subgoal, tuple(states), tuple(actions), terminated=True))
        state = states[-1]
    return tuple(sigma)


def agents_cell(png: bytes) -> int:
    """Where the agent stands in a picture."""
    row = np.asarray(Image.open(io.BytesIO(png)))[PIXELS // 2]
    return int(np.flatnonzero((row == AGENT).all(axis=1))[0]) // PIXELS


def test_every_state_of_a_query_has_its_picture() -> None:
    sigma = walked((EAST, [1, 0]), (WEST, [0, 0, 0]))
    camera = Camera(domain, instance)
    ask: Any = Translator(domain, instance, camera).ask(InspectLo(sigma[1], sigma[:1]), 0, 0)
    files = camera.developed()
    assert all(hashlib.sha256(png).hexdigest() == name for name, png in files.items())
    for segment in (*ask.context, *ask.segments):
        assert [agents_cell(files[frame]) for frame in segment.frames] == segment.states


def test_landmarks_accompany_the_pictures_once_if_they_are_the_same_in_all_states() -> None:
    sigma = walked((EAST, [1, 0]), (WEST, [0, 0]))  # over the cells 3 4 3, and 3 2 1
    ask: Any = Translator(domain, instance, Camera(domain, instance)).ask(InspectLo(sigma[1], sigma[:1]), 0, 0)
    cells = [
        {name: (round(13 * box.left), round(13 * box.right)) for name, box in boxes.items()}
        for boxes in ask.context[0].landmarks
    ]
    near = {"west": (0, 1), "east": (4, 5), "target": (6, 7)}
    assert cells == [near, near | {"east": (8, 9)}, near]
    moves = [{name: round(13 * box.left) for name, box in boxes.items()} for boxes in ask.context[0].action_landmarks]
    assert moves == [{"west": 2, "east": 4}, {"west": 3, "east": 5}, {"west": 2, "east": 4}]
    [boxes] = ask.segments[0].landmarks
    assert boxes == ask.context[0].landmarks[0]
    assert (boxes["target"].top, boxes["target"].bottom) == (0, 1)
    checks.check_ask(ask, checks.Names.of(vocabulary(domain)), [])


def test_queries_without_pictures_have_no_landmarks() -> None:
    ask: Any = Translator(domain, instance).ask(InspectLo(walked((EAST, [1, 0]))[0]), 0, 0)
    assert (ask.segments[0].landmarks, ask.segments[0].action_landmarks) == ([], [])


def test_a_picture_is_taken_and_given_once() -> None:
    sigma = walked((EAST, [1, 0]), (WEST, [0, 0, 0]))
    camera = Camera(domain, instance)
    assert len(camera.frames(sigma[:1])[0]) == 3
    assert len(camera.developed()) == 2, "one cell was seen twice"
    camera.frames(sigma)
    assert len(camera.developed()) == 3
    camera.frames(sigma)
    assert camera.developed() == {}


def test_a_domain_without_pictures_gets_none() -> None:
    mazes = MazeDomain()
    maze = mazes.instances("corners").train[0]
    simulator = Simulator(mazes)
    states = (simulator.reset(maze), simulator.step(0))
    sigma = (Segment(0, states, (0,), terminated=True),)
    ask: Any = Translator(mazes, maze, Camera(mazes, maze)).ask(InspectFull(sigma), 0, 0)
    assert ask.segments[0].frames == []


class Between:
    """Stands between a learner and its server: sees what is uploaded, and has a bot answer when the learner waits."""

    def __init__(self, connection: Connection) -> None:
        assert connection.annotator is not None
        self._client, self._bot = connection.learner, Bot(connection.annotator)
        self.uploads: list[list[str]] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._client, name)

    def answers(self, run: str, after: int, wait: float = 0) -> wire.AnswerPage:
        self._bot.work(wait=0)
        return self._client.answers(run, after, wait)

    def upload(self, frames: dict[str, bytes]) -> None:
        self.uploads.append(list(frames))
        self._client.upload(frames)


def test_queries_for_others_carry_pictures_and_those_for_an_expert_in_this_process_do_not(tmp_path: Path) -> None:
    with store(tmp_path) as (connection, options):
        between: Any = Between(connection)
        train(corridor(episodes=6), Connection(between, connection.annotator), options)
        assert between.uploads == []
        run = train(corridor(episodes=6), Connection(between, None), options)["run"]
        shown = [
            (len(segment.frames), len(segment.states))
            for query in connection.learner.answers(run, 0).queries
            for segment in getattr(query.ask, "segments", [])
        ]
        assert shown
        assert all(n_frames == n_states for n_frames, n_states in shown)


def test_a_frame_is_sent_once_in_bodies_that_are_not_too_large() -> None:
    """The server, here, has one of the frames."""
    frames = {f"{number:064x}": bytes([number]) * 1_000_000 for number in range(5)}
    sent: list[list[str]] = []

    def answer(request: httpx2.Request) -> httpx2.Response:
        body = json.loads(request.content)
        if request.url.path.endswith("/missing"):
            return httpx2.Response(200, json={"hashes": body["hashes"][1:]})
        sent.append([one["hash"] for one in body["frames"]])
        assert len(request.content) < 4 * 2**20
        return httpx2.Response(204)

    client = Client("http://server", "token", httpx2.MockTransport(answer))
    client.upload(frames)
    client.upload(frames)
    client.close()
    assert [one for batch in sent for one in batch] == list(frames)[1:]
    assert len(sent) == 4
