"""Tell whether a demonstration reached its last subgoal. Its expert may have died or given up on the way."""

from dataclasses import replace
from typing import Any

from waypost.domains import Domain, Ending
from waypost.trajectory import Trajectory


def judged(domain: Domain, instance: Any, demonstration: Trajectory) -> Trajectory:
    """Return a demonstration with the outcome of its last segment, which ended its subgoal only if it reached it.

    Earlier segments ended where the expert said so. If the domain does not say how subgoals end, so did the last one.
    """
    *earlier, last = demonstration
    if last.subgoal is None or not isinstance(domain, Ending):
        return demonstration
    outcome = domain.outcome(instance, last.start.view, last.states[-1].view, last.subgoal)
    return (*earlier, replace(last, outcome=outcome, terminated=outcome == "reached"))
