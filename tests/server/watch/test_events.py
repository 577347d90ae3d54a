"""Events: every change of a run, in order, from any cursor on, until the server stops."""

import json
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import httpx2
import pytest
from sqlalchemy import create_engine
from tests.server.kit import API, Caller, Service, query

from waypost_server import serving
from waypost_server.db.transaction import Tx
from waypost_server.runs import events as run_events
from waypost_server.settings import Settings

Start = Callable[[Settings], serving.Served]


@pytest.fixture
def real(database_url: str, start_server: Start) -> Iterator[Service]:
    """A service behind a real socket."""
    served = start_server(Settings(database=database_url))
    with httpx2.Client(base_url=served.url, timeout=30) as client:
        yield Service(client, served.db)


def events(caller: Caller, run: str, n: int, after: int | None = 0, **headers: str) -> list[dict[str, Any]]:
    """Read n events off the stream."""
    params = {} if after is None else {"after": after}
    found: list[dict[str, Any]] = []
    url = f"{API}/runs/{run}/events"
    with caller.client.stream("GET", url, params=params, headers=caller.headers | headers) as reply:
        assert reply.headers["content-type"].startswith("text/event-stream")
        for line in reply.iter_lines():
            if line.startswith("data: "):
                found.append(json.loads(line.removeprefix("data: ")))
                if len(found) == n:
                    return found
    return found


def test_what_happens_in_a_run_is_streamed_in_order(real: Service) -> None:
    run = real.learner.create_run()
    (asked,) = real.learner.ask(run, query())
    held = real.annotator.lease()
    real.annotator.answer(held)
    again = real.annotator.retract(held)
    real.annotator.answer(again, {"kind": "inspect_full", "verdict": "fail"})
    real.learner.post(f"/queries/{asked['id']}/use")
    real.learner.ask(run, query(ordinal=1))
    real.learner.patch(run, state="finished")
    found = events(real.viewer, run, 8)
    names = ["run", "asked", "answered", "retracted", "answered", "used", "asked", "cancelled"]
    assert [event["event"] for event in found] == names
    assert [event["id"] for event in found] == sorted(event["id"] for event in found)
    assert found[2]["data"] == {"query": asked["id"], "answer": 1, "kind": "inspect_full", "episode": 0, "units": 1.0}
    last_seen = str(found[5]["id"])
    assert [e["event"] for e in events(real.viewer, run, 2, **{"Last-Event-ID": last_seen})] == names[6:]


def test_annotators_learn_that_a_run_changed_but_not_which_query(real: Service) -> None:
    run = real.learner.create_run()
    (asked,) = real.learner.ask(run, query())
    found = events(real.annotator, run, 2)
    assert [(event["event"], event["data"]) for event in found] == [("run", {}), ("asked", {})]
    assert events(real.viewer, run, 2)[1]["data"]["query"] == asked["id"]


def test_a_stream_brings_news_at_once(database_url: str, start_server: Start) -> None:
    served = start_server(Settings(database=database_url, poll_seconds=60))
    with httpx2.Client(base_url=served.url, timeout=30) as client:
        service = Service(client, served.db)
        run = service.learner.create_run()
        arrived: list[float] = []

        def read() -> None:
            events(service.viewer, run, 1, after=None)
            arrived.append(time.monotonic())

        reader = threading.Thread(target=read)
        reader.start()
        time.sleep(0.7)
        asked = time.monotonic()
        service.learner.ask(run, query())
        reader.join()
    assert arrived[0] - asked < 15, "told by the change, not by the poll"


