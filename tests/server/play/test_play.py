"""The play socket: who is let in, what is relayed, and what is refused, against a real server."""

import json
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from typing import Any
from urllib.parse import urlsplit

import httpx2
import pytest
from tests.server.kit import API, Caller, Json, Service, query
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from waypost_server import serving
from waypost_server.auth import sessions
from waypost_server.auth.permissions import COOKIE
from waypost_server.settings import Settings
from waypost_server.users import service as users

Start = Callable[[Settings], serving.Served]
MOVES = {"type": "moves", "number": 7, "segments": [{"subgoal": "north", "actions": ["up", "up"]}], "known": 1}
STATES = {"type": "states", "number": 7, "known": 1, "states": [[1], [2]], "ended": False, "succeeded": False}
OFFER = {"type": "offer"}
HERE, GONE = {"type": "stage", "present": True}, {"type": "stage", "present": False}


@dataclass
class Play:
    """A server with one demonstration asked, leased to the annotator."""

    served: serving.Served
    service: Service
    held: Json

    @property
    def query(self) -> int:
        return int(self.held["query"]["id"])

    def open(self, token: str | None = None, query: int | None = None, **headers: str) -> Any:
        """Open the socket with a token, or with headers alone."""
        given = headers | ({} if token is None else {"Authorization": f"Bearer {token}"})
        address = f"{self.served.url.replace('http', 'ws')}{API}/queries/{query or self.query}/play"
        return connect(address, additional_headers=given)

    @contextmanager
    def page(self, **changes: Any) -> Iterator[ClientConnection]:
        """The annotator at the socket."""
        with self.open(self.service.annotator.token) as socket:
            say(socket, {"type": "take", "assignment": self.held["id"], "token": self.held["token"]} | changes)
            yield socket

    @contextmanager
    def stage(self, caller: Caller | None = None) -> Iterator[ClientConnection]:
        """The learner at the socket."""
        with self.open((caller or self.service.learner).token) as socket:
            say(socket, OFFER)
            yield socket

    @contextmanager
    def both(self) -> Iterator[tuple[ClientConnection, ClientConnection]]:
        """Both ends, each knowing of the other."""
        with self.page() as page, self.stage() as stage:
            while heard(page) != HERE:
                pass
            yield page, stage


def say(socket: ClientConnection, message: Any) -> None:
    socket.send(message if isinstance(message, str | bytes) else json.dumps(message))


def heard(socket: ClientConnection) -> Any:
    return json.loads(socket.recv(timeout=10))


def ending(socket: ClientConnection) -> tuple[int, str]:
    """Read on until the socket is closed; returns the code and the words."""
    try:
        while True:
            socket.recv(timeout=10)
    except ConnectionClosed:
        return socket.close_code or 0, socket.close_reason or ""


@contextmanager
def service_of(served: serving.Served) -> Iterator[Service]:
    with httpx2.Client(base_url=served.url, timeout=30) as client:
        yield Service(client, served.db)


def play_at(served: serving.Served, service: Service) -> Play:
    """A demonstration of a new run, leased."""
    run = service.learner.create_run()
    service.learner.ask(run, query("hier_demo"))
    return Play(served, service, service.annotator.lease(run=run))


@pytest.fixture
def play(database_url: str, start_server: Start) -> Iterator[Play]:
    served = start_server(Settings(database=database_url))
    with service_of(served) as service:
        yield play_at(served, service)


@pytest.fixture(scope="module")
def one_server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[serving.Served, Service]]:
    """A server for the tests in which the kind of database makes no difference."""
    store = tmp_path_factory.mktemp("play") / "waypost.db"
    settings = Settings(database=f"sqlite:///{store}", body_seconds=0.5)
    with serving.background(settings) as served, service_of(served) as service:
        yield served, service


@pytest.fixture
def simple(one_server: tuple[serving.Served, Service]) -> Play:
    return play_at(*one_server)


def test_moves_go_to_the_learner_and_states_come_back(play: Play) -> None:
    with play.both() as (page, stage):
        say(page, MOVES)
        assert heard(stage) == MOVES
        say(stage, STATES)
        assert heard(page) == STATES


