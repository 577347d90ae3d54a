"""The public package of Waypost: runs of training scripts, domains of your own, the typed client, the wire messages.

    import waypost

    run = waypost.start_run("taxi", actions=["north", "south"])

`waypost.domain(...)` makes a domain from a Gymnasium environment; it needs numpy and gymnasium
(`pip install waypost[learner]`). The contract of domains is `waypost.domains`.
"""

from typing import TYPE_CHECKING, Any

from waypost import prices, wire
from waypost.client import BudgetExhausted, Client, Refused, Unreachable
from waypost.runs.asked import AskedQuery, QueryCancelled
from waypost.runs.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Segment
from waypost.runs.run import Run
from waypost.runs.start import start_run

if TYPE_CHECKING:
    from waypost.domains.environment import domain

__all__ = [
    "AskedQuery",
    "BudgetExhausted",
    "Client",
    "HierDemo",
    "InspectFull",
    "InspectLo",
    "LabelFull",
    "LabelHi",
    "LabelLo",
    "QueryCancelled",
    "Refused",
    "Run",
    "Segment",
    "Unreachable",
    "domain",
    "prices",
    "start_run",
    "wire",
]


def __getattr__(name: str) -> Any:
    """Load what needs numpy only when it is used, so that client programs do without numpy."""
    if name == "domain":
        from waypost.domains.environment import domain

        return domain
    raise AttributeError(f"module 'waypost' has no attribute {name!r}")
