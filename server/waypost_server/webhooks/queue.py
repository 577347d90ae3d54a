"""The queue of messages: claims the next message of a webhook for one server process, and records the outcome.

One process at a time delivers the messages of a webhook, oldest first. A claim expires by itself, so the messages of a
process that was killed are delivered by another one or after a restart. A receiver can therefore get a message twice;
the id of the message is then the same.
"""

import random
import secrets
from dataclasses import dataclass
from typing import Any

from sqlalchemy import Row, delete, exists, or_, select, update

from waypost_server.db.tables import IS_PENDING, deliveries, webhooks
from waypost_server.db.transaction import Tx
from waypost_server.settings import Settings

MARGIN_SECONDS = 5.0  # how much longer a claim lasts than one call
LONGEST_PAUSE_SECONDS = 3_600.0
KEPT_SECONDS = 7 * 86_400.0  # how long delivered and given up messages stay visible
GONE = 410  # the status with which a receiver asks for no more messages


@dataclass(frozen=True)
class Claim:
    """A message to deliver, and the webhook that this process has claimed."""

    webhook: int
    claim: str
    url: str
    secret: str
    delivery: int
    message: str
    body: str
    at: float  # the database's time, in seconds since the epoch


@dataclass(frozen=True)
class Outcome:
    """The result of one attempt: the status of the response if there was one, and a reason if the attempt failed."""

    status: int | None
    reason: str | None = None


def _due(now: float) -> Any:
    return (deliveries.c.webhook_id == webhooks.c.id, IS_PENDING, deliveries.c.next_at <= now)


def is_due(tx: Tx) -> bool:
    """Return whether a message waits for a process to deliver it."""
    return tx.conn.execute(_claimable(tx.now)).first() is not None


def _claimable(now: float) -> Any:
    return (
        select(webhooks)
        .where(
            webhooks.c.active,
            webhooks.c.resumes_at <= now,
            or_(webhooks.c.claimed_until.is_(None), webhooks.c.claimed_until <= now),
            exists().where(*_due(now)),
        )
        .order_by(webhooks.c.resumes_at, webhooks.c.id)  # those that were served last come last
        .limit(1)
    )


def claim(tx: Tx, seconds: float) -> Claim | None:
    """Claim a webhook with a due message, for one call of at most `seconds`; return None if there is none."""
    row = tx.conn.execute(
        _claimable(tx.now).with_for_update(skip_locked=True, key_share=True, of=webhooks)
    ).one_or_none()
    return None if row is None else _next(tx, row, seconds)


def _next(tx: Tx, webhook: Row[Any], seconds: float) -> Claim | None:
    """Claim the oldest due message of a locked webhook; end the claim if there is none."""
    due = select(deliveries).join(webhooks).where(webhooks.c.id == webhook.id, *_due(tx.now)).order_by(deliveries.c.id)
    message = tx.conn.execute(due.limit(1)).one_or_none() if webhook.active else None
    if message is None:
        _change(tx, webhook.id, claim=None, claimed_until=None)
        return None
    token = secrets.token_hex(8)
    _change(tx, webhook.id, claim=token, claimed_until=tx.now + seconds + MARGIN_SECONDS)
    return Claim(webhook.id, token, webhook.url, webhook.secret, message.id, message.message, message.body, tx.now)


def settle(tx: Tx, claim: Claim, outcome: Outcome, settings: Settings) -> Claim | None:
    """Record the outcome of an attempt, and claim the webhook's next due message; return None if there is none.

    If the claim had expired, another process may have taken over, and the outcome is dropped.
    """
    held = select(webhooks).where(webhooks.c.id == claim.webhook, webhooks.c.claim == claim.claim)
    webhook = tx.conn.execute(held.with_for_update(key_share=True)).one_or_none()
    if webhook is None:
        return None
    message = tx.conn.execute(select(deliveries).where(deliveries.c.id == claim.delivery)).one()
    if outcome.reason is None:
        tx.count("messages", "delivered")
        _record(tx, message, outcome, state="delivered", ended_at=tx.now)
        _change(tx, webhook.id, failures=0, failing_since=None, resumes_at=tx.now)
        return _next(tx, webhook, settings.webhook_seconds)
    _fail(tx, webhook, message, outcome, settings)
    return None


def _fail(tx: Tx, webhook: Row[Any], message: Row[Any], outcome: Outcome, settings: Settings) -> None:
    """Pause the webhook, and its message for twice as long, so that one bad message does not hold up the others."""
    failures, since = webhook.failures + 1, webhook.failing_since or tx.now
    if tx.now - message.queued_at >= settings.webhook_give_up_seconds:
        tx.count("messages", "given_up")
        _record(tx, message, outcome, state="given_up", ended_at=tx.now)
    else:
        tx.count("messages", "failed")
        longer = pause(max(failures, message.attempts + 1), settings.webhook_retry_seconds)
        _record(tx, message, outcome, next_at=tx.now + 2 * longer)
    changes = {
        "failures": failures,
        "failing_since": since,
        "resumes_at": tx.now + pause(failures, settings.webhook_retry_seconds),
        "claim": None,
        "claimed_until": None,
    }
    if outcome.status == GONE:
        changes |= {"active": False, "off_reason": "The receiver answered 410 Gone: it wants no more messages."}
    elif tx.now - since >= settings.webhook_off_seconds:
        days = settings.webhook_off_seconds / 86_400
        changes |= {"active": False, "off_reason": f"It failed for {days:g} days; the last time: {outcome.reason}"}
    _change(tx, webhook.id, **changes)


def pause(failures: int, first: float) -> float:
    """Return how long to wait after a number of failures in a row, in seconds: exponential, capped, with jitter."""
    longest = min(first * 2.0 ** min(failures - 1, 30), LONGEST_PAUSE_SECONDS)
    return longest * random.uniform(0.75, 1.0)  # noqa: S311 - jitter


def forget_old(tx: Tx) -> None:
    """Delete messages that were delivered or given up long ago."""
    tx.conn.execute(delete(deliveries).where(deliveries.c.ended_at <= tx.now - KEPT_SECONDS))


def _record(tx: Tx, message: Row[Any], outcome: Outcome, **changes: Any) -> None:
    values = {"attempts": message.attempts + 1, "status": outcome.status, "reason": outcome.reason, **changes}
    tx.conn.execute(update(deliveries).where(deliveries.c.id == message.id).values(**values))


def _change(tx: Tx, webhook: int, **values: Any) -> None:
    tx.conn.execute(update(webhooks).where(webhooks.c.id == webhook).values(**values))
