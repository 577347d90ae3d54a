"""Flat DAgger (Ross et al. 2011) as Le et al. 2018 modify it for their analysis (section 4.2).

It "first calls Inspect_FULL, and only requests labels (Label_FULL) if the inspection fails".
"""

from collections.abc import Generator
from typing import Any

from learner.datasets import Labels
from learner.learner import Learner
from learner.queries import InspectFull, LabelFull, Query
from learner.types import State


def flat_dagger(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    tau = learner.roll_out(s)
    if not (yield InspectFull(tau)):
        labels.append_flat(tau, (yield LabelFull(tau)))
    return labels
