"""The public package of Waypost: the typed client, the wire messages, the prices, and domains of your own.

    from waypost import Client, wire

`waypost.domain(...)` makes a domain from a Gymnasium environment; it needs numpy and gymnasium
(`pip install waypost[learner]`). The contract of domains is `waypost.domains`.
"""

from typing import TYPE_CHECKING, Any

from waypost import prices, wire
from waypost.client import Client, Refused, Unreachable

if TYPE_CHECKING:
    from waypost.domains.environment import domain

__all__ = ["Client", "Refused", "Unreachable", "domain", "prices", "wire"]


def __getattr__(name: str) -> Any:
    """Load what needs numpy only when it is used, so that client programs do without numpy."""
    if name == "domain":
        from waypost.domains.environment import domain

        return domain
    raise AttributeError(f"module 'waypost' has no attribute {name!r}")
