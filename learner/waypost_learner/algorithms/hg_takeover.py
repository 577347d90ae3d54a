"""Algorithm 2 in which the expert plays on where a segment failed, instead of labeling the segment.

In the human-gated HG-DAgger (Kelly et al., arXiv 1810.02890) too, an expert takes over from the learner, and what is
learned are the expert's own actions. Here it takes over after a segment, for one subgoal (docs/paper.md, deviation 31).
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import HierDemo, InspectFull, InspectLo, LabelHi, LabelLo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def hg_takeover(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start, lines 4-19 of Algorithm 2 with another line 17."""
    labels = Labels()
    sigma = learner.roll_out(s)
    if not (yield InspectFull(sigma)):
        d_star = yield LabelHi(sigma)
        for h, (segment, g_star) in enumerate(zip(sigma, d_star, strict=True)):
            if segment.subgoal != g_star:
                break
            if not (yield InspectLo(segment, before=sigma[:h])):
                if learner.goes_on(s, sigma[: h + 1]):
                    shown = yield HierDemo(segment.states[-1], before=sigma[: h + 1], max_segments=1)
                    labels.append_demonstration(shown)
                else:
                    labels.append_lo(segment, (yield LabelLo(segment, before=sigma[:h])))
                break
            labels.append_passed(segment)
        labels.append_hi(sigma, d_star)
    else:
        labels.append_passed(*sigma)
    return labels