def test_open_streams_and_waits_do_not_hold_the_server_up(sqlite_url: str) -> None:
    done: list[int] = []
    is_open = threading.Event()
    with httpx2.Client(timeout=30) as client:
        with serving.background(Settings(database=sqlite_url)) as served:
            client.base_url = served.url
            service = Service(client, served.db)
            run = service.learner.create_run()

            def follow() -> None:
                n = 0
                url, since = f"{API}/runs/{run}/events", {"after": 0}
                with client.stream("GET", url, params=since, headers=service.viewer.headers) as reply:
                    for line in reply.iter_lines():
                        n += line.startswith("data: ")
                        is_open.set()
                done.append(n)

            def wait() -> None:
                done.append(-1 if service.annotator.lease(wait=30, expect=204) is None else 0)

            threads = [threading.Thread(target=follow), threading.Thread(target=wait)]
            for thread in threads:
                thread.start()
            assert is_open.wait(10)
            time.sleep(1)
            stopping = time.monotonic()
        assert time.monotonic() - stopping < 15
        for thread in threads:
            thread.join()
    assert sorted(done) == [-1, 1]


def test_an_annotator_who_hangs_up_is_given_nothing(real: Service) -> None:
    run = real.learner.create_run()
    with pytest.raises(httpx2.ReadTimeout):
        real.client.post(f"{API}/assignments", json={"wait": 30}, headers=real.annotator.headers, timeout=0.3)
    time.sleep(0.3)
    (asked,) = real.learner.ask(run, query())
    time.sleep(0.7)
    assert real.learner.get(f"/queries/{asked['id']}")["state"] == "open"


def test_events_of_no_run_are_not_found(real: Service) -> None:
    real.viewer.get("/runs/nowhere/events", 404)


def test_whoever_looks_at_all_runs_hears_that_one_changed(real: Service) -> None:
    run = real.learner.create_run()
    heard: list[int] = []

    def listen() -> None:
        with real.client.stream("GET", f"{API}/events", headers=real.viewer.headers) as reply:
            for line in reply.iter_lines():
                if line.startswith("data: "):
                    heard.append(json.loads(line.removeprefix("data: "))["newest"])
                    return

    listener = threading.Thread(target=listen)
    listener.start()
    time.sleep(0.5)
    assert heard == [], "nothing has changed yet"
    real.learner.ask(run, query())
    listener.join(10)
    assert heard == [events(real.viewer, run, 2)[-1]["id"]]


def test_a_change_that_is_committed_after_a_newer_one_is_announced_too(cluster: Any, start_server: Start) -> None:
    served = start_server(Settings(database=cluster.create()))
    engine = create_engine(served.db.url)
    with httpx2.Client(base_url=served.url, timeout=10) as client, engine.connect() as slow:
        service = Service(client, served.db)
        first, second = service.learner.create_run(), service.learner.create_run()
        with client.stream("GET", f"{API}/events", headers=service.viewer.headers) as reply:
            lines = reply.iter_lines()
            assert next(lines) == "retry: 1000"
            time.sleep(0.5)  # the stream has read where it begins
            run_events.add(Tx(slow), first, "run", {"state": "paused"})
            older = run_events.newest(Tx(slow), first)
            service.learner.patch(second, state="paused")
            newer = next(line for line in lines if line.startswith("data: "))
            assert json.loads(newer.removeprefix("data: "))["newest"] > older
            slow.commit()
            assert next(line for line in lines if line.startswith("data: ")) == newer
    engine.dispose()


@pytest.mark.parametrize("change", [{"active": False}, {"role": "annotator"}])
@pytest.mark.parametrize("path", ["/runs/{run}/events", "/events"])
def test_a_stream_without_news_ends_within_5_seconds_of_a_revocation(
    sqlite_url: str, start_server: Start, change: dict[str, Any], path: str
) -> None:
    served = start_server(Settings(database=sqlite_url, poll_seconds=60))
    with httpx2.Client(base_url=served.url, timeout=30) as client:
        service = Service(client, served.db)
        run = service.learner.create_run()
        with client.stream("GET", API + path.format(run=run), headers=service.viewer.headers) as reply:
            lines = reply.iter_lines()
            assert next(lines) == "retry: 1000"
            start = time.monotonic()
            service.admin.change(service.viewer, **change)
            ended = list(lines) is not None and time.monotonic() - start
        assert 0 < ended < 5
