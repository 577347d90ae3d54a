"""The public package of Waypost: runs of training scripts, the typed client, the wire messages and the prices.

    import waypost

    run = waypost.start_run("taxi", actions=["north", "south"])

The contract for your own domain is `waypost.domains`, which needs numpy and gymnasium (`pip install waypost[learner]`).
"""

from waypost import prices, wire
from waypost.client import BudgetExhausted, Client, Refused, Unreachable
from waypost.runs.asked import AskedQuery, QueryCancelled
from waypost.runs.queries import HierDemo, InspectFull, InspectLo, LabelFull, LabelHi, LabelLo, Segment
from waypost.runs.run import Run
from waypost.runs.start import start_run

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
    "prices",
    "start_run",
    "wire",
]
