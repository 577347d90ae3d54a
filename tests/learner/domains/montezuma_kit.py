"""What the tests of Montezuma's Revenge play with: the domain, its oracle, and episodes."""

from typing import Any

from hypothesis import settings
from hypothesis import strategies as st

from waypost_learner.domains.montezuma.domain import MontezumaDomain
from waypost_learner.domains.montezuma.env import Instance
from waypost_learner.domains.montezuma.game import ACTIONS
from waypost_learner.rollout.simulator import Simulator

domain = MontezumaDomain()
oracle = domain.oracle
simulator = Simulator(domain)
few = settings(max_examples=25, deadline=None)
instances = st.builds(
    Instance, st.integers(0, 19), st.sampled_from([0.0, 0.05]), st.sampled_from([0.0, 0.25]), st.integers(0, 99)
)
walks = st.lists(st.tuples(st.integers(0, len(ACTIONS) - 1), st.integers(1, 12)), max_size=12)


def carried_out(walk: list[tuple[int, int]]) -> list[int]:
    """Each action of a walk as often as the walk says."""
    return [action for action, times in walk for _ in range(times)]


def played(instance: Instance, actions: list[int]) -> list[Any]:
    """The states along actions, until the episode ends."""
    states = [simulator.reset(instance)]
    for action in actions:
        if simulator.ended:
            break
        states.append(simulator.step(action))
    return states


def expert_plays(instance: Instance) -> tuple[bool, list[str], list[Any]]:
    """The oracle plays an episode: whether the door opens, the subgoals it chose, and the views."""
    views, subgoals, subgoal = [simulator.reset(instance).view], list[int](), -1
    while not simulator.ended and len(views) < 600:
        if subgoal < 0 or oracle.reached(None, None, views[-1], subgoal):
            subgoal = oracle.good_subgoals(None, views[-1])[0]
            subgoals.append(subgoal)
        good = oracle.good_actions(None, None, views[-1], subgoal)
        views.append(simulator.step(good[0] if good else 0).view)
    return simulator.succeeded, [domain.subgoals[one] for one in subgoals], views
