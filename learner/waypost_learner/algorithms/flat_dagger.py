"""Flat DAgger (Ross et al. 2011) as Le et al. 2018 modify it for their analysis (section 4.2).

It "first calls Inspect_FULL, and only requests labels (Label_FULL) if the inspection fails".
"""

from collections.abc import Generator
from typing import Any

from waypost.trajectory import State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, LabelFull, Query
from waypost_learner.policies.datasets import Labels


def flat_dagger(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    tau = learner.roll_out(s)
    if not (yield InspectFull(tau)):
        labels.append_flat(tau, (yield LabelFull(tau)))
    return labels
