"""Rollouts are those of Algorithm 2, and batches of them the same as one by one."""

from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import GREEDY, TINY, examples

from waypost.domains import Horizons
from waypost.trajectory import Trajectory, n_steps
from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.policies.levels import Levels
from waypost_learner.rollout.lead import Lead
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi
from waypost_learner.rollout.rollout import (
    Behavior,
    Outputs,
    Rollout,
    SelectionSpec,
    choose,
    flat_rollout,
    hierarchical_rollout,
    run,
    run_all,
)
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.rollout.streams import TEST, TRAIN

H_LO = CorridorDomain.horizons.lo

WEST, EAST, TARGET = range(3)


class Fixed:
    """A policy that always prefers one choice; beta_g fires with a given probability, or per observation."""

    def __init__(self, choice: int, n: int, termination: float | Callable[[np.ndarray], float] = 0.0) -> None:
        self.choice, self.n, self.termination = choice, n, termination
        self.batches: list[int] = []

    def __call__(self, observations: np.ndarray) -> Outputs:
        self.batches.append(len(observations))
        logits = np.zeros((len(observations), self.n), np.float32)
        logits[:, self.choice] = 1
        fires = [self.termination(o) if callable(self.termination) else self.termination for o in observations]
        return Outputs(logits, np.array(fires, np.float32))


def corridor_policies(beta: float | Callable[[np.ndarray], float]) -> Mapping[PolicyKey, Any]:
    return {
        META: Fixed(EAST, 3),
        pi(WEST): Fixed(0, 2, beta),
        pi(EAST): Fixed(1, 2, beta),
        pi(TARGET): Fixed(1, 2, beta),
    }


def corridor_rollout(instance: Corridor, choosing: SelectionSpec = GREEDY, seed: int = 0, h_hi: int = 30) -> Rollout:
    """A rollout in a corridor."""
    behavior = Behavior(choosing, np.random.default_rng(seed), h_hi, H_LO)
    return hierarchical_rollout(Simulator(CorridorDomain()), instance, behavior)


def rolled_out(instance: Corridor, beta: float | Callable[[np.ndarray], float]) -> Trajectory:
    rollout = hierarchical_rollout(
        Simulator(CorridorDomain()), instance, Behavior(GREEDY, np.random.default_rng(0), h_hi=30, h_lo=H_LO)
    )
    return run(rollout, corridor_policies(beta))


def test_a_termination_that_always_fires_still_leaves_one_step_to_every_segment() -> None:
    sigma = rolled_out(Corridor(0, 12), beta=1.0)
    assert [len(segment.actions) for segment in sigma] == [1] * 12
    assert all(segment.terminated for segment in sigma[:-1])
    assert not sigma[-1].terminated  # the episode ended it


def test_a_segment_ends_where_its_termination_fires_and_the_next_begins_there() -> None:
    def at_a_door(observation: np.ndarray) -> float:
        return float(np.argmax(observation[:13]) % 4 == 0)

    sigma = rolled_out(Corridor(0, 11), beta=at_a_door)
    assert [[state.view for state in segment.states] for segment in sigma] == [
        [0, 1, 2, 3, 4],
        [4, 5, 6, 7, 8],
        [8, 9, 10, 11],
    ]
    assert [segment.terminated for segment in sigma] == [True, True, False]


def test_a_segment_is_at_most_as_long_as_the_horizon() -> None:
    sigma = rolled_out(Corridor(0, 12), beta=0.0)
    assert [len(segment.actions) for segment in sigma] == [6, 6]
    assert [segment.terminated for segment in sigma] == [False, False]


def test_the_threshold_has_to_be_passed_not_met() -> None:
    assert [len(segment.actions) for segment in rolled_out(Corridor(0, 12), beta=0.75)] == [6, 6]
    rollout = corridor_rollout(Corridor(0, 12), SelectionSpec(0, termination_threshold=0.75))
    assert [len(segment.actions) for segment in run(rollout, corridor_policies(beta=0.75))] == [6, 6]


def test_an_episode_has_at_most_as_many_subgoals_as_the_horizon() -> None:
    sigma = run(corridor_rollout(Corridor(11, 0), h_hi=3), corridor_policies(0.0))  # walks east, away from the target
    assert [len(segment.actions) for segment in sigma] == [6, 6, 6]


def test_an_episode_ends_with_the_environments_truncation() -> None:
    sigma = rolled_out(Corridor(11, 0), beta=0.0)  # walks east, away from the target
    assert n_steps(sigma) == 30
    assert all(segment.states[-1] is following.states[0] for segment, following in pairwise(sigma))


def contents(trajectories: list[Trajectory]) -> list[Any]:
    """All there is to know of trajectories."""
    return [
        (s.subgoal, s.actions, s.terminated, [(x.view, x.observation.tobytes()) for x in s.states])
        for sigma in trajectories
        for s in sigma
    ]


