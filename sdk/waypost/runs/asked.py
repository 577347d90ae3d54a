"""A query that a training script has asked, and its answer."""

import math
import time
from typing import Generic, TypeVar

from waypost import wire
from waypost.client import Client, Refused
from waypost.runs.queries import plain

A = TypeVar("A")

POLL_SECONDS = 30.0


class QueryCancelled(Exception):
    """The run was finished before the query was answered, so it gets no answer."""


class AskedQuery(Generic[A]):
    """A query that was asked, which has an answer now or later. Equal and hashable by its number.

    `A` is the type of its answer. The attribute `latest` is the query as the server last sent it: its content (`ask`),
    its `state`, the name of the `annotator`, and the `units` and `seconds` of the answer.
    """

    def __init__(self, client: Client, latest: wire.Query) -> None:
        self._client, self.latest = client, latest

    @property
    def id(self) -> int:
        """The number of the query at the server."""
        return self.latest.id

    @property
    def episode(self) -> int:
        """The number of the episode that the query is about."""
        return self.latest.ask.episode

    def answer(self, timeout: float | None = None) -> A:
        """Return the answer; wait until there is one. The annotator can then no longer retract it.

        Args:
            timeout: how long to wait at most, in seconds; None for no limit.

        Raises:
            TimeoutError: nobody has answered in this time. Call again to wait longer.
            QueryCancelled: the run was finished, so there will be no answer.
            Unreachable: the server was not available within the client's patience.
        """
        ends_at = math.inf if timeout is None else time.monotonic() + timeout
        while not self.use():
            if self.latest.state == "cancelled":
                raise QueryCancelled(f"the run was finished before query {self.id} was answered; start a new run")
            left = ends_at - time.monotonic()
            self.latest = self._client.query(self.id, wait=min(max(left, 0.0), POLL_SECONDS))
            if left <= 0 and self.latest.state in ("open", "leased"):
                raise TimeoutError(f"query {self.id} has no answer yet; is an annotator or a bot at work?")
        assert self.latest.answer is not None
        result: A = plain(self.latest.answer)
        return result

    def use(self) -> bool:
        """Return whether there is an answer, and make it final, so that its annotator can no longer retract it."""
        if self.latest.state == "answered" and not self.latest.used:
            try:
                self.latest = self._client.use(self.id)
            except Refused as refusal:
                if refusal.name != "not-answered":
                    raise
                self.latest = self._client.query(self.id)  # the annotator has just retracted the answer
        return self.latest.used

    def __eq__(self, other: object) -> bool:
        return isinstance(other, AskedQuery) and (self.id, self.latest.run) == (other.id, other.latest.run)

    def __hash__(self) -> int:
        return hash((self.id, self.latest.run))

    def __repr__(self) -> str:
        return f"<query {self.id}: {self.latest.ask.kind} about episode {self.episode}, {self.latest.state}>"
