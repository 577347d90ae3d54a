"""Naive hierarchical DAgger (Le et al. 2018, section 4.1), on which Algorithm 2 improves.

It "would provide correct labels along the entire hierarchical trajectory via Label_HI and Label_LO". It labels
successful episodes and segments with a wrong subgoal too.
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import LabelHi, LabelLo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def naive_h_dagger(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    sigma = learner.roll_out(s)
    labels.append_hi(sigma, (yield LabelHi(sigma)))
    for h, segment in enumerate(sigma):
        labels.append_lo(segment, (yield LabelLo(segment, before=sigma[:h])))
    return labels
