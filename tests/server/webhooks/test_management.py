"""Administrators manage webhooks over REST; the secret is shown once, and nobody else sees anything."""

import json

import pytest
from tests.server.kit import in_process
from tests.server.webhooks.kit import ALLOWED, delivered, deliveries, receiving, subscribe

URL = "https://hooks.example.org/waypost"
HOSTS = {"webhook_hosts": ("hooks.example.org",)}


def test_a_webhook_is_created_changed_and_deleted(database_url: str) -> None:
    with in_process(database_url, **HOSTS) as service:
        made = service.admin.post("/webhooks", {"url": URL, "note": "the chat room"}, 201)["webhook"]
        assert (made["url"], made["note"], made["active"], made["pending"]) == (URL, "the chat room", True, 0)
        assert made["topics"] == ["answer.accepted", "answer.retracted", "run.state"]
        change = {"topics": ["run.state"], "active": False, "url": f"{URL}/2", "note": ""}
        changed = service.admin.call("PATCH", f"/webhooks/{made['id']}", change)
        assert changed == made | change
        assert service.admin.get("/webhooks") == {"webhooks": [changed]}
        service.admin.call("DELETE", f"/webhooks/{made['id']}", expect=204)
        assert service.admin.get("/webhooks") == {"webhooks": []}
        service.admin.get(f"/webhooks/{made['id']}", 404)


def test_a_webhook_with_messages_can_be_deleted(database_url: str) -> None:
    with receiving() as receiver, in_process(database_url, **ALLOWED) as service:
        receiver.reply = lambda _: 500
        webhook, _ = subscribe(service, receiver)
        service.learner.create_run()
        assert len(deliveries(service, webhook)) == 1
        service.admin.call("DELETE", f"/webhooks/{webhook}", expect=204)
        service.admin.get(f"/webhooks/{webhook}/deliveries", 404)
        service.learner.create_run()


def test_the_secret_is_shown_once(sqlite_url: str) -> None:
    with in_process(sqlite_url, **HOSTS) as service:
        made = service.admin.post("/webhooks", {"url": URL}, 201)
        assert made["secret"].startswith("whsec_")
        webhook = made["webhook"]["id"]
        service.admin.post(f"/webhooks/{webhook}/ping", expect=202)
        later = [
            service.admin.get("/webhooks"),
            service.admin.get(f"/webhooks/{webhook}"),
            service.admin.call("PATCH", f"/webhooks/{webhook}", {"note": "x"}),
            service.admin.get(f"/webhooks/{webhook}/deliveries"),
        ]
        assert made["secret"] not in json.dumps(later)
        other = service.admin.post("/webhooks", {"url": URL}, 201)
        assert other["secret"] != made["secret"]


@pytest.mark.parametrize("role", ["learner", "annotator", "viewer"])
def test_only_administrators_see_or_change_webhooks(sqlite_url: str, role: str) -> None:
    with in_process(sqlite_url, **HOSTS) as service:
        webhook = service.admin.post("/webhooks", {"url": URL}, 201)["webhook"]["id"]
        caller = getattr(service, role)
        caller.get("/webhooks", 403)
        caller.post("/webhooks", {"url": URL}, 403)
        caller.get(f"/webhooks/{webhook}", 403)
        caller.call("PATCH", f"/webhooks/{webhook}", {"active": False}, 403)
        caller.call("DELETE", f"/webhooks/{webhook}", expect=403)
        caller.get(f"/webhooks/{webhook}/deliveries", 403)
        caller.post(f"/webhooks/{webhook}/ping", expect=403)
        caller.post(f"/webhooks/{webhook}/deliveries/1/redeliver", expect=403)
        assert service.admin.get(f"/webhooks/{webhook}")["active"] is True


def test_a_ping_tests_a_webhook_with_a_message_of_its_own(sqlite_url: str) -> None:
    with receiving() as receiver, in_process(sqlite_url, **ALLOWED) as service:
        webhook, secret = subscribe(service, receiver, topics=["answer.accepted"])
        queued = service.admin.post(f"/webhooks/{webhook}/ping", expect=202)
        assert (queued["type"], queued["run"], queued["state"]) == ("ping", None, "pending")
        delivered(service, webhook, 1)
        (message,) = receiver.verified(secret)
    assert (message["type"], message["data"]) == ("ping", {"webhook": webhook})


def test_messages_are_listed_by_page_newest_first(sqlite_url: str) -> None:
    with in_process(sqlite_url, **HOSTS) as service:
        webhook = service.admin.post("/webhooks", {"url": URL}, 201)["webhook"]["id"]
        for _ in range(5):
            service.learner.create_run()
        ids = [one["id"] for one in deliveries(service, webhook)]
        assert len(ids) == 5
        page = service.admin.get(f"/webhooks/{webhook}/deliveries", params={"limit": 2, "before": ids[3]})
        assert [one["id"] for one in page["deliveries"]] == [ids[2], ids[1]]


def test_what_is_not_there_is_not_found(sqlite_url: str) -> None:
    with in_process(sqlite_url, **HOSTS) as service:
        mine, other = (service.admin.post("/webhooks", {"url": URL}, 201)["webhook"]["id"] for _ in range(2))
        ping = service.admin.post(f"/webhooks/{other}/ping", expect=202)["id"]
        service.admin.post(f"/webhooks/{mine}/deliveries/{ping}/redeliver", expect=404)
        service.admin.post("/webhooks/999/ping", expect=404)
        service.admin.call("DELETE", "/webhooks/999", expect=404)


def test_metrics_count_webhooks_and_their_messages(sqlite_url: str) -> None:
    with receiving() as receiver, in_process(sqlite_url, **ALLOWED) as service:
        webhook, _ = subscribe(service, receiver)
        service.learner.create_run()
        delivered(service, webhook, 1)
        text = service.client.get("/metrics", headers=service.viewer.headers).text
    assert 'waypost_webhooks{state="on"} 1' in text
    assert 'waypost_webhook_attempts_total{outcome="delivered"} 1' in text
