"""Gated hg-DAgger: Algorithm 2, but the learner says what it doubts, and only this is asked about.

A gate replaces Inspect_FULL (`waypost_learner.gates`, docs/general.md). It is asked about choices one by one, until the
first that is wrong. A rollout without doubts costs nothing.
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectLo, LabelHi, LabelLo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def hg_gated(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    sigma = learner.roll_out(s)
    doubts = learner.doubts(sigma)
    agreed, passed = dict[int, bool](), dict[int, bool]()
    for h, segment in enumerate(sigma):
        if doubts.hi[h]:
            (g_star,) = yield LabelHi((segment,), before=sigma[:h])
            labels.append_hi((segment,), (g_star,))
            agreed[h] = segment.subgoal == g_star
            if not agreed[h]:
                break
        if doubts.lo[h]:
            passed[h] = yield InspectLo(segment, before=sigma[:h])
            if not passed[h]:
                lo = yield LabelLo(segment, before=sigma[:h])
                labels.append_lo(segment, lo, right_subgoal=h in agreed)
                break
            labels.append_passed(segment, right_subgoal=h in agreed)
    labels.judged = doubts.judged({"hi": agreed, "lo": passed})
    return labels
