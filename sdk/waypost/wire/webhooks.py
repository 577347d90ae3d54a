"""Defines the messages about webhooks: their management, their deliveries, and what a receiver gets."""

from typing import Annotated, Literal, get_args

from pydantic import Field

from waypost.wire.words import Kind, Message, Note, RunState

__all__ = [
    "WEBHOOK_TOPICS",
    "AnswerNews",
    "Delivery",
    "DeliveryPage",
    "DeliveryState",
    "NewWebhook",
    "PingNews",
    "RunNews",
    "Webhook",
    "WebhookAnswer",
    "WebhookCreate",
    "WebhookList",
    "WebhookMessage",
    "WebhookPatch",
    "WebhookPing",
    "WebhookRun",
    "WebhookTopic",
    "WebhookUrl",
]

WebhookTopic = Literal["answer.accepted", "answer.retracted", "run.state"]
WEBHOOK_TOPICS: tuple[WebhookTopic, ...] = get_args(WebhookTopic)
DeliveryState = Literal["pending", "delivered", "given_up"]

WebhookUrl = Annotated[
    str,
    Field(
        min_length=1,
        max_length=2_000,
        pattern=r"^[\x21-\x7e]+$",
        description="The https address of the receiver. The operator must have allowed its host.",
    ),
]
_Topics = Annotated[list[WebhookTopic], Field(min_length=1, max_length=10)]


class WebhookCreate(Message):
    """A new webhook, sent by an administrator."""

    url: WebhookUrl
    topics: _Topics = Field(default=list(WEBHOOK_TOPICS), description="The changes to announce.")
    note: Note = ""


class WebhookPatch(Message):
    """Changes of a webhook, sent by an administrator. Absent fields do not change."""

    url: WebhookUrl | None = None
    topics: _Topics | None = Field(default=None, description="The changes to announce.")
    note: Note | None = None
    active: bool | None = Field(
        default=None,
        description="False turns the webhook off. True turns it on again and tries its pending messages at once.",
    )


class Webhook(Message):
    """A webhook without its secret, sent by the server."""

    id: int
    url: str
    topics: list[WebhookTopic] = Field(description="The changes that it announces.")
    note: str
    active: bool = Field(description="Whether it is on. Nothing is queued for a webhook that is off.")
    off_reason: str | None = Field(description="Why the server turned it off; null if the server did not.")
    failing_since: float | None = Field(
        description="When the first of the latest attempts failed, in seconds since the epoch; null if none failed."
    )
    pending: int = Field(description="The number of messages that wait for delivery.")
    created_at: float = Field(description="When it was created, in seconds since the epoch.")


class NewWebhook(Message):
    """A new webhook and its signing secret, sent by the server only once."""

    webhook: Webhook
    secret: str = Field(description="The key of the signatures, in the format of Standard Webhooks: `whsec_...`.")


class WebhookList(Message):
    """All webhooks, oldest first, sent by the server."""

    webhooks: list[Webhook]


class Delivery(Message):
    """One message to one webhook, sent by the server."""

    id: int
    message: str = Field(description="The `webhook-id` that every attempt carries.")
    type: str = Field(description="The topic, or `ping`.")
    run: str | None = Field(description="The id of the run; null for a ping.")
    state: DeliveryState
    attempts: int = Field(description="The number of attempts so far.")
    status: int | None = Field(description="The HTTP status of the last attempt; null if there was no reply.")
    reason: str | None = Field(description="Why the last attempt failed; null if it did not.")
    created_at: float = Field(description="When the message was queued, in seconds since the epoch.")
    next_at: float | None = Field(description="When the next attempt is due, in seconds since the epoch.")
    ended_at: float | None = Field(description="When it was delivered or given up, in seconds since the epoch.")


class DeliveryPage(Message):
    """One page of the deliveries of a webhook, newest first, sent by the server."""

    deliveries: list[Delivery]


# --- what a receiver gets; the envelope is that of Standard Webhooks


class AnswerNews(Message):
    """An answer that was accepted or retracted, without its content, which the REST API has."""

    event: int = Field(description="The id of the event in the run's event stream; it grows with every change.")
    run: str = Field(description="The id of the run.")
    query: int = Field(description="The id of the query.")
    answer: int = Field(description="The id of the answer.")
    kind: Kind
    episode: int = Field(description="The number of the episode in the run, from 0.")
    units: float = Field(description="The cost of the answer, charged or refunded, in units.")


class RunNews(Message):
    """A run that was created, paused, resumed or finished."""

    event: int = Field(description="The id of the event in the run's event stream; it grows with every change.")
    run: str = Field(description="The id of the run.")
    name: str = Field(description="The name of the run at that time.")
    state: RunState


class PingNews(Message):
    """The content of a test message."""

    webhook: int = Field(description="The id of the webhook.")


_Timestamp = Annotated[str, Field(description="When the change happened, in UTC, as in ISO 8601.")]


class WebhookAnswer(Message):
    """The body of a request to a receiver: an answer was accepted or retracted."""

    type: Literal["answer.accepted", "answer.retracted"]
    timestamp: _Timestamp
    data: AnswerNews


class WebhookRun(Message):
    """The body of a request to a receiver: a run has a new state."""

    type: Literal["run.state"]
    timestamp: _Timestamp
    data: RunNews


class WebhookPing(Message):
    """The body of a request to a receiver: an administrator tests the webhook."""

    type: Literal["ping"]
    timestamp: _Timestamp
    data: PingNews


WebhookMessage = Annotated[WebhookAnswer | WebhookRun | WebhookPing, Field(discriminator="type")]
"""The body of every request to a receiver."""
