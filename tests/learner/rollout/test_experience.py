"""Transitions: what is read off a segment for learning by reinforcement."""

import math
from dataclasses import replace

import pytest
from tests.learner.kit import segment

from waypost.trajectory import Outcome
from waypost_learner.rollout.experience import PseudoReward, of_actions, of_subgoal, of_subgoals

PSEUDO = PseudoReward(reached=1.0, failed=-1.0, step=-0.1)


@pytest.mark.parametrize(("outcome", "reward"), [("reached", 1.0), ("failed", -1.0)])
def test_a_subgoal_that_ended_brings_its_pseudo_reward_and_nothing_comes_after(outcome: Outcome, reward: float) -> None:
    transitions = of_subgoal(replace(segment(2, n_actions=3), outcome=outcome), PSEUDO)
    assert [t.reward for t in transitions] == [-0.1, -0.1, reward]
    assert [t.steps for t in transitions] == [1, 1, 0]


def test_a_subgoal_that_was_cut_off_goes_on_in_the_state_where_it_was() -> None:
    one = segment(2, n_actions=3)
    transitions = of_subgoal(one, PSEUDO)
    assert [(t.reward, t.steps) for t in transitions] == [(-0.1, 1)] * 3
    assert transitions[-1].next_observation is one.states[-1].observation


def test_nothing_comes_after_the_end_of_the_episode() -> None:
    assert [t.steps for t in of_subgoal(replace(segment(2, n_actions=2), final=True), PSEUDO)] == [1, 0]


def test_a_flat_trajectory_keeps_the_environments_rewards() -> None:
    one = replace(segment(None, n_actions=3), rewards=(0.0, 0.5, -1.0))
    assert [(t.reward, t.steps) for t in of_actions(one)] == [(0.0, 1), (0.5, 1), (-1.0, 1)]
    assert [t.steps for t in of_actions(replace(one, final=True))] == [1, 1, 0]


def test_a_subgoal_is_one_transition_of_the_meta_controller_discounted_by_its_steps() -> None:
    first = replace(segment(1, n_actions=3), rewards=(0.0, 0.0, 1.0))
    last = replace(segment(4, n_actions=2), rewards=(0.0, -1.0), final=True)
    one, other = of_subgoals((first, last), discount=0.9)
    assert (one.choice, one.steps, other.choice, other.steps) == (1, 3, 4, 0)
    assert math.isclose(one.reward, 0.81)
    assert math.isclose(other.reward, -0.9)
    assert one.next_observation is first.states[-1].observation
