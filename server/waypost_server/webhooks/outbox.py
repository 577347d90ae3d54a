"""Queues messages to webhooks in the transaction of the change that they announce, so that none is lost or invented."""

import json
import secrets
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from pydantic import TypeAdapter
from sqlalchemy import insert, select

from waypost import wire
from waypost_server.db.prepared import Prepared
from waypost_server.db.tables import deliveries, webhooks
from waypost_server.db.transaction import Tx

TOPIC = "webhooks"  # the topic that a new message wakes

_MESSAGE: TypeAdapter[wire.WebhookMessage] = TypeAdapter(wire.WebhookMessage)
_INSERT = insert(deliveries).returning(deliveries.c.id)
# The key lock keeps an administrator from deleting a webhook between this look and the insertion of its message.
ACTIVE = Prepared(
    select(webhooks.c.id, webhooks.c.topics).where(webhooks.c.active).with_for_update(read=True, key_share=True)
)


def wanting(tx: Tx, topic: wire.WebhookTopic) -> list[int]:
    """Return the active webhooks with this topic, locked."""
    return [row.id for row in ACTIVE.rows(tx.conn, {}) if topic in json.loads(row.topics)]


def announce(tx: Tx, webhooks: Sequence[int], topic: wire.WebhookTopic, run: str, data: Mapping[str, Any]) -> None:
    """Queue a message for each of these webhooks.

    Args:
        tx: the transaction of the change.
        webhooks: their ids.
        topic: the kind of change.
        run: the id of the run that changed.
        data: the fields of the message's data, except `run`.
    """
    body = _body(topic, tx.now, {"run": run, **data})
    for webhook in webhooks:
        _queue(tx, webhook, topic, body, run)


def ping(tx: Tx, webhook: int) -> int:
    """Queue a test message for one webhook; return the id of its delivery."""
    return _queue(tx, webhook, "ping", _body("ping", tx.now, {"webhook": webhook}))


def _body(kind: str, now: float, data: Mapping[str, Any]) -> str:
    at = datetime.fromtimestamp(now, UTC).isoformat(timespec="milliseconds")
    return _MESSAGE.validate_python({"type": kind, "timestamp": at, "data": dict(data)}).model_dump_json()


def _queue(tx: Tx, webhook: int, kind: str, body: str, run: str | None = None) -> int:
    row = {
        "webhook_id": webhook,
        "message": f"msg_{secrets.token_hex(16)}",
        "type": kind,
        "run_id": run,
        "body": body,
        "state": "pending",
        "attempts": 0,
        "created_at": tx.now,
        "queued_at": tx.now,
        "next_at": tx.now,
    }
    tx.wake(TOPIC)
    return int(tx.conn.execute(_INSERT, row).scalar_one())
