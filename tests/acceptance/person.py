"""A person at the page, as a script: reads the question's number off the page and answers with the keyboard alone."""

from collections.abc import Callable

from playwright.sync_api import Page
from tests.browser.hands.keyboard import give

from waypost import wire
from waypost.client import Client
from waypost.domains import Domain
from waypost_learner.experts.oracle import OracleExpert

POLL_MILLISECONDS = 10


class Person:
    """Knows what the oracle knows, and has a keyboard."""

    def __init__(self, page: Page, client: Client, domain: Domain) -> None:
        self._page, self._client = page, client
        self._expert = OracleExpert(domain)
        self.answered: list[wire.Kind] = []

    def work_until(self, over: Callable[[], bool]) -> None:
        """Answer whatever the page shows until there is nothing more to come."""
        last = None
        while not over():
            query = self._page.evaluate("document.querySelector('#question')?.dataset.query ?? null")
            if query is None or query == last:
                self._page.wait_for_timeout(POLL_MILLISECONDS)
                continue
            self._answer(int(query))
            last = query

    def _answer(self, query: int) -> None:
        asked = self._client.query(query)
        give(self._page, self._expert(asked.ask))
        self.answered.append(asked.ask.kind)
