"""The public package of Waypost: the typed client, the wire messages and the prices.

    from waypost import Client, wire

The contract for your own domain is `waypost.domains`, which needs numpy and gymnasium (`pip install waypost[learner]`).
"""

from waypost import prices, wire
from waypost.client import Client, Refused, Unreachable

__all__ = ["Client", "Refused", "Unreachable", "prices", "wire"]
