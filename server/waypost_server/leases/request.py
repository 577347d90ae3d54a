"""A request for the next query."""

from dataclasses import dataclass
from typing import Any

from waypost import wire
from waypost_server.settings import Settings

Kinds = tuple[wire.Kind, ...]


@dataclass(frozen=True)
class LeaseRequest:
    """An annotator's request, with the server's settings that apply to it. Times are in seconds."""

    user: int
    kinds: Kinds | None  # only these kinds of query; None for all
    run: str | None  # only this run; None for all
    defer: float  # how long to leave a query to other annotators
    ahead: bool  # the query will be answered after those that the annotator already has
    tab: str | None  # the browser tab that asks
    after: int | None  # the assignment whose answer also asks for this query
    lease_seconds: float
    presence_seconds: float
    follow_up_seconds: float

    @classmethod
    def of(cls, lease: wire.Lease, user: int, settings: Settings, after: int | None = None) -> "LeaseRequest":
        """Return the request of a message."""
        return cls(
            user,
            None if lease.kinds is None else tuple(sorted(set(lease.kinds))),
            lease.run,
            lease.defer,
            lease.ahead,
            lease.tab,
            after,
            settings.lease_seconds,
            settings.presence_seconds,
            settings.follow_up_seconds,
        )

    @classmethod
    def batch(cls, lease: wire.LeaseBatch, user: int, settings: Settings) -> "LeaseRequest":
        """Return the request of a message for several queries."""
        return cls.of(wire.Lease(**lease.model_dump(exclude={"count"})), user, settings)

    def parameters(self, now: float) -> dict[str, Any]:
        """Return the parameters of the statements that select a query."""
        return {
            "user": self.user,
            "run": self.run,
            "now": now,
            "since": now - self.presence_seconds,
            "fresh": now - self.follow_up_seconds,
            "before": now - self.defer,
        }
