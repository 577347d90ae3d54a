"""Hierarchically guided Stagger: Algorithm 2, with one state of a failed episode labeled on the HI level, not all.

Stagger is DAgger with one labeled state a round, drawn from those that the policy visited; after demonstrations it is
Warm-Stagger (Li and Zhang, "Interactive and Hybrid Imitation Learning", NeurIPS 2025, arXiv 2412.07057).
"""

from collections.abc import Generator
from typing import Any

from waypost.trajectory import State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, InspectLo, LabelHi, LabelLo, Query
from waypost_learner.policies.datasets import Labels


def hg_stagger(s: State, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    sigma = learner.roll_out(s)
    h = learner.draw_one(sigma)
    segment, before = sigma[h], sigma[:h]
    if not (yield InspectFull(sigma)):
        (g_star,) = yield LabelHi((segment,), before)
        if segment.subgoal == g_star and not (yield InspectLo(segment, before)):
            labels.append_lo(segment, (yield LabelLo(segment, before)))
        labels.append_hi((segment,), (g_star,))
    return labels
