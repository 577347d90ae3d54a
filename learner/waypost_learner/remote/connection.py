"""Connections of a run to a server, as a learner and as an expert that answers in this process."""

from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass

from waypost.client import Client


@dataclass(frozen=True)
class Connection:
    """Clients of one server."""

    learner: Client
    annotator: Client | None  # of the expert in this process; None if others answer


@contextmanager
def connected(server: str, token: str, answers_here: bool, patience: float) -> Iterator[Connection]:
    """Connect to a running server.

    Args:
        server: its base URL.
        token: an API token; with `answers_here` it must be an administrator's.
        answers_here: whether an expert in this process answers.
        patience: seconds for which to try again when the server does not answer.
    """
    with closing(Client(server, token, patience=patience)) as client:
        yield Connection(client, client if answers_here else None)
