"""Hierarchically guided DAgger, hg-DAgger (Le et al. 2018, Algorithm 2).

This is not the human-gated HG-DAgger of Kelly et al. (arXiv 1810.02890).
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, InspectLo, LabelHi, LabelLo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def hg_dagger(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start, lines 4-19. `Learner.learn` does Train (lines 20-21)."""
    labels = Labels()
    sigma = learner.roll_out(s)  # lines 5-11
    if not (yield InspectFull(sigma)):  # line 13
        d_star = yield LabelHi(sigma)  # line 14
        for h, (segment, g_star) in enumerate(zip(sigma, d_star, strict=True)):  # line 15
            if segment.subgoal != g_star:
                break
            if not (yield InspectLo(segment, before=sigma[:h])):  # line 16
                labels.append_lo(segment, (yield LabelLo(segment, before=sigma[:h])))  # line 17
                break  # line 18
            labels.append_passed(segment)
        labels.append_hi(sigma, d_star)  # line 19
    else:
        labels.append_passed(*sigma)
    return labels
