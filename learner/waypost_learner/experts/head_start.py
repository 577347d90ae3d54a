"""Head starts: the first part of an optimal trajectory, without which h-DQN does not succeed (paper, appendix)."""

from collections.abc import Sequence
from functools import lru_cache
from typing import Any

from waypost.domains import Domain
from waypost.trajectory import Action
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.rollout.simulator import HeadStart, Simulator


def head_start(domain: Domain, share: float) -> HeadStart:
    """Return a function from an instance to the first actions of the oracle's demonstration on it.

    Args:
        domain: the domain; its oracle demonstrates.
        share: the share of the demonstration's actions; their number is rounded down.

    Raises:
        ValueError: the domain has no oracle, or the share is not between 0 and 1.
    """
    if not 0 < share < 1:
        raise ValueError(f"a head start is a share between 0 and 1, not {share:g}")
    expert, simulator = OracleExpert(domain), Simulator(domain)

    @lru_cache(maxsize=4_096)
    def actions(instance: Any) -> Sequence[Action]:
        demonstration = expert.demonstrate(domain.instance_view(instance), simulator.reset(instance).view)
        names = [action for segment in demonstration.segments for action in segment.actions]
        return [domain.actions.index(name) for name in names[: int(share * len(names))]]

    return actions
