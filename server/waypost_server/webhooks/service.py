"""Creates, lists, changes and deletes webhooks, and queues messages again."""

import base64
import json
import secrets
from typing import Any

from sqlalchemy import Row, delete, func, insert, select, update

from waypost import wire
from waypost_server import errors
from waypost_server.db.tables import IS_PENDING, deliveries, webhooks
from waypost_server.db.transaction import Tx
from waypost_server.webhooks import outbox
from waypost_server.webhooks.policy import NotAllowed, Policy

SECRET_BYTES = 32

_pending = (
    select(func.count())
    .where(deliveries.c.webhook_id == webhooks.c.id, IS_PENDING)
    .correlate(webhooks)
    .scalar_subquery()
    .label("pending")
)
_ALL = select(webhooks, _pending)


def _of_row(row: Row[Any]) -> wire.Webhook:
    return wire.Webhook(
        id=row.id,
        url=row.url,
        topics=json.loads(row.topics),
        note=row.note,
        active=row.active,
        off_reason=row.off_reason,
        failing_since=row.failing_since,
        pending=row.pending,
        created_at=row.created_at,
    )


def view(tx: Tx, webhook: int) -> wire.Webhook:
    """Return a webhook.

    Raises:
        NotFound: there is none with this id.
    """
    row = tx.conn.execute(_ALL.where(webhooks.c.id == webhook)).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no webhook {webhook}.")
    return _of_row(row)


def list_webhooks(tx: Tx) -> wire.WebhookList:
    """List all webhooks, oldest first."""
    return wire.WebhookList(webhooks=[_of_row(row) for row in tx.conn.execute(_ALL.order_by(webhooks.c.id))])


def create(tx: Tx, wanted: wire.WebhookCreate, user: int, policy: Policy) -> wire.NewWebhook:
    """Create a webhook with a new secret, which is returned only here.

    Raises:
        Unprocessable: the operator has not allowed the address.
    """
    _check(policy, wanted.url)
    secret = f"whsec_{base64.b64encode(secrets.token_bytes(SECRET_BYTES)).decode()}"
    row = {
        "user_id": user,
        "url": wanted.url,
        "topics": json.dumps(sorted(set(wanted.topics))),
        "note": wanted.note,
        "secret": secret,
        "active": True,
        "failures": 0,
        "resumes_at": tx.now,
        "created_at": tx.now,
    }
    created = tx.conn.execute(insert(webhooks).returning(webhooks.c.id), row).scalar_one()
    return wire.NewWebhook(webhook=view(tx, created), secret=secret)


def change(tx: Tx, webhook: int, patch: wire.WebhookPatch, policy: Policy) -> wire.Webhook:
    """Change a webhook. Absent fields of the patch change nothing.

    Raises:
        NotFound: there is none with this id.
        Unprocessable: the operator has not allowed the address.
    """
    _lock(tx, webhook)
    changes: dict[str, Any] = {}
    if patch.url is not None:
        _check(policy, patch.url)
        changes["url"] = patch.url
    if patch.topics is not None:
        changes["topics"] = json.dumps(sorted(set(patch.topics)))
    if patch.note is not None:
        changes["note"] = patch.note
    if patch.active is not None:
        changes |= {"active": patch.active, "off_reason": None}
    if patch.active:
        changes |= {"failures": 0, "failing_since": None, "resumes_at": tx.now}
        waiting = update(deliveries).where(deliveries.c.webhook_id == webhook, IS_PENDING)
        tx.conn.execute(waiting.values(next_at=tx.now, queued_at=tx.now))
        tx.wake(outbox.TOPIC)
    if changes:
        tx.conn.execute(update(webhooks).where(webhooks.c.id == webhook).values(**changes))
    return view(tx, webhook)


def remove(tx: Tx, webhook: int) -> None:
    """Delete a webhook and its messages.

    Raises:
        NotFound: there is none with this id.
    """
    _lock(tx, webhook)
    tx.conn.execute(delete(deliveries).where(deliveries.c.webhook_id == webhook))
    tx.conn.execute(delete(webhooks).where(webhooks.c.id == webhook))


def list_deliveries(
    tx: Tx, webhook: int, state: wire.DeliveryState | None, before: int | None, limit: int
) -> wire.DeliveryPage:
    """List one page of a webhook's messages, newest first.

    Raises:
        NotFound: there is no such webhook.
    """
    view(tx, webhook)
    chosen = select(deliveries).where(deliveries.c.webhook_id == webhook)
    if state is not None:
        chosen = chosen.where(deliveries.c.state == state)
    if before is not None:
        chosen = chosen.where(deliveries.c.id < before)
    rows = tx.conn.execute(chosen.order_by(deliveries.c.id.desc()).limit(limit))
    return wire.DeliveryPage(deliveries=[_delivery(row) for row in rows])


def ping(tx: Tx, webhook: int) -> wire.Delivery:
    """Queue a test message.

    Raises:
        NotFound: there is no such webhook.
        WebhookOff: the webhook is off.
    """
    _resume(tx, webhook)
    return _find(tx, webhook, outbox.ping(tx, webhook))


def redeliver(tx: Tx, webhook: int, delivery: int) -> wire.Delivery:
    """Queue a message again, with the same id and content.

    Raises:
        NotFound: there is no such webhook or message.
        WebhookOff: the webhook is off.
    """
    _resume(tx, webhook)
    _find(tx, webhook, delivery)
    again = update(deliveries).where(deliveries.c.id == delivery)
    tx.conn.execute(again.values(state="pending", ended_at=None, queued_at=tx.now, next_at=tx.now))
    tx.wake(outbox.TOPIC)
    return _find(tx, webhook, delivery)


def _resume(tx: Tx, webhook: int) -> None:
    """Let a webhook try at once, whatever failed before."""
    if not _lock(tx, webhook).active:
        raise errors.WebhookOff("The webhook is off; turn it on first.")
    tx.conn.execute(update(webhooks).where(webhooks.c.id == webhook).values(resumes_at=tx.now))


def _lock(tx: Tx, webhook: int) -> Row[Any]:
    row = tx.conn.execute(select(webhooks).where(webhooks.c.id == webhook).with_for_update()).one_or_none()
    if row is None:
        raise errors.NotFound(f"There is no webhook {webhook}.")
    return row


def _find(tx: Tx, webhook: int, delivery: int) -> wire.Delivery:
    chosen = select(deliveries).where(deliveries.c.id == delivery, deliveries.c.webhook_id == webhook)
    row = tx.conn.execute(chosen).one_or_none()
    if row is None:
        raise errors.NotFound(f"Webhook {webhook} has no message {delivery}.")
    return _delivery(row)


def _delivery(row: Row[Any]) -> wire.Delivery:
    return wire.Delivery(
        id=row.id,
        message=row.message,
        type=row.type,
        run=row.run_id,
        state=row.state,
        attempts=row.attempts,
        status=row.status,
        reason=row.reason,
        created_at=row.created_at,
        next_at=row.next_at if row.state == "pending" else None,
        ended_at=row.ended_at,
    )


def _check(policy: Policy, url: str) -> None:
    try:
        policy.check_url(url)
    except NotAllowed as error:
        raise errors.Unprocessable(["body", "url"], str(error)) from None
