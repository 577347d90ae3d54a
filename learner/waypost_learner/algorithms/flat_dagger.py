"""Flat DAgger (Ross et al. 2011) as Le et al. 2018 modify it for their analysis (section 4.2).

It "first calls Inspect_FULL, and only requests labels (Label_FULL) if the inspection fails".
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, LabelFull, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def flat_dagger(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    tau = learner.roll_out(s)
    if not (yield InspectFull(tau)):
        labels.append_flat(tau, (yield LabelFull(tau)))
    else:
        labels.append_passed(*tau)
    return labels
