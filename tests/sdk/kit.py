"""What the tests of a run are written with: a learner's script and an annotator, and segments to ask about."""

from typing import Any

import numpy as np

import waypost
from waypost import wire
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.users import service as users

NAMES: dict[str, Any] = {"subgoals": ["door", "key"], "actions": ["left", "right"]}
DARK = np.zeros((2, 2, 3), np.uint8)
WALK = waypost.Segment(states=[0, 1, 2], actions=["right", "right"], subgoal="door")
BACK = waypost.Segment(states=[2, 1], actions=["left"], subgoal="key")


class Service:
    """A learner's script and an annotator, for one test."""

    def __init__(self, served: serving.Served, name: str) -> None:
        self._served, self.name = served, name
        self.url, self.token = served.url, self._token("lea", "learner")
        self._clients = list[waypost.Client]()
        self._runs = list[waypost.Run]()
        self.annotator = self.client(self._token("abe", "annotator"))

    def _token(self, name: str, role: wire.Role) -> str:
        user = self._served.db.write_now(lambda tx: users.ensure_user(tx, name, role))
        return self._served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "")).token

    def client(self, token: str) -> waypost.Client:
        self._clients.append(waypost.Client(self.url, token))
        return self._clients[-1]

    def close(self) -> None:
        for client in self._clients:
            client.close()

    def start(self, name: str | None = None, **more: Any) -> waypost.Run:
        run = waypost.start_run(name or self.name, client=self.client(self.token), **(NAMES | more))
        self._runs.append(run)
        return run

    def lease(self, wait: float = 10) -> wire.Assignment:
        """Lease the next query of the newest run."""
        assignment = self.annotator.lease(wire.Lease(wait=wait, run=self._runs[-1].id))
        assert assignment is not None, "no query is open"
        return assignment

    def answer(self, n: int = 1, verdict: wire.Verdict = "pass") -> None:
        """Answer the next inspections."""
        for _ in range(n):
            assignment = self.lease()
            kind: Any = assignment.query.ask.kind
            self.annotator.answer(assignment, wire.InspectAnswer(kind=kind, verdict=verdict))


def inspection(episode: int = 0, last: Any = 2) -> waypost.InspectFull:
    return waypost.InspectFull([waypost.Segment([0, 1, last], ["right", "right"])], episode=episode)