@pytest.mark.parametrize(
    "choosing", [GREEDY, TINY.rollouts.choosing, SelectionSpec(temperature=1.0, termination_threshold=0.4)]
)
@pytest.mark.parametrize("flat", [False, True])
def test_rollouts_in_step_are_the_same_as_one_by_one(choosing: SelectionSpec, flat: bool) -> None:
    domain = MazeDomain()
    preset = TINY.with_values(choosing=choosing)
    learner = Learner(domain, preset, seed=3, levels=Levels(flat=flat), threads=1)
    mazes = maze_set("random")[0][:24]

    def rollouts() -> list[Any]:
        return [learner.rollout(Simulator(domain), maze, TEST, i) for i, maze in enumerate(mazes)]

    together = run_all(rollouts(), learner.policies)
    apart = [run(rollout, learner.policies) for rollout in rollouts()]
    assert contents(together) == contents(apart)
    assert len({segment.subgoal for sigma in together for segment in sigma}) == (1 if flat else 5) or choosing == GREEDY


@examples
@given(st.integers(0, 10_000))
def test_there_are_no_segments_without_a_step_and_none_longer_than_the_horizon(seed: int) -> None:
    rng = np.random.default_rng(seed)
    domain = CorridorDomain()

    def saying_anything(n: int) -> Callable[[np.ndarray], Outputs]:
        return lambda seen: Outputs(rng.normal(size=(len(seen), n)).astype(np.float32), rng.random(len(seen)))

    policies: Any = {META: saying_anything(3), **{pi(subgoal): saying_anything(2) for subgoal in (WEST, EAST, TARGET)}}
    sigma = run(corridor_rollout(Corridor(5, 11), SelectionSpec(1.0, 0.5), seed), policies)
    assert all(1 <= len(segment.actions) <= domain.horizons.lo for segment in sigma)
    assert all(len(segment.states) == len(segment.actions) + 1 for segment in sigma)
    assert n_steps(sigma) <= domain.horizons.full
    assert domain.horizons == Horizons(lo=6, hi=30, full=30)


def test_a_flat_rollout_is_one_segment_without_a_subgoal_up_to_the_end_of_the_episode() -> None:
    learner = Learner(CorridorDomain(), TINY, seed=0, levels=Levels(flat=True), threads=1)
    policies: Any = {FLAT: Fixed(1, 2)}
    (segment,) = run(learner.rollout(learner.make_simulator(), Corridor(2, 12), TRAIN, 0), policies)
    assert (segment.subgoal, segment.actions, segment.terminated) == (None, (1,) * 10, False)


def test_networks_see_batches_when_rollouts_run_in_step() -> None:
    policies = corridor_policies(0.0)
    run_all([corridor_rollout(Corridor(0, 12)) for _ in range(3)], policies)
    assert set(policies[pi(EAST)].batches) == {3}


def test_a_rollout_that_consults_a_policy_that_is_not_given_is_refused() -> None:
    with pytest.raises(KeyError, match="consult policies that are not given"):
        run(corridor_rollout(Corridor(0, 12)), {META: Fixed(EAST, 3)})


def test_draws_depend_on_seed_stream_and_episode_alone() -> None:
    learner = Learner(CorridorDomain(), TINY, seed=0, threads=1)

    def actions(stream: int, episode: int) -> list[tuple[int, ...]]:
        hot = SelectionSpec(temperature=10.0, termination_threshold=2.0)
        learner.preset = TINY.with_values(choosing=hot)
        sigma = run(learner.rollout(Simulator(learner.domain), Corridor(5, 12), stream, episode), learner.policies)
        return [segment.actions for segment in sigma]

    assert actions(TRAIN, 4) == actions(TRAIN, 4)
    assert actions(TRAIN, 4) != actions(TRAIN, 5)
    assert actions(TRAIN, 4) != actions(TEST, 4)


def test_choices_are_drawn_from_the_softmax_at_the_temperature() -> None:
    logits, rng = np.array([0.0, 0.1, 0.2], np.float32), np.random.default_rng(0)
    drawn = (
        np.bincount([choose(logits, SelectionSpec(temperature=0.1), rng) for _ in range(4_000)], minlength=3) / 4_000
    )
    np.testing.assert_allclose(drawn, np.exp([0, 1, 2]) / np.exp([0, 1, 2]).sum(), atol=0.03)
    assert choose(logits, GREEDY, rng) == 2