def test_the_page_is_told_when_the_learner_leaves_and_when_it_is_back(simple: Play) -> None:
    with simple.page() as page:
        assert heard(page) == GONE
        with simple.stage():
            assert heard(page) == HERE
        assert heard(page) == GONE
        with simple.stage() as stage:
            assert heard(page) == HERE
            say(page, MOVES)
            assert heard(stage) == MOVES


def test_a_new_connection_takes_the_place_of_one_that_was_cut_off(simple: Play) -> None:
    with simple.both() as (old_page, old_stage), simple.page() as page:
        assert ending(old_page)[0] == 4409
        assert heard(page) == HERE
        with simple.stage() as stage:
            assert ending(old_stage)[0] == 4409
            assert heard(page) == HERE
            say(page, MOVES)
            assert heard(stage) == MOVES


def test_two_demonstrations_at_once_do_not_mix(simple: Play) -> None:
    other = play_at(simple.served, simple.service)
    assert other.query != simple.query
    with simple.both() as (page, stage), other.both() as (other_page, other_stage):
        say(page, MOVES)
        say(other_page, MOVES | {"number": 8})
        assert heard(stage)["number"] == 7
        assert heard(other_stage)["number"] == 8
        say(other_stage, STATES | {"number": 8})
        assert heard(other_page)["number"] == 8


# --- who is refused


def test_a_stranger_and_a_viewer_do_not_get_in(simple: Play) -> None:
    for token, code in ((None, 4401), ("wp_wrong", 4401), (simple.service.viewer.token, 4403)):
        with simple.open(token) as socket:
            assert ending(socket)[0] == code


def test_another_host_name_is_refused_at_the_handshake(simple: Play) -> None:
    here = urlsplit(simple.served.url)
    address = f"ws://rebound.example:{here.port}{API}/queries/{simple.query}/play"
    with pytest.raises(InvalidStatus) as caught, connect(address, address=(here.hostname, here.port), proxy=None):
        pass
    assert caught.value.response.status_code == 403


def test_a_session_is_good_from_the_servers_own_page_alone(simple: Play) -> None:
    db = simple.served.db
    user = db.write_now(lambda tx: users.ensure_user(tx, "abe", "annotator"))
    code = db.write_now(lambda tx: sessions.create_login_link(tx, user.id, 60)).code
    own = {"Origin": simple.served.url}
    login = simple.service.client.post(f"{API}/session", json={"code": code}, headers=own)
    cookie = f"{COOKIE}={login.cookies[COOKIE]}"
    foreign: list[dict[str, str]] = [{"Origin": "https://evil.example"}, {"Sec-Fetch-Site": "cross-site"}, {}]
    for headers in foreign:
        with simple.open(Cookie=cookie, **headers) as page:
            assert ending(page)[0] == 4403
    for headers in (own, {"Sec-Fetch-Site": "same-origin"}):
        with simple.open(Cookie=cookie, **headers) as page:
            say(page, {"type": "take", "assignment": simple.held["id"], "token": simple.held["token"]})
            assert heard(page) == GONE


def test_an_annotator_without_the_assignment_is_refused(play: Play) -> None:
    stranger = play.service.user("eve", "annotator")
    take = {"type": "take", "assignment": play.held["id"], "token": play.held["token"]}
    for token, hello, code in (
        (stranger.token, take, 4403),  # another's assignment, even with its token
        (play.service.annotator.token, take | {"token": "guessed"}, 4403),
        (play.service.annotator.token, take | {"assignment": 999}, 4404),
        (play.service.annotator.token, OFFER, 4403),  # an annotator is no learner
    ):
        with play.open(token) as socket:
            say(socket, hello)
            assert ending(socket)[0] == code


def test_an_assignment_of_another_query_is_refused(play: Play) -> None:
    asked = play.service.learner.ask(play.held["query"]["run"], query("inspect_full", ordinal=1))
    with play.open(play.service.annotator.token, query=asked[0]["id"]) as socket:
        say(socket, {"type": "take", "assignment": play.held["id"], "token": play.held["token"]})
        assert ending(socket)[0] == 4404
    held = play.service.annotator.lease()
    with play.open(play.service.annotator.token, query=asked[0]["id"]) as socket:
        say(socket, {"type": "take", "assignment": held["id"], "token": held["token"]})
        assert ending(socket) == (
            4409,
            f"not-playable: Query {asked[0]['id']} is inspect_full; only demonstrations are played.",
        )


