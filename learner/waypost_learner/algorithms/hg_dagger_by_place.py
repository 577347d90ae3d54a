"""hg-DAgger as in the authors' code, which departs from Algorithm 2 in two ways.

A place is labeled once per episode: a subgoal that is chosen in the same place again costs nothing. And labeling goes
on after the first segment that fails, and after the first wrong subgoal.
"""

from collections.abc import Generator
from typing import Any

from waypost_learner.algorithms.learner import Learner
from waypost_learner.algorithms.queries import InspectFull, InspectLo, LabelHi, LabelLo, Query
from waypost_learner.policies.labels import Labels
from waypost_learner.rollout.simulator import Start


def hg_dagger_by_place(s: Start, learner: Learner) -> Generator[Query, Any, Labels]:
    """Run one episode after the warm start."""
    labels = Labels()
    sigma = learner.roll_out(s)
    if not (yield InspectFull(sigma)):
        for h in learner.first_visits(sigma):
            segment, before = sigma[h], sigma[:h]
            (g_star,) = yield LabelHi((segment,), before)
            labels.append_hi((segment,), (g_star,))
            if segment.subgoal == g_star:
                if not (yield InspectLo(segment, before)):
                    labels.append_lo(segment, (yield LabelLo(segment, before)))
                else:
                    labels.append_passed(segment)
    else:
        labels.append_passed(*sigma)
    return labels
