"""Routes for administrators: webhooks, and the messages sent to them."""

from typing import Annotated

from fastapi import APIRouter, Query

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.parameters import RowPath
from waypost_server.http.problems import refusals
from waypost_server.webhooks import service as webhooks
from waypost_server.webhooks.policy import Policy

sent = APIRouter()
"""The requests that the server sends, for the OpenAPI document."""

router = APIRouter(prefix="/webhooks", tags=["webhooks"], route_class=JsonRoute)


@router.post("", status_code=201, operation_id="createWebhook")
async def create_webhook(body: wire.WebhookCreate, context: Ctx, caller: Allowed) -> wire.NewWebhook:
    """Create a webhook for an address that the operator has allowed. Its signing secret is shown only once."""
    policy = Policy.of(context.settings)
    return await context.db.write(lambda tx: webhooks.create(tx, body, caller.user, policy))


@router.get("", operation_id="listWebhooks")
async def list_webhooks(context: Ctx, _: Allowed) -> wire.WebhookList:
    """List all webhooks."""
    return await context.db.read(webhooks.list_webhooks)


@router.get("/{webhook}", operation_id="getWebhook", responses=refusals(errors.NotFound))
async def get_webhook(webhook: RowPath, context: Ctx, _: Allowed) -> wire.Webhook:
    """Return a webhook."""
    return await context.db.read(lambda tx: webhooks.view(tx, webhook))


@router.patch("/{webhook}", operation_id="patchWebhook", responses=refusals(errors.NotFound))
async def patch_webhook(webhook: RowPath, body: wire.WebhookPatch, context: Ctx, _: Allowed) -> wire.Webhook:
    """Change a webhook, or turn it off or on. Turning it on tries its pending messages immediately."""
    policy = Policy.of(context.settings)
    return await context.db.write(lambda tx: webhooks.change(tx, webhook, body, policy))


@router.delete("/{webhook}", status_code=204, operation_id="deleteWebhook", responses=refusals(errors.NotFound))
async def delete_webhook(webhook: RowPath, context: Ctx, _: Allowed) -> None:
    """Delete a webhook and its messages."""
    await context.db.write(lambda tx: webhooks.remove(tx, webhook))


@router.post(
    "/{webhook}/ping",
    status_code=202,
    operation_id="pingWebhook",
    responses=refusals(errors.NotFound, errors.WebhookOff),
)
async def ping_webhook(webhook: RowPath, context: Ctx, _: Allowed) -> wire.Delivery:
    """Send a test message."""
    return await context.db.write(lambda tx: webhooks.ping(tx, webhook))


@router.get("/{webhook}/deliveries", operation_id="listDeliveries", responses=refusals(errors.NotFound))
async def list_deliveries(
    webhook: RowPath,
    context: Ctx,
    _: Allowed,
    state: wire.DeliveryState | None = None,
    before: Annotated[int | None, Query(ge=0, le=2**63 - 1, description="Only messages older than this one.")] = None,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
) -> wire.DeliveryPage:
    """List one page of a webhook's messages, newest first. Messages that ended more than a week ago are deleted."""
    return await context.db.read(lambda tx: webhooks.list_deliveries(tx, webhook, state, before, limit))


@router.post(
    "/{webhook}/deliveries/{delivery}/redeliver",
    status_code=202,
    operation_id="redeliver",
    responses=refusals(errors.NotFound, errors.WebhookOff),
)
async def redeliver(webhook: RowPath, delivery: RowPath, context: Ctx, _: Allowed) -> wire.Delivery:
    """Send a message again, with the same id and content."""
    return await context.db.write(lambda tx: webhooks.redeliver(tx, webhook, delivery))


@sent.post("message", operation_id="webhook", tags=["webhooks"])
async def message(body: wire.WebhookMessage) -> None:
    """Tell a receiver about a change. The headers are those of Standard Webhooks; any status from 200 to 299 accepts.

    A receiver can get a message twice, with the same `webhook-id`.
    """
