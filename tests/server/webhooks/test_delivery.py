"""Webhooks: what was committed is announced, signed, at least once; a bad receiver harms nobody else."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import httpx2
import pytest
from pydantic import TypeAdapter
from sqlalchemy import select
from standardwebhooks import Webhook
from tests.conftest import Cluster
from tests.server.kit import Json, Service, in_process, query
from tests.server.webhooks.kit import ALLOWED, Receiver, delivered, deliveries, eventually, receiving, subscribe

from waypost import wire
from waypost_server import serving
from waypost_server.db import tables
from waypost_server.db.transaction import Tx
from waypost_server.runs import service as runs
from waypost_server.settings import Settings
from waypost_server.webhooks import queue

MESSAGE: TypeAdapter[wire.WebhookMessage] = TypeAdapter(wire.WebhookMessage)


@pytest.fixture
def receiver() -> Iterator[Receiver]:
    with receiving() as receiver:
        yield receiver


@pytest.fixture
def service(database_url: str) -> Iterator[Service]:
    """A server that may call this machine."""
    with in_process(database_url, **ALLOWED) as service:
        yield service


@pytest.fixture
def lite(sqlite_url: str) -> Iterator[Service]:
    with in_process(sqlite_url, **ALLOWED) as service:
        yield service


def answered(service: Service, run: str, n: int = 1, episode: int = 0) -> list[Json]:
    """Ask and answer n queries; return their assignments."""
    service.learner.ask(run, *(query(episode=episode, ordinal=number) for number in range(n)))
    given = []
    for _ in range(n):
        given.append(service.annotator.lease(run=run))
        service.annotator.answer(given[-1])
    return given


# --- what is announced


def test_answers_and_states_of_runs_arrive_in_order_and_signed(service: Service, receiver: Receiver) -> None:
    webhook, secret = subscribe(service, receiver)
    run = service.learner.create_run(name="mazes")
    (held,) = answered(service, run)
    again = service.annotator.retract(held)
    service.annotator.answer(again, {"kind": "inspect_full", "verdict": "fail"})
    for state in ("paused", "running", "finished"):
        service.learner.patch(run, state=state)
    delivered(service, webhook, 7)
    messages = receiver.verified(secret)
    assert [one["type"] for one in messages] == [
        "run.state", "answer.accepted", "answer.retracted", "answer.accepted", "run.state", "run.state", "run.state",
    ]  # fmt: skip
    assert [MESSAGE.validate_python(one).type for one in messages] == [one["type"] for one in messages]
    assert [one["data"]["state"] for one in messages if one["type"] == "run.state"] == [
        "running", "paused", "running", "finished",
    ]  # fmt: skip
    first, taken, _ = (one["data"] for one in messages if one["type"].startswith("answer"))
    same = {"run": run, "query": held["query"]["id"], "kind": "inspect_full", "episode": 0, "units": 1.0}
    assert first == same | {"event": first["event"], "answer": first["answer"]}
    assert taken == first | {"event": taken["event"]}
    events = [one["data"]["event"] for one in messages]
    assert events == sorted(set(events))
    assert len(set(receiver.ids)) == 7
    assert receiver.ids == [one["message"] for one in deliveries(service, webhook)]


def test_a_signature_belongs_to_one_secret_and_one_body(lite: Service, receiver: Receiver) -> None:
    webhook, secret = subscribe(lite, receiver)
    _, other = subscribe(lite, receiver, topics=["answer.accepted"])
    lite.learner.create_run()
    delivered(lite, webhook, 1)
    ((headers, body),) = receiver.requests
    assert Webhook(secret).verify(body, headers)["type"] == "run.state"
    for wrong, changed in ((other, body), (secret, body.replace(b"running", b"paused!"))):
        with pytest.raises(Exception, match="No matching signature"):
            Webhook(wrong).verify(changed, headers)


def test_only_the_chosen_topics_are_announced(lite: Service, receiver: Receiver) -> None:
    webhook, _ = subscribe(lite, receiver, topics=["answer.retracted"])
    (held,) = answered(lite, lite.learner.create_run())
    lite.annotator.retract(held)
    delivered(lite, webhook, 1)
    assert [one["type"] for one in deliveries(lite, webhook)] == ["answer.retracted"]


def test_a_change_of_a_run_that_is_not_its_state_is_not_announced(lite: Service, receiver: Receiver) -> None:
    run = lite.learner.create_run()
    webhook, _ = subscribe(lite, receiver)
    lite.learner.patch(run, name="another name", budget=5.0)
    lite.learner.patch(run, state="paused")
    delivered(lite, webhook, 1)
    assert [(one["data"]["name"], one["data"]["state"]) for one in receiver.messages] == [("another name", "paused")]


def test_gold_queries_and_late_answers_are_not_announced(lite: Service, receiver: Receiver) -> None:
    webhook, _ = subscribe(lite, receiver, topics=["answer.accepted", "answer.retracted"])
    run = lite.learner.create_run()
    ask = query(episode=9_000)
    lite.learner.post(f"/runs/{run}/gold", {"known": [{"ask": ask, "known": {"kind": ask["kind"], "verdict": "pass"}}]})
    lite.learner.patch(run, gold_rate=0.5)
    given = answered(lite, run, 6)
    own = {one["id"] for one in lite.admin.get(f"/runs/{run}/queries", params={"limit": 500})["queries"]}
    real = [one["query"]["id"] for one in given if one["query"]["id"] in own]
    assert len(real) < len(given), "one of them was gold"
    delivered(lite, webhook, len(real))
    assert [one["data"]["query"] for one in receiver.messages] == real


def test_what_is_rolled_back_is_not_announced(service: Service, receiver: Receiver) -> None:
    webhook, _ = subscribe(service, receiver)

    def begun_and_undone(tx: Tx) -> None:
        vocabulary = wire.Vocabulary(domain="maze", subgoals=[], actions=["up"], renderer="maze")
        runs.create(tx, wire.RunCreate(name="never", algorithm="h-bc", seed=0, vocabulary=vocabulary), 1)
        assert tx.conn.execute(select(tables.deliveries)).all() != []
        raise RuntimeError("the transaction fails after the message was queued")

    with pytest.raises(RuntimeError):
        service.db.write_now(begun_and_undone)
    assert deliveries(service, webhook) == []
    service.learner.create_run(name="kept")
    delivered(service, webhook, 1)
    assert [one["data"]["name"] for one in receiver.messages] == ["kept"]


# --- failures of receivers


def test_a_failed_message_is_sent_again_with_the_same_id_and_content(service: Service, receiver: Receiver) -> None:
    replies = iter([500, 503, 204])
    receiver.reply = lambda _: next(replies)
    webhook, secret = subscribe(service, receiver)
    service.learner.create_run()
    (done,) = delivered(service, webhook, 1)
    assert (done["attempts"], done["status"], done["reason"]) == (3, 204, None)
    assert set(receiver.ids) == {done["message"]}
    assert len({body for _, body in receiver.requests}) == 1
    assert len(receiver.verified(secret)) == 3
    assert service.admin.get(f"/webhooks/{webhook}")["failing_since"] is None


def test_one_message_that_is_always_rejected_does_not_hold_up_the_others(lite: Service, receiver: Receiver) -> None:
    receiver.reply = lambda message: 500 if message["data"].get("name") == "bad" else 204
    webhook, _ = subscribe(lite, receiver)
    names = ["good 1", "bad", "good 2", "good 3"]
    for name in names:
        lite.learner.create_run(name=name)
    delivered(lite, webhook, 3)
    (bad,) = deliveries(lite, webhook, state="pending")
    assert bad["reason"] == "The receiver answered 500."
    assert bad["next_at"] is not None


def test_a_message_that_is_too_old_is_given_up_and_can_be_sent_again(database_url: str, receiver: Receiver) -> None:
    receiver.reply = lambda _: 500
    with in_process(database_url, **ALLOWED, webhook_give_up_seconds=0.001) as service:
        webhook, _ = subscribe(service, receiver)
        service.learner.create_run()
        (lost,) = eventually(lambda: deliveries(service, webhook, state="given_up"))
        assert (lost["status"], lost["reason"]) == (500, "The receiver answered 500.")
        assert lost["ended_at"] is not None
        receiver.reply = lambda _: 200
        again = service.admin.post(f"/webhooks/{webhook}/deliveries/{lost['id']}/redeliver", expect=202)
        assert again["state"] == "pending"
        (done,) = delivered(service, webhook, 1)
    assert (done["id"], done["message"]) == (lost["id"], lost["message"])
    assert set(receiver.ids) == {lost["message"]}


def test_a_webhook_that_fails_for_long_is_turned_off_and_says_why(lite: Service, receiver: Receiver) -> None:
    receiver.reply = lambda _: 500
    webhook, _ = subscribe(lite, receiver)
    lite.learner.create_run()
    eventually(lambda: lite.admin.get(f"/webhooks/{webhook}")["failing_since"])
    long_ago = tables.webhooks.update().values(failing_since=tables.webhooks.c.failing_since - 6 * 86_400)
    lite.db.write_now(lambda tx: tx.conn.execute(long_ago))
    found = eventually(lambda: (one := lite.admin.get(f"/webhooks/{webhook}"))["off_reason"] and one)
    assert found["active"] is False
    assert found["off_reason"] == "It failed for 5 days; the last time: The receiver answered 500."
    lite.learner.create_run()
    assert found["pending"] == lite.admin.get(f"/webhooks/{webhook}")["pending"] == 1, "nothing is queued while off"
    lite.admin.post(f"/webhooks/{webhook}/ping", expect=409)
    receiver.reply = lambda _: 200
    on = lite.admin.call("PATCH", f"/webhooks/{webhook}", {"active": True})
    assert (on["active"], on["off_reason"], on["failing_since"]) == (True, None, None)
    delivered(lite, webhook, 1)


def test_a_receiver_that_is_gone_is_left_alone_at_once(lite: Service, receiver: Receiver) -> None:
    receiver.reply = lambda _: 410
    webhook, _ = subscribe(lite, receiver)
    lite.learner.create_run()
    found = eventually(lambda: (one := lite.admin.get(f"/webhooks/{webhook}"))["off_reason"] and one)
    assert found["off_reason"].startswith("The receiver answered 410 Gone")
    assert len(receiver.requests) == 1


def test_a_receiver_that_hangs_keeps_neither_answers_nor_other_receivers_waiting(
    service: Service, receiver: Receiver
) -> None:
    receiver.held.clear()
    hanging, _ = subscribe(service, receiver)
    with receiving() as other:
        working, _ = subscribe(service, other)
        run = service.learner.create_run()
        eventually(lambda: receiver.requests)
        answered(service, run, 10)
        delivered(service, working, 11)
        assert [one["state"] for one in deliveries(service, hanging)] == ["pending"] * 11
        assert len(receiver.requests) == 1
        receiver.held.set()
        delivered(service, hanging, 11)


def test_a_receiver_that_takes_too_long_is_tried_again(sqlite_url: str, receiver: Receiver) -> None:
    receiver.held.clear()
    with in_process(sqlite_url, **ALLOWED, webhook_seconds=0.2) as service:
        webhook, _ = subscribe(service, receiver)
        service.learner.create_run()
        (late,) = eventually(lambda: [one for one in deliveries(service, webhook) if one["attempts"]])
        assert (late["status"], late["reason"]) == (None, "The receiver took too long.")
        receiver.held.set()
        (done,) = delivered(service, webhook, 1)
    assert done["id"] == late["id"]


def test_a_response_that_never_ends_is_cut_off(lite: Service, receiver: Receiver) -> None:
    receiver.reply, receiver.flood = lambda _: 200, True
    webhook, _ = subscribe(lite, receiver)
    lite.learner.create_run()
    (done,) = delivered(lite, webhook, 1)
    assert (done["attempts"], done["status"]) == (1, 200)


# --- failures of servers


@pytest.mark.parametrize("in_flight", [False, True])
def test_a_message_survives_kill_9_of_the_server_between_commit_and_delivery(
    database_url: str, receiver: Receiver, in_flight: bool
) -> None:
    """Either no process delivers when the server is killed, or the message is on its way and the receiver hangs."""
    receiver.held.clear()
    with in_process(database_url) as service:
        tokens = {one.name: one.headers for one in (service.admin, service.learner)}
        service.db.write_now(lambda tx: tx.conn.execute(tables.webhooks.insert().values(hook(receiver))))
    settings = {"WAYPOST_WEBHOOK_SECONDS": "1"}
    if in_flight:
        settings |= {"WAYPOST_WEBHOOK_HOSTS": "127.0.0.1:*", "WAYPOST_WEBHOOK_NETWORKS": "127.0.0.0/8"}
    command = [sys.executable, "-u", "-m", "waypost_server.cli", "serve", "--port", "0", "--database", database_url]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**clean_environment(), **settings}) as one:
        assert one.stdout is not None
        address = one.stdout.readline().split()[-1]
        body = {
            "name": "a run",
            "algorithm": "h-bc",
            "seed": 0,
            "vocabulary": {"domain": "maze", "subgoals": [], "actions": ["up"], "renderer": "maze"},
        }
        made = httpx2.post(f"{address}/api/v1/runs", json=body, headers=tokens["lea"], timeout=30)
        assert made.status_code == 201
        if in_flight:
            eventually(lambda: receiver.requests)
        one.send_signal(signal.SIGKILL)
    receiver.held.set()
    before = list(receiver.ids)
    assert len(before) == in_flight
    with in_process(database_url, **ALLOWED, webhook_seconds=1) as service:
        (done,) = delivered(service, 1, 1)
    assert receiver.ids[-1] == done["message"]
    assert set(before) <= {done["message"]}
    assert json.loads(receiver.requests[-1][1])["data"]["run"] == made.json()["id"]


def hook(receiver: Receiver) -> dict[str, Any]:
    return {
        "user_id": 1,
        "url": receiver.url,
        "topics": '["run.state"]',
        "note": "",
        "secret": "whsec_c2VjcmV0IHNlY3JldCBzZWNyZXQgc2VjcmV0",
        "active": True,
        "failures": 0,
        "resumes_at": 0.0,
        "created_at": 0.0,
    }


def clean_environment() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if not name.startswith("WAYPOST_")}


def test_server_processes_that_share_a_database_deliver_each_message_once_and_in_order(
    cluster: Cluster, start_server: Callable[[Settings], serving.Served], receiver: Receiver
) -> None:
    settings = Settings(database=cluster.create(), **ALLOWED)  # type: ignore[arg-type]
    servers = [start_server(settings) for _ in range(3)]
    with httpx2.Client(base_url=servers[0].url, timeout=30) as client:
        service = Service(client, servers[0].db)
        webhook, secret = subscribe(service, receiver, topics=["answer.accepted"])
        answered(service, service.learner.create_run(), 40)
        delivered(service, webhook, 40)
    assert len(receiver.ids) == len(set(receiver.ids)) == 40
    order = [one["data"]["event"] for one in receiver.verified(secret)]
    assert order == sorted(order)


def test_the_outcome_of_a_process_whose_claim_expired_does_not_count(database_url: str) -> None:
    """A process that was stopped for long comes back after another process has taken over."""
    settings = Settings(database=database_url)
    with in_process(database_url, webhook_hosts=()) as service:
        service.db.write_now(lambda tx: tx.conn.execute(tables.webhooks.insert().values(hook(Receiver(port=9)))))
        service.learner.create_run()
        slow = service.db.write_now(lambda tx: queue.claim(tx, -queue.MARGIN_SECONDS))
        assert slow is not None
        other = service.db.write_now(lambda tx: queue.claim(tx, 60))
        assert other is not None
        assert (other.message, other.claim != slow.claim) == (slow.message, True)
        assert service.db.write_now(lambda tx: queue.claim(tx, 60)) is None, "it is claimed"
        late = queue.Outcome(None, "The receiver took too long.")
        service.db.write_now(lambda tx: queue.settle(tx, slow, late, settings))
        assert deliveries(service, 1)[0]["attempts"] == 0
        service.db.write_now(lambda tx: queue.settle(tx, other, queue.Outcome(204), settings))
        assert (deliveries(service, 1)[0]["attempts"], deliveries(service, 1)[0]["state"]) == (1, "delivered")


def test_without_allowed_hosts_a_server_delivers_nothing(sqlite_url: str, receiver: Receiver) -> None:
    with in_process(sqlite_url, **ALLOWED) as service:
        webhook, _ = subscribe(service, receiver)
    with in_process(sqlite_url) as service:
        service.learner.create_run()
        time.sleep(0.7)
        (waiting,) = deliveries(service, webhook)
    assert (waiting["state"], waiting["attempts"]) == ("pending", 0)
    assert receiver.requests == []
