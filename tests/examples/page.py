"""One query of each kind about an example's domain, answered in the page with the keyboard alone."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import Any

from playwright.sync_api import Page
from tests.browser.kit import wait_for_heading
from tests.examples.kit import queries_of_every_kind

from waypost import wire
from waypost.client import Client
from waypost.domains import Domain
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.camera import Camera
from waypost_learner.remote.stage import offer
from waypost_learner.remote.translation import Translator, vocabulary
from waypost_server.auth import tokens
from waypost_server.serving import Served
from waypost_server.users import service as users


@dataclass(frozen=True)
class Asked:
    """A query in a server's queue, and the oracle's answer."""

    run: str
    query: int
    ask: Any
    right: Any

    @property
    def stored(self) -> dict[str, Any]:
        """The oracle's answer as the server stores it."""
        return dict(self.right.model_dump(mode="json"))


@contextmanager
def asked(served: Served, domain: Domain, instance: Any) -> Iterator[list[Asked]]:
    """Ask a query of each kind, and offer the environment of the demonstration."""
    user = served.db.write_now(lambda tx: users.ensure_user(tx, "example-learner", "learner"))
    token = served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "test")).token
    camera = Camera(domain, instance)
    translator, expert = Translator(domain, instance, camera), OracleExpert(domain)
    asks = [translator.ask(query, 0, n) for n, query in enumerate(queries_of_every_kind(domain, instance))]
    with ExitStack() as stack:
        client = Client(served.url, token)
        stack.callback(client.close)
        client.upload(camera.developed())
        new = wire.RunCreate(name=domain.name, algorithm="hg-dagger", seed=0, vocabulary=vocabulary(domain))
        run = client.create_run(new).id
        found = [Asked(run, *one) for one in zip(ids(client, run, asks), asks, map(expert, asks), strict=True)]
        stack.callback(offer(lambda: client.play(found[0].query), translator, client.upload))
        yield found


def ids(client: Client, run: str, asks: list[wire.Ask]) -> list[int]:
    """Ask, and return the queries' numbers."""
    return [query.id for query in client.ask(run, asks)]


def wait_for(page: Page, one: Asked) -> None:
    """Wait until the page asks this query."""
    wait_for_heading(page, one.ask.question)
