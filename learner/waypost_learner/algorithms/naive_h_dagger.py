"""Naive hierarchical DAgger (Le et al. 2018, section 4.1): what Algorithm 2 improves on.

It "would provide correct labels along the entire hierarchical trajectory via Label_HI and Label_LO": whether or not the
episode succeeded, and whether or not a segment's subgoal was a good one.
"""

from collections.abc import Generator
from typing import Any

from waypost.trajectory import State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import LabelHi, LabelLo, Query
from waypost_learner.policies.datasets import Labels


def naive_h_dagger(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    sigma = learner.roll_out(s)
    labels.append_hi(sigma, (yield LabelHi(sigma)))
    for h, segment in enumerate(sigma):
        labels.append_lo(segment, (yield LabelLo(segment, before=sigma[:h])))
    return labels
