"""Flat DAgger without an inspection (Ross et al. 2011), as the authors of Le et al. 2018 ran it.

It labels every rollout, also those that succeeded.
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import LabelFull, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def plain_dagger(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    tau = learner.roll_out(s)
    labels.append_flat(tau, (yield LabelFull(tau)))
    return labels