def test_with_given_terminations_a_subgoal_ends_where_the_domain_says_and_fails_with_its_horizon() -> None:
    behavior = Behavior(GREEDY, np.random.default_rng(0), h_hi=2, h_lo=H_LO, terminations_given=True)
    sigma = run(
        hierarchical_rollout(Simulator(CorridorDomain()), Corridor(1, 12), behavior),
        corridor_policies(beta=1.0),  # which would end every segment at once
    )
    assert [(len(s.actions), s.outcome, s.terminated) for s in sigma] == [(3, "reached", True), (4, "reached", True)]
    backward: Any = {META: Fixed(WEST, 3), pi(WEST): Fixed(1, 2)}  # walks east, toward no aim of the subgoal west
    (first, *_) = run(hierarchical_rollout(Simulator(CorridorDomain()), Corridor(1, 12), behavior), backward)
    assert (len(first.actions), first.outcome) == (6, "failed")


@pytest.mark.parametrize(
    ("whole", "actions", "outcomes"),
    [(True, [(0, 0)], ["failed"]), (False, [(0, 0, 1, 1, 1, 1)] * 2, ["reached", "failed"])],
)
def test_an_attempt_can_begin_with_given_actions_and_if_it_fails_the_rollout_ends(
    whole: bool, actions: list[tuple[int, ...]], outcomes: list[str]
) -> None:
    policies, asked = corridor_policies(beta=0.0), []
    behavior = Behavior(
        GREEDY,
        np.random.default_rng(0),
        h_hi=3,
        h_lo=H_LO,
        terminations_given=True,
        lead=lambda key, _: asked.append(key) or Lead((0, 0), whole),
    )
    sigma = run(hierarchical_rollout(Simulator(CorridorDomain()), Corridor(6, 12), behavior), policies)
    assert [segment.actions for segment in sigma] == actions
    assert [segment.outcome for segment in sigma] == outcomes
    assert all(segment.led for segment in sigma)
    assert asked == [pi(EAST)] * len(actions)
    given = 2 * len(actions)  # for which the policy is not asked
    assert len(policies[pi(EAST)].batches) == sum(map(len, actions)) - given


@pytest.mark.parametrize(
    ("place", "chosen"),
    [(lambda _: "the same", [WEST, EAST, WEST, EAST, TARGET]), (lambda _: object(), [WEST] * 5)],
)
def test_a_subgoal_that_was_chosen_in_the_same_place_before_is_less_likely(place: Any, chosen: list[int]) -> None:
    domain = CorridorDomain()
    logits = np.array([[1.0, 0.8, 0.1]], np.float32)  # west, east, target
    policies: Any = {META: lambda _: Outputs(logits, np.zeros(1, np.float32))}
    policies |= {pi(g): lambda _: Outputs(np.zeros((1, 2), np.float32), np.ones(1, np.float32)) for g in range(3)}
    behavior = Behavior(GREEDY, np.random.default_rng(0), h_hi=5, h_lo=H_LO, repeat_penalty=0.5, place=place)
    sigma = run(hierarchical_rollout(Simulator(domain), Corridor(11, 0), behavior), policies)
    assert [segment.subgoal for segment in sigma] == chosen


@pytest.mark.parametrize(("penalty", "cells"), [(0.0, [6, 5, 6, 5, 6, 5, 6]), (0.5, [6, 5, 6, 7, 6, 5, 4])])
def test_a_choice_that_led_back_to_an_equal_observation_is_less_likely(penalty: float, cells: list[int]) -> None:
    def back_and_forth(observations: np.ndarray) -> Outputs:
        goes_east = observations.argmax() < 6  # the first part of an observation is the agent's cell
        return Outputs(np.array([[0, 0.2] if goes_east else [0.2, 0]], np.float32), np.zeros(1, np.float32))

    behavior = Behavior(GREEDY, np.random.default_rng(0), h_hi=5, h_lo=H_LO, loop_penalty=penalty)
    (segment,) = run(flat_rollout(Simulator(CorridorDomain()), Corridor(6, 0), behavior), {FLAT: back_and_forth})
    assert [state.view for state in segment.states[:7]] == cells


@pytest.mark.parametrize(("penalty", "chosen"), [(0.0, [WEST] * 5), (0.5, [WEST, EAST, WEST, TARGET, EAST])])
def test_a_subgoal_that_led_back_to_an_equal_observation_is_less_likely(penalty: float, chosen: list[int]) -> None:
    logits = np.array([[1.0, 0.8, 0.6]], np.float32)  # west, east, target
    policies: Any = {META: lambda _: Outputs(logits, np.zeros(1, np.float32))}
    steps = {WEST: [1.0, 0.0], EAST: [0.0, 1.0], TARGET: [0.0, 1.0]}  # west at the wall leads nowhere
    policies |= {
        pi(g): lambda _, g=g: Outputs(np.array([steps[g]], np.float32), np.ones(1, np.float32)) for g in range(3)
    }
    behavior = Behavior(GREEDY, np.random.default_rng(0), h_hi=5, h_lo=H_LO, loop_penalty=penalty)
    sigma = run(hierarchical_rollout(Simulator(CorridorDomain()), Corridor(0, 11), behavior), policies)
    assert [segment.subgoal for segment in sigma] == chosen
