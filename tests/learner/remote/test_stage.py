"""The learner's environment on a stage: what it performs, and a run whose demonstrations are played over the socket."""

import json
import logging
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

import httpx2
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import corridor, examples, outcome, store
from websockets.sync.client import ClientConnection

from waypost import wire
from waypost.client import Client
from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.experts.bot import Bot, BotSettings
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.stage import Stage, offer
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.training import RunOptions, train
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users

Start = Callable[[Settings], serving.Served]
domain = CorridorDomain()
translator = Translator(domain, Corridor(0, 6))
EAST, WEST = "east", "west"
kept: dict[str, bytes] = {}
keep = kept.update


def moves(*actions: str, known: int = 1, number: int = 1) -> wire.PlayMoves:
    """What a page sends that has chosen the subgoal east."""
    segments = [wire.DemoSegment(subgoal="east", actions=list(actions))] if actions else []
    return wire.PlayMoves(type="moves", number=number, segments=segments, known=known)


def performed(stage: Stage, *actions: str, known: int = 1) -> tuple[list[object], bool, bool]:
    states = stage.perform(moves(*actions, known=known))
    assert states.known == known
    return list(states.states), states.ended, states.succeeded


def test_what_is_not_known_yet_comes_back() -> None:
    stage = Stage(translator, keep)
    assert performed(stage, EAST, EAST) == ([1, 2], False, False)
    assert performed(stage, EAST, EAST, EAST, known=3) == ([3], False, False)
    assert performed(stage, EAST, EAST, EAST, known=0) == ([0, 1, 2, 3], False, False)


def test_taking_back_and_starting_over_are_moves_like_any_others() -> None:
    stage = Stage(translator, keep)
    performed(stage, EAST, EAST, EAST)
    assert performed(stage, EAST, WEST) == ([1, 0], False, False)
    assert performed(stage) == ([], False, False)
    assert performed(stage, EAST) == ([1], False, False)


def test_nothing_happens_after_the_end() -> None:
    stage = Stage(translator, keep)
    there = [EAST] * 6
    assert performed(stage, *there, WEST, WEST) == ([1, 2, 3, 4, 5, 6], True, True)
    assert performed(stage, *there[:-1], WEST, known=6) == ([4], False, False)


def test_each_state_has_its_picture_uploaded_before_it_is_shown() -> None:
    stage = Stage(translator, keep)
    kept.clear()
    first = stage.perform(moves(known=0))
    later = stage.perform(moves(EAST, WEST, known=1))
    assert (len(first.frames), len(later.frames)) == (1, 2)
    assert later.frames[1] == first.frames[0] != later.frames[0]
    assert set(kept) == {*first.frames, *later.frames}
    assert stage.perform(moves(EAST, EAST, known=9)).frames == []


def test_the_states_on_a_stage_have_their_landmarks() -> None:
    states = Stage(translator, keep).perform(moves(EAST, known=0))
    assert [{a: round(13 * box.left) for a, box in boxes.items()} for boxes in states.action_landmarks] == [
        {"east": 1},
        {"west": 0, "east": 2},
    ]
    assert [set(boxes) for boxes in states.landmarks] == [{"east", "target"}, {"west", "east", "target"}]


def test_a_page_that_knows_more_than_there_is_is_told_so() -> None:
    states = Stage(translator, keep).perform(moves(EAST, known=9))
    assert (states.known, states.states) == (2, [])


@examples
@given(st.lists(st.lists(st.sampled_from([EAST, WEST]), max_size=9), max_size=6))
def test_wherever_it_was_before_it_performs_what_a_new_environment_would(plays: list[list[str]]) -> None:
    stage = Stage(translator, keep)
    for actions in plays:
        assert stage.perform(moves(*actions)) == Stage(translator, keep).perform(moves(*actions))


# --- over a server


Connect = Callable[[serving.Served, str, wire.Role], Client]


@pytest.fixture
def connect() -> Iterator[Connect]:
    """Clients of new users; all are closed when the test ends."""
    with ExitStack() as stack:

        def connect(served: serving.Served, name: str, role: wire.Role) -> Client:
            user = served.db.write_now(lambda tx: users.ensure_user(tx, name, role))
            token = served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "")).token
            client = Client(served.url, token)
            stack.callback(client.close)
            return client

        yield connect


class Player:
    """An annotator who plays what has to be demonstrated, and answers everything else as a bot."""

    def __init__(self, client: Client) -> None:
        self._client, self._expert = client, OracleExpert(domain)
        self.seen: list[wire.PlayStates] = []

    def work_until(self, over: threading.Event) -> None:
        others = Bot(self._client, BotSettings(kinds=("inspect_full", "label_hi", "inspect_lo", "label_lo")))
        while not over.is_set():
            held = self._client.lease(wire.Lease(kinds=["hier_demo"]))
            if held is not None:
                answer = self._expert(held.query.ask)
                assert isinstance(answer, wire.HierDemoAnswer)
                self.seen.append(play(self._client, held, answer))
                self._client.answer(held, answer)
            else:
                others.work(wait=0.02)