def test_another_runs_learner_is_refused(play: Play) -> None:
    with play.page() as page:
        assert heard(page) == GONE
        with play.stage(play.service.user("luc", "learner")) as socket:
            assert ending(socket)[0] == 4403
        with play.stage(play.service.admin):
            assert heard(page) == HERE


def test_an_answered_demonstration_is_offered_and_played_no_more(play: Play) -> None:
    play.service.annotator.answer(play.held)
    with play.stage() as socket:
        assert ending(socket)[0] == 4409
    with play.page() as socket:
        assert ending(socket)[0] == 4409


def test_play_ends_with_the_lease(play: Play) -> None:
    with play.both() as (page, stage):
        play.service.annotator.release(play.held)
        assert ending(page)[0] == 4409
        with pytest.raises(TimeoutError):
            stage.recv(timeout=0.2)


def test_sockets_where_nothing_is_said_close_within_5_seconds_of_a_revocation(play: Play) -> None:
    with play.both() as (page, stage):
        start = time.monotonic()
        play.service.admin.change(play.service.annotator, active=False)
        play.service.admin.change(play.service.learner, role="viewer")
        assert ending(page)[0] == 4401
        assert ending(stage)[0] == 4403
        assert time.monotonic() < start + 5


# --- what is refused


@pytest.mark.parametrize(
    "message",
    [
        "not json",
        "[]",
        "NaN",
        b"\x00\x01",
        {"type": "dance"},
        MOVES | {"more": 1},
        MOVES | {"number": "7"},
        MOVES | {"segments": [{"subgoal": "north", "actions": []}]},
        MOVES | {"segments": [{"subgoal": "heaven", "actions": ["up"]}]},
        MOVES | {"segments": [{"subgoal": "north", "actions": ["fly"]}]},
        MOVES | {"segments": [{"subgoal": "north", "actions": ["up"] * 5}]},  # H_FULL is 4
        MOVES | {"segments": [{"subgoal": "north", "actions": ["up"]}] * 4},  # H_HI is 3
        STATES,
        "[" * 100_000,
    ],
    ids=lambda message: str(message)[:70],
)
def test_what_the_page_must_not_say_reaches_nobody(simple: Play, message: Any) -> None:
    with simple.both() as (page, stage):
        say(page, message)
        code, words = ending(page)
        assert code == 4422
        assert words
        with simple.page() as again:  # and does no harm
            say(again, MOVES)
            assert heard(stage) == MOVES


@pytest.mark.parametrize(
    "message", ["nonsense", STATES | {"states": "none"}, MOVES, '{"type": "states", "number": 1, "states": [NaN]}']
)
def test_what_the_learner_must_not_say_does_not_reach_the_page(simple: Play, message: Any) -> None:
    with simple.both() as (page, stage):
        say(stage, message)
        assert ending(stage)[0] == 4422
        assert heard(page) == GONE


def test_a_first_message_that_is_none_or_never_comes_closes_the_socket(simple: Play) -> None:
    with simple.open(simple.service.annotator.token) as socket:
        say(socket, MOVES)
        assert ending(socket)[0] == 4422
    with simple.open(simple.service.annotator.token) as socket:
        assert ending(socket)[0] == 4408


def test_a_message_too_large_closes_the_socket(simple: Play) -> None:
    with simple.both() as (page, stage):
        say(page, " " * (4 * 2**20 + 1))
        assert ending(page)[0] == 1009
        with simple.page() as again:
            say(again, MOVES)
            assert heard(stage) == MOVES


def test_more_messages_than_a_person_sends_close_the_socket(simple: Play) -> None:
    with simple.both() as (page, stage):
        drain = threading.Thread(target=ending, args=[stage])
        drain.start()
        with suppress(ConnectionClosed):
            for _ in range(2_000):
                say(page, MOVES)
        assert ending(page)[0] == 4429
        stage.close()
        drain.join()


def test_the_server_stops_at_once_with_sockets_open(sqlite_url: str) -> None:
    with ExitStack() as stack:
        served = stack.enter_context(serving.background(Settings(database=sqlite_url)))
        service = stack.enter_context(service_of(served))
        with play_at(served, service).both() as sockets:
            stop = time.monotonic()
            stack.close()
            assert time.monotonic() - stop < 5
            assert [ending(socket)[0] for socket in sockets] == [1012, 1012]
