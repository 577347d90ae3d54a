"""Hierarchically guided Stagger: Algorithm 2, but only one random segment of a failed episode is labeled.

Stagger is DAgger with one labeled state per round, drawn at random from the states that the policy visited.
Warm-Stagger begins with demonstrations (Li and Zhang, "Interactive and Hybrid Imitation Learning", NeurIPS 2025, arXiv
2412.07057).
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, InspectLo, LabelHi, LabelLo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def hg_stagger(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    sigma = learner.roll_out(s)
    h = learner.draw_one(s, sigma)
    segment, before = sigma[h], sigma[:h]
    if not (yield InspectFull(sigma)):
        (g_star,) = yield LabelHi((segment,), before)
        if segment.subgoal == g_star:
            if not (yield InspectLo(segment, before)):
                labels.append_lo(segment, (yield LabelLo(segment, before)))
            else:
                labels.append_passed(segment)
        labels.append_hi((segment,), (g_star,))
    else:
        labels.append_passed(*sigma)
    return labels