def play(client: Client, held: wire.Assignment, answer: wire.HierDemoAnswer) -> wire.PlayStates:
    """Play a demonstration and return what the learner's environment said last."""
    with at_table(client, held) as socket:
        socket.send(wire.PlayMoves(type="moves", number=1, segments=answer.segments, known=1).model_dump_json())
        return wire.PlayStates.model_validate_json(socket.recv(timeout=20))


@contextmanager
def at_table(client: Client, held: wire.Assignment) -> Iterator[ClientConnection]:
    """Be at the play socket, the learner's environment being there."""
    with client.play(held.query.id) as socket:
        socket.send(wire.PlayTake(type="take", assignment=held.id, token=held.token).model_dump_json())
        while not json.loads(socket.recv(timeout=20))["present"]:
            pass
        yield socket


def stages() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if thread.name == "stage"]


@pytest.mark.parametrize(("algorithm", "in_flight"), [("hg-dagger", 1), ("hg-dagger", 3), ("hg-takeover", 3)])
def test_a_run_whose_demonstrations_are_played_is_the_run_that_the_oracle_answers(
    start_server: Start, connect: Connect, tmp_path: Path, algorithm: str, in_flight: int
) -> None:
    config = corridor(algorithm=algorithm, episodes=24 if algorithm == "hg-takeover" else 6, in_flight=in_flight)
    with store(tmp_path / "oracle") as (connection, options):
        expected = outcome(connection, train(config, connection, options))
    served = start_server(Settings(database=f"sqlite:///{tmp_path / 'played.db'}"))
    learner, player = connect(served, "learner", "learner"), Player(connect(served, "ann", "annotator"))
    over = threading.Event()
    working = threading.Thread(target=player.work_until, args=[over])
    working.start()
    try:
        connection = Connection(learner, None)
        summary = train(config, connection, RunOptions(checkpoints=tmp_path / "checkpoints", threads=1))
    finally:
        over.set()
        working.join()
    assert outcome(connection, summary) == expected
    assert all(states.succeeded and states.ended for states in player.seen[:3])  # the warm start
    assert (len(player.seen) > 3) == (algorithm == "hg-takeover")
    wait_until(lambda: not stages())  # each was withdrawn with its answer


def wait_until(holds: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 20
    while not holds():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def asked(learner: Client) -> wire.Query:
    """Ask for a demonstration in a new run."""
    run = learner.create_run(wire.RunCreate(name="stage", algorithm="h-bc", seed=0, vocabulary=vocabulary(domain)))
    demo = HierDemo(Simulator(domain).reset(translator.instance))
    return learner.ask(run.id, [translator.ask(demo, 0, 0)])[0]


def test_a_server_that_was_started_again_finds_the_environment_as_it_was(connect: Connect, tmp_path: Path) -> None:
    settings = Settings(database=f"sqlite:///{tmp_path / 'waypost.db'}")
    with serving.background(settings) as served:
        learner, annotator = connect(served, "learner", "learner"), connect(served, "ann", "annotator")
        query = asked(learner)
        held = annotator.lease(wire.Lease())
        assert held is not None
        withdraw = offer(lambda: learner.play(query.id), translator, learner.upload)
        with at_table(annotator, held) as socket:
            socket.send(moves(EAST).model_dump_json())
            assert json.loads(socket.recv(timeout=20))["states"] == [1]
        port = httpx2.URL(served.url).port
    assert port is not None
    with serving.background(settings, port=port), at_table(annotator, held) as socket:
        socket.send(moves(EAST, EAST, known=2).model_dump_json())
        assert json.loads(socket.recv(timeout=20))["states"] == [2]
        withdraw()
        assert json.loads(socket.recv(timeout=20)) == {"type": "stage", "present": False}
    wait_until(lambda: not stages())


def test_a_learner_that_is_turned_away_says_why_once(
    start_server: Start, connect: Connect, sqlite_url: str, caplog: pytest.LogCaptureFixture
) -> None:
    served = start_server(Settings(database=sqlite_url))
    query = asked(connect(served, "learner", "learner"))
    other = connect(served, "other", "learner")
    with caplog.at_level(logging.WARNING, "waypost"):
        offer(lambda: other.play(query.id), translator, other.upload)
        wait_until(lambda: not stages())
    assert [
        record.message for record in caplog.records if f"Run {query.run} belongs to learner" in record.message
    ] != []
    assert len([record for record in caplog.records if record.name == "waypost"]) == 1
