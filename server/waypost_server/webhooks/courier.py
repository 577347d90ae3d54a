"""The background task that delivers messages to webhooks, apart from the server's requests."""

import asyncio
import logging
import time
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from datetime import UTC, datetime
from functools import partial

import httpcore2
from sqlalchemy.exc import DBAPIError
from standardwebhooks import Webhook

from waypost_server.db import wakeups
from waypost_server.errors import StorageFailed
from waypost_server.http.background import going_on
from waypost_server.http.context import VERSION, Context
from waypost_server.webhooks import outbox, queue
from waypost_server.webhooks.network import Post
from waypost_server.webhooks.policy import NotAllowed, Policy
from waypost_server.webhooks.queue import Claim, Outcome

AT_ONCE = 8  # webhooks that are served at the same time
FORGET_SECONDS = 3_600.0  # the interval at which old messages are deleted
LONGEST_REASON = 300

log = logging.getLogger("waypost.webhooks")


@asynccontextmanager
async def delivering(context: Context) -> AsyncIterator[None]:
    """Deliver messages for as long as the context lasts. Without allowed hosts there is nothing to do.

    A server process that is stopped leaves its claims, which expire; another process then delivers the messages.
    """
    if not context.settings.webhook_hosts:
        yield
        return
    async with going_on(_deliver(context)):
        yield


async def _deliver(context: Context) -> None:
    """Deliver due messages forever."""
    settings, places, forgot_at = context.settings, asyncio.Semaphore(AT_ONCE), -FORGET_SECONDS
    async with Post(Policy.of(settings), settings.webhook_seconds) as post, asyncio.TaskGroup() as group:
        while True:
            changed = context.hub.watch(outbox.TOPIC)
            claim: Claim | None = None
            await places.acquire()
            try:
                if time.monotonic() - forgot_at >= FORGET_SECONDS:
                    await context.db.write(queue.forget_old)
                    forgot_at = time.monotonic()
                if await context.db.read(queue.is_due):
                    claim = await context.db.write(partial(queue.claim, seconds=settings.webhook_seconds))
            except (StorageFailed, DBAPIError) as error:
                log.warning("Webhooks could not be read: %s", error)
            if claim is None:
                places.release()
                await wakeups.pause(changed, settings.poll_seconds)
            else:
                group.create_task(_serve(context, post, claim)).add_done_callback(lambda _: places.release())


async def _serve(context: Context, post: Post, first: Claim) -> None:
    """Deliver the due messages of one webhook, one after the other, until one fails."""
    claim: Claim | None = first
    try:
        while claim is not None:
            outcome = await attempt(post, claim)
            if outcome.reason is not None:
                log.warning("Webhook %d: message %s failed: %s", claim.webhook, claim.message, outcome.reason)
            settle = partial(queue.settle, claim=claim, outcome=outcome, settings=context.settings)
            claim = await context.db.write(settle)
    except Exception:  # the claim expires, and the message is sent again
        log.exception("Webhook %d: the outcome of a message could not be stored", first.webhook)


async def attempt(post: Post, claim: Claim) -> Outcome:
    """Send a message once, signed as Standard Webhooks describe."""
    now = datetime.fromtimestamp(claim.at, UTC)
    headers = {
        "Content-Type": "application/json",
        "User-Agent": f"Waypost/{VERSION}",
        "webhook-id": claim.message,
        "webhook-timestamp": str(int(claim.at)),
        "webhook-signature": Webhook(claim.secret).sign(claim.message, now, claim.body),
    }
    try:
        status = await post.send(claim.url, headers, claim.body.encode())
    except NotAllowed as error:
        return Outcome(None, f"Not sent: {error}."[:LONGEST_REASON])
    except TimeoutError:
        return Outcome(None, "The receiver took too long.")
    except (httpcore2.NetworkError, httpcore2.TimeoutException, httpcore2.ProtocolError, OSError) as error:
        return Outcome(None, f"No connection: {str(error) or type(error).__name__}"[:LONGEST_REASON])
    if 200 <= status < 300:
        return Outcome(status)
    more = "; redirects are not followed" if 300 <= status < 400 else ""
    return Outcome(status, f"The receiver answered {status}{more}.")
