"""The queries of one run at a server: ask them, wait for answers, use answers, and report episodes."""

from collections.abc import Mapping

from waypost import wire
from waypost.client import Client, Refused

POLL_SECONDS = 30.0


class RunQueue:
    """The queries of one run.

    Args:
        client: the learner's client.
        run: the id of an existing run.
        pictures: whether queries contain pictures of their states, if the domain has pictures. People need them.
    """

    def __init__(self, client: Client, run: str, pictures: bool = False) -> None:
        self._client, self.run, self.pictures = client, run, pictures
        self._cursor = 0

    def ask(self, ask: wire.Ask, frames: Mapping[str, bytes]) -> int:
        """Ask a query and return its id.

        Args:
            ask: the query.
            frames: PNG files by hash: pictures in the query that the server may not have yet.

        Raises:
            BudgetExhausted: the run's budget cannot pay for it.
            Refused: the server refused for another reason.
        """
        if frames:
            self._client.upload(frames)
        (asked,) = self._client.ask(self.run, [ask])
        return asked.id

    def use(self, query: int) -> wire.Query | None:
        """Return a query with its answer, which can no longer be retracted; None if there is no answer yet."""
        try:
            return self._client.use(query)
        except Refused as refusal:
            if refusal.name == "not-answered":
                return None
            raise

    def answered(self, wait: bool) -> set[int]:
        """Return the queries answered since the last call. `wait`: for the first, up to `POLL_SECONDS`."""
        page = self._client.answers(self.run, self._cursor, wait=POLL_SECONDS if wait else 0)
        self._cursor = page.cursor
        return {query.id for query in page.queries}

    def report(self, result: wire.EpisodeResult) -> None:
        """Report an episode's result."""
        self._client.report(self.run, [result])
