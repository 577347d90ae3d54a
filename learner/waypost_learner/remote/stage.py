"""Offer the learner's environment over the play socket, so that a person can give a demonstration in the web app.

The web app sends all actions of the demonstration each time, and the learner carries them out. So nothing is lost when
a connection, an environment or a process ends: the web app connects again and sends all actions again.
"""

import logging
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from http import HTTPStatus

from websockets.exceptions import ConnectionClosed, InvalidStatus, WebSocketException
from websockets.frames import CloseCode
from websockets.sync.client import ClientConnection

from waypost import wire
from waypost.domains import replay_of
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator

_FIRST_PAUSE, _LONGEST_PAUSE = 0.1, 2.0  # seconds between attempts to connect
_PASSING = frozenset({408, 429})  # client errors after which to connect again, as after server errors

log = logging.getLogger("waypost")

Connect = Callable[[], AbstractContextManager[ClientConnection]]
Upload = Callable[[Mapping[str, bytes]], None]


class Stage:
    """One instance's environment, in the state that a demonstration has reached.

    Args:
        translator: the translator of the demonstration's query.
        upload: called with frames to upload, PNG files by hash.
    """

    def __init__(self, translator: Translator, upload: Upload) -> None:
        self._translator, self._upload = translator, upload
        self._before = translator.before
        self._simulator = Simulator(translator.domain, pictures=True)
        self._replay = replay_of(translator.domain)
        self._camera = Camera(translator.domain, translator.instance)  # not the translator's, which another thread uses
        self._begin()

    def perform(self, moves: wire.PlayMoves) -> wire.PlayStates:
        """Carry out the actions of a demonstration, and return the states that the web app does not have."""
        names = self._translator.domain.actions
        actions = [names.index(action) for segment in moves.segments for action in segment.actions]
        again = self._actions != actions[: len(self._actions)]
        if again:
            self._take_back(actions)
        self._advance(actions[len(self._actions) :])
        self._translator.played = (tuple(self._actions), tuple(self._states))
        # An environment that cannot return to a state does not repeat the states that the web app has.
        known = 0 if again and self._replay == "recorded" else min(moves.known, len(self._states))
        frames = self._frames()[known:]
        self._upload(self._camera.developed())
        return wire.PlayStates(
            type="states",
            number=moves.number,
            known=known,
            states=[state.view for state in self._states[known:]],
            frames=frames,
            **self._translator.landmarks(self._states[known:] if frames else ()),
            ended=self._simulator.ended,
            succeeded=self._simulator.succeeded,
        )

    def _frames(self) -> list[str]:
        """Return the hashes of the frames of the states so far. A camera wants all actions since the episode began."""
        actions = [action for segment in self._before for action in segment.actions]
        states = [state for segment in self._before for state in segment.states[:-1]]
        frames = self._camera.along([*actions, *self._actions], [*states, *self._states])
        return frames[len(actions) :]

    def _begin(self) -> None:
        self._states = [self._simulator.go_to_end(self._translator.instance, self._before)]
        self._actions: list[int] = []

    def _take_back(self, actions: Sequence[int]) -> None:
        """Return to the last state that the actions have in common with those carried out."""
        if self._replay != "snapshots":
            self._begin()
            return
        common = 0
        while common < min(len(actions), len(self._actions)) and actions[common] == self._actions[common]:
            common += 1
        self._states, self._actions = self._states[: common + 1], self._actions[:common]
        self._simulator.restore(self._states[-1])

    def _advance(self, actions: Sequence[int]) -> None:
        for action in actions:
            if self._simulator.ended:
                break
            self._states.append(self._simulator.step(action))
            self._actions.append(action)


class Offer:
    """Keeps a stage connected, on a thread, until it is withdrawn or refused permanently.

    Args:
        connect: opens the play socket of the query.
        translator: the translator of the query.
        upload: called with frames to upload.
    """

    def __init__(self, connect: Connect, translator: Translator, upload: Upload) -> None:
        self._connect, self._stage = connect, Stage(translator, upload)
        self._over = threading.Event()
        self._socket: ClientConnection | None = None
        self._lock = threading.Lock()  # held by connecting and by withdrawing
        threading.Thread(target=self._run, name="stage", daemon=True).start()

    def withdraw(self) -> None:
        """Close the socket and let the thread end."""
        with self._lock:
            self._over.set()
            if self._socket is not None:
                self._socket.close()

    def _run(self) -> None:
        pause = _FIRST_PAUSE
        while not self._over.is_set():
            try:
                with self._connect() as socket:
                    pause = _FIRST_PAUSE
                    self._play(socket)
            except (OSError, WebSocketException) as trouble:
                status = _refusal(trouble)
                if status is not None:
                    if status != HTTPStatus.CONFLICT:  # the query is answered, or another process offers it
                        log.warning("Nobody can play a demonstration: %s", trouble)
                    return
            self._over.wait(pause)
            pause = min(2 * pause, _LONGEST_PAUSE)

    def _play(self, socket: ClientConnection) -> None:
        with self._lock:
            if self._over.is_set():
                return
            self._socket = socket
        socket.send(wire.PlayOffer(type="offer").model_dump_json())
        while True:
            moves = wire.PlayMoves.model_validate_json(socket.recv())
            socket.send(self._stage.perform(moves).model_dump_json())


def offer(connect: Connect, translator: Translator, upload: Upload) -> Callable[[], None]:
    """Offer an instance's environment on a play socket, and return a function that withdraws the offer."""
    return Offer(connect, translator, upload).withdraw


def _refusal(trouble: Exception) -> int | None:
    """Return the status of a permanent refusal; None if connecting again may succeed.

    The status is the handshake's HTTP status, or the close code minus 4,000.
    """
    if isinstance(trouble, InvalidStatus):
        status = trouble.response.status_code
    elif isinstance(trouble, ConnectionClosed) and trouble.rcvd is not None:
        too_big = trouble.rcvd.code == CloseCode.MESSAGE_TOO_BIG
        status = HTTPStatus.REQUEST_ENTITY_TOO_LARGE if too_big else trouble.rcvd.code - 4_000
    else:
        return None
    return status if 400 <= status < 500 and status not in _PASSING else None
