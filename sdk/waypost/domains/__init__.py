"""The contract of a domain, for authors of plug-ins. It needs numpy and gymnasium (`pip install waypost[learner]`)."""

from waypost.domains.contract import (
    Domain,
    Grid,
    Horizons,
    InstanceSets,
    Oracle,
    Pictured,
    Relabeled,
    Structured,
    Symmetry,
    View,
    find_domain,
)

__all__ = [
    "Domain",
    "Grid",
    "Horizons",
    "InstanceSets",
    "Oracle",
    "Pictured",
    "Relabeled",
    "Structured",
    "Symmetry",
    "View",
    "find_domain",
]
