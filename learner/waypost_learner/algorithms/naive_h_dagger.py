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
    d_star = yield LabelHi(sigma)
    labels.append_hi(sigma, d_star)
    for h, (segment, g_star) in enumerate(zip(sigma, d_star, strict=True)):
        lo = yield LabelLo(segment, before=sigma[:h])
        labels.append_lo(segment, lo, right_subgoal=segment.subgoal == g_star)
    return labels
