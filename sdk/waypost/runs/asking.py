"""Asks queries by their content: an equal query about the same episode is asked once.

The server identifies a query by its run, its episode and its number in the episode. `Asker` chooses the numbers. They
are consecutive, so that a number without a conflict means that the query is new.
"""

import hashlib
import json
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from waypost import wire
from waypost.client import Client, Refused
from waypost.runs.queries import Query

_QUERIES_AT_ONCE = 1_000
_BODY_BYTES = 2 * 2**20  # of queries in one request; a single larger query is sent alone
_ATTEMPTS = 10  # to find a free number for a query while other programs ask about the same episode


class Asker:
    """Asks the queries of one run.

    Args:
        client: the learner's client.
        run: the id of the run.
    """

    def __init__(self, client: Client, run: str) -> None:
        self._client, self._run = client, run
        self._numbers: dict[int, dict[str, int]] = {}  # by episode: the number of each query by its digest
        self._lock = threading.Lock()

    def ask(self, queries: Sequence[Query[Any]]) -> list[wire.Query]:
        """Ask queries, and return them in the same order. A query that was asked before has its present state.

        Raises:
            BudgetExhausted, Refused, Unreachable: as in `Client`. Some of the queries may have been asked.
        """
        contents = [_Content.of(query) for query in queries]
        with self._lock:
            for _ in range(_ATTEMPTS):
                try:
                    return self._ask(contents)
                except Refused as refusal:
                    if refusal.name != "different-content":
                        raise
                    refused = refusal
                # An earlier process of the script, or another program, has asked about one of these episodes.
                for episode in {query.episode for query in queries}:
                    self._numbers[episode] = self._stored(episode)
            raise refused

    def _ask(self, contents: Sequence["_Content"]) -> list[wire.Query]:
        asked = list[wire.Query]()
        for batch in _batches(contents):
            numbers = {one.query.episode: dict(self._numbers.get(one.query.episode, {})) for one in batch}
            messages = []
            for one in batch:
                known = numbers[one.query.episode]
                ordinal = known.setdefault(one.digest, max(known.values(), default=-1) + 1)
                messages.append(one.query.message(ordinal))
            asked += self._client.ask(self._run, messages)
            self._numbers |= numbers  # only now, because a refused query must not leave a gap
        return asked

    def _stored(self, episode: int) -> dict[str, int]:
        return {_digest(_text(query.ask)): query.ask.ordinal for query in self._client.queries(self._run, episode)}


@dataclass(frozen=True)
class _Content:
    """A query with the digest of its content, which equal queries share, and its size in a request."""

    query: Query[Any]
    digest: str
    size: int

    @classmethod
    def of(cls, query: Query[Any]) -> "_Content":
        """Return the content of a query."""
        text = _text(query.message(ordinal=0))
        return cls(query, _digest(text), len(text))


def _text(ask: wire.Ask) -> str:
    """Return the content of a query as text, without its number and its pictures."""
    content = ask.model_dump(mode="json", exclude={"ordinal"})
    for segment in [*content.get("segments", []), *content["context"]]:
        for field in wire.Pictured.model_fields:
            del segment[field]
    return json.dumps(content, sort_keys=True)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


def _batches(contents: Sequence[_Content]) -> Iterator[list[_Content]]:
    """Yield batches of queries; each batch fits into one request."""
    batch, size = list[_Content](), 0
    for one in contents:
        if batch and (size + one.size > _BODY_BYTES or len(batch) == _QUERIES_AT_ONCE):
            yield batch
            batch, size = [], 0
        batch.append(one)
        size += one.size
    if batch:
        yield batch
