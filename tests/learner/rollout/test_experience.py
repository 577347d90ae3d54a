"""Experience: what is read off a segment for learning by reinforcement."""

import math
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import examples, segment

from waypost.trajectory import Outcome
from waypost_learner.rollout.experience import PseudoReward, Returns, of_actions, of_subgoal, of_subgoals

PSEUDO = PseudoReward(reached=1.0, failed=-1.0, step=-0.1)
ONE = Returns(discount=0.9)


@pytest.mark.parametrize(("outcome", "reward"), [("reached", 1.0), ("failed", -1.0)])
def test_a_subgoal_that_ended_brings_its_pseudo_reward_and_nothing_comes_after(outcome: Outcome, reward: float) -> None:
    transitions = of_subgoal(replace(segment(2, n_actions=3), outcome=outcome), PSEUDO, ONE).transitions
    assert [t.reward for t in transitions] == [-0.1, -0.1, reward]
    assert [t.steps for t in transitions] == [1, 1, 0]


def test_a_subgoal_that_was_cut_off_goes_on_in_the_state_where_it_was() -> None:
    one = segment(2, n_actions=3)
    experience = of_subgoal(one, PSEUDO, ONE)
    assert [(t.reward, t.steps) for t in experience.transitions] == [(-0.1, 1)] * 3
    assert experience.observations[experience.transitions[-1].next_state] is one.states[-1].observation


AUTHORS = Returns(discount=0.9, terminal="episode")


def test_where_only_the_episode_ends_a_reached_subgoal_is_rewarded_and_goes_on() -> None:
    one = replace(segment(2, n_actions=2), outcome="reached")
    assert [(t.reward, t.steps) for t in of_subgoal(one, PSEUDO, AUTHORS).transitions] == [(-0.1, 1), (1.0, 1)]


def test_where_only_the_episode_ends_running_out_of_time_is_no_failure_but_death_is() -> None:
    late = replace(segment(2, n_actions=2), outcome="failed")
    assert [(t.reward, t.steps) for t in of_subgoal(late, PSEUDO, AUTHORS).transitions] == [(-0.1, 1), (-0.1, 1)]
    dead = replace(late, final=True)
    assert [(t.reward, t.steps) for t in of_subgoal(dead, PSEUDO, AUTHORS).transitions] == [(-0.1, 1), (-1.0, 0)]


def test_nothing_comes_after_the_end_of_the_episode() -> None:
    ended = replace(segment(2, n_actions=2), final=True)
    assert [t.steps for t in of_subgoal(ended, PSEUDO, ONE).transitions] == [1, 0]


def test_a_flat_trajectory_keeps_the_environments_rewards() -> None:
    one = replace(segment(None, n_actions=3), rewards=(0.0, 0.5, -1.0))
    assert [(t.reward, t.steps) for t in of_actions(one, ONE).transitions] == [(0.0, 1), (0.5, 1), (-1.0, 1)]
    assert [t.steps for t in of_actions(replace(one, final=True), ONE).transitions] == [1, 1, 0]


@examples
@given(st.lists(st.floats(-1, 1), min_size=1, max_size=12), st.integers(1, 15), st.booleans())
def test_n_step_returns_sum_up_the_next_rewards_and_continue_in_the_state_after_them(
    rewards: list[float], ahead: int, final: bool
) -> None:
    one = replace(segment(None, n_actions=len(rewards)), rewards=tuple(rewards), final=final)
    for t in of_actions(one, Returns(0.5, ahead)).transitions:
        seen = rewards[t.state : t.state + ahead]
        assert t.next_state == t.state + len(seen)
        assert t.reward == pytest.approx(sum(0.5**n * reward for n, reward in enumerate(seen)))
        assert t.steps == (0 if final and t.next_state == len(rewards) else len(seen))


def test_a_subgoal_is_one_transition_of_the_meta_controller_discounted_by_its_steps() -> None:
    first = replace(segment(1, n_actions=3), rewards=(0.0, 0.0, 1.0))
    last = replace(segment(4, n_actions=2), rewards=(0.0, -1.0), final=True)
    experience = of_subgoals((first, last), ONE)
    one, other = experience.transitions
    assert (one.choice, one.steps, other.choice, other.steps) == (1, 3, 4, 0)
    assert math.isclose(one.reward, 0.81)
    assert math.isclose(other.reward, -0.9)
    starts = [first.start, last.start, last.states[-1]]
    assert all(a is b.observation for a, b in zip(experience.observations, starts, strict=True))
    assert [(t.state, t.next_state) for t in experience.transitions] == [(0, 1), (1, 2)]


def test_per_choice_the_meta_controller_discounts_each_subgoal_once_however_long_it_takes() -> None:
    first = replace(segment(1, n_actions=3), rewards=(0.0, 0.0, 1.0))
    last = replace(segment(4, n_actions=2), rewards=(0.5, -1.0), final=True)
    one, other = of_subgoals((first, last), Returns(discount=0.9, per="choice")).transitions
    assert (one.reward, one.steps, other.reward, other.steps) == (1.0, 1, -0.5, 0)
