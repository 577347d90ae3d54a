"""A busy store: it lets so many requests wait and refuses the others at once, so that no reply comes too late."""

import asyncio
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from tests.server.kit import API, Service, query

from waypost_server import errors
from waypost_server.db.transaction import Tx
from waypost_server.db.writers.load import MOST_WAITING


@contextmanager
def crowded(service: Service, n: int) -> Iterator[list[object]]:
    """Let n transactions wait until the end of the block; yields what became of each, which is filled at its end."""
    go, all_sent = threading.Event(), threading.Event()
    outcomes: list[object] = []

    def wait(_tx: Tx) -> None:
        if not go.wait(10):
            go.set()  # the test has failed; let the others go

    async def send() -> None:
        sent = [asyncio.create_task(service.db.write(wait)) for _ in range(n)]
        asyncio.get_running_loop().call_soon(all_sent.set)  # after the first step of each, which submits it
        outcomes.extend(await asyncio.gather(*sent, return_exceptions=True))

    crowd = threading.Thread(target=lambda: asyncio.run(send()))
    crowd.start()
    all_sent.wait(30)
    try:
        yield outcomes
    finally:
        go.set()
        crowd.join(30)


def test_a_request_that_finds_too_many_waiting_is_refused_and_told_when_to_come_back(service: Service) -> None:
    run = service.learner.create_run()
    path, body = f"{API}/runs/{run}/queries", {"queries": [query()]}
    with crowded(service, MOST_WAITING + 50) as outcomes:
        reply = service.client.post(path, json=body, headers=service.learner.headers)
        assert reply.status_code == 503
        assert reply.json()["type"] == "/problems/store-busy"
        assert reply.headers["retry-after"] == "1"
        assert "send the same request again" in reply.json()["detail"]
        assert service.viewer.get(f"/runs/{run}/queries")["queries"] == [], "nothing was stored; reading still works"
    refused = [outcome for outcome in outcomes if outcome is not None]
    assert all(isinstance(outcome, errors.StoreBusy) for outcome in refused)
    assert 50 <= len(refused) <= 60, "the server itself may take a few places"
    service.learner.ask(run, query())


def test_as_many_as_may_wait_are_all_served_again_and_again(service: Service) -> None:
    for _ in range(2):
        with crowded(service, MOST_WAITING - 50) as outcomes:
            pass
        assert outcomes == [None] * (MOST_WAITING - 50)
