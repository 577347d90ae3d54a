"""A learner: which policies it has, what each is given to see, and what it learns from."""

from collections import deque
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import TINY, TINY_LEAN, drawn_mazes, examples, segment

from waypost.trajectory import Observation, Segment, State, Trajectory, n_steps
from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.corridor import Corridor, CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.views import LO_VIEW
from waypost_learner.domains.montezuma.domain import MontezumaDomain
from waypost_learner.policies.datasets import UNLABELED
from waypost_learner.policies.exploration import ExplorationSpec
from waypost_learner.policies.imitation import Policy, TrainSpec
from waypost_learner.policies.labels import Labels, LoLabels
from waypost_learner.policies.levels import Levels
from waypost_learner.policies.networks import ConvNet, DenseNet
from waypost_learner.policies.planning import PlanningNet
from waypost_learner.presets import find_preset
from waypost_learner.rollout.policy_keys import META, pi
from waypost_learner.rollout.rollout import Outputs, run
from waypost_learner.rollout.streams import TEST, TRAIN
from waypost_learner.runs.missing_parts import missing_parts

maze = MazeDomain()


def learned(domain: Any = maze, **values: Any) -> Learner:
    return Learner(domain, TINY_LEAN.with_values(**values), seed=0, threads=1)


def observations(instance: Any) -> np.ndarray:
    """What is seen on a way through a maze."""
    learner = Learner(maze, TINY, seed=0, threads=1)
    sigma = learner.roll_out(learner.start(instance, 0))
    return np.stack([state.observation for segment in sigma for state in segment.states])


@examples
@given(drawn_mazes(), st.integers(1, 3))
def test_a_tied_policy_acts_as_the_other_does_in_the_turned_maze(instance: Any, subgoal: int) -> None:
    learner = learned()
    assert set(learner.imitators) == {META, pi(0), pi(4)}
    north = learner.imitators[pi(0)]
    (symmetry, *_) = [one for one in maze.symmetries if one.subgoals[subgoal] == 0]
    seen = observations(instance)
    turned = north(np.stack([LO_VIEW.observe(symmetry.observe(one)) for one in seen]))
    found = learner.policies[pi(subgoal)](seen)
    np.testing.assert_array_equal(found.termination, turned.termination)
    for action in range(4):
        np.testing.assert_array_equal(found.logits[:, action], turned.logits[:, symmetry.actions[action]])


def test_what_is_labeled_of_tied_policies_is_learned_by_the_one_they_are() -> None:
    learner = learned()
    state = learner.start(maze.instances("random").train[0], 0).state
    labels = Labels()
    labels.append_lo(Segment(3, (state, state), (0,), terminated=False), LoLabels((1,), (False, False)))
    learner.learn(labels)
    assert {key: len(data) for key, data in learner.data.items()} == {
        META: 0,
        pi(0): 4,
        pi(4): 0,
    }  # two rows, east mirrored


def test_views_and_planning_are_for_domains_that_tell_of_their_structure() -> None:
    assert all(isinstance(policy.network, PlanningNet) for policy in learned().imitators.values())
    assert all(
        isinstance(policy.network, ConvNet)
        for policy in learned(planning=None).imitators.values()
        if policy.n_choices == 5
    )
    assert all(isinstance(policy.network, ConvNet) for policy in learned(views=False, planning=None).imitators.values())
    corridor = learned(CorridorDomain())
    assert all(isinstance(policy.network, DenseNet) for policy in corridor.imitators.values())
    assert set(corridor.imitators) == {META, pi(0), pi(2)}  # west and east are one


@pytest.mark.parametrize("relabeling", [True, False])
def test_a_preset_decides_whether_labels_are_learned_from_as_labels_of_other_tasks(relabeling: bool) -> None:
    learner = learned(relabeling=relabeling, symmetries=False, tied=False)
    sigma = learner.roll_out(learner.start(maze.instances("random").train[0], 0))
    labels = Labels()
    labels.append_hi(sigma, [segment.subgoal or 0 for segment in sigma])
    learner.learn(labels)
    assert (len(learner.data[META]) > len(sigma)) == relabeling


@pytest.mark.parametrize("relabeling", [True, False])
def test_a_preset_decides_whether_demonstrations_are_learned_from_as_those_of_other_tasks(relabeling: bool) -> None:
    learner = learned(relabeling=relabeling, symmetries=False, tied=False)
    s = learner.start(maze.instances("random").train[0], 0)
    go_to_target, down = maze.subgoals.index("go_to_target"), maze.actions.index("down")
    demonstration = (Segment(go_to_target, (s.state, s.simulator.step(down)), (down,), terminated=True),)
    labels = Labels()
    labels.append_demonstration(demonstration)
    learner.learn(labels)
    there, back = [(down, UNLABELED), (UNLABELED, 1)], [(maze.actions.index("up"), UNLABELED), (UNLABELED, 1)]
    learned_from = learner.data[pi(go_to_target)]
    _, labels_of_rows = learned_from[range(len(learned_from))]
    assert [(choice, ends) for choice, ends, _ in labels_of_rows.tolist()] == (
        there + there + back if relabeling else there
    )


def test_what_acts_is_the_average_of_what_was_learned() -> None:
    spec = TrainSpec(learning_rate=1e-2, batch=8, least=80, most=80, averaging=0.9, bf16=False)
    learner = Learner(CorridorDomain(), TINY.with_values(train_hi=spec), seed=0, levels=Levels(), threads=1)
    mu = learner.imitators[META]
    assert isinstance(mu, Policy)
    average: list[torch.Tensor] = []

    def follow(*_: Any) -> None:
        now = [parameter.detach().clone() for parameter in mu.network.parameters()]
        average[:] = [0.9 * a + 0.1 * b for a, b in zip(average, now, strict=True)] if average else now

    mu.optimizer.register_step_post_hook(follow)
    labels = Labels()
    sigma = learner.roll_out(learner.start(CorridorDomain().instances("random").train[0], 0))
    labels.append_hi(sigma, [0 for _ in sigma])
    learner.learn(labels)
    for acting, expected, last in zip(mu.acting.parameters(), average, mu.network.parameters(), strict=True):
        torch.testing.assert_close(acting, expected)
        assert not torch.equal(acting, last)


@pytest.mark.parametrize("levels", [Levels(), Levels(flat=True), Levels(q_lo=True)])
def test_only_policies_that_imitate_actions_see_the_centered_view(levels: Levels) -> None:
    domain = MontezumaDomain()
    learner = Learner(domain, find_preset("lean", domain="montezuma"), seed=0, levels=levels, threads=1)
    for key, view in learner.views.items():
        sees_center = key != META and not levels.q_lo
        assert view.view is (domain.centered_view if sees_center else domain.hi_view)
    corridor = Learner(CorridorDomain(), TINY.with_values(centered=True, crop=True), seed=0, threads=1)
    assert missing_parts(corridor) == {
        "centered": "No view has the agent in the middle.",
        "crop": "Subpolicies see as much as mu.",
    }


def test_the_segment_that_is_asked_about_is_drawn_by_the_seed_and_the_draw_alone() -> None:
    sigma = tuple(segment(0) for _ in range(4))

    def drawn(seed: int) -> list[int]:
        learner = Learner(CorridorDomain(), TINY, seed, threads=1)
        instance = CorridorDomain().instances("random").train[0]
        found = []
        for draw in range(60):
            found.append(learner.draw_one(learner.start(instance, draw), sigma))
        return found

    assert drawn(0) == drawn(0) != drawn(1)
    assert all(5 <= drawn(0).count(h) <= 25 for h in range(4))


def contents(sigma: Trajectory) -> list[Any]:
    """All there is to know of a trajectory."""
    return [(s.subgoal, s.actions, s.terminated, [x.observation.tobytes() for x in s.states]) for s in sigma]


@pytest.mark.parametrize("levels", [Levels(), Levels(flat=True)])
def test_a_rollout_is_fixed_by_its_start_state_alone_whatever_was_started_before(levels: Levels) -> None:
    instances = CorridorDomain().instances("random").train

    def rolled_out(*starts: tuple[int, int]) -> list[list[Any]]:
        """The rollouts from start states, given by instance and draw, which are all made before the first rollout."""
        learner = Learner(CorridorDomain(), TINY, seed=0, levels=levels, threads=1)
        return [contents(learner.roll_out(s)) for s in [learner.start(instances[i], draw) for i, draw in starts]]

    ((one,), (other,), (redrawn,)) = rolled_out((0, 7)), rolled_out((1, 8)), rolled_out((0, 8))
    assert rolled_out((1, 8), (0, 7)) == [other, one]
    assert rolled_out((0, 7), (0, 8), (0, 7)) == [one, redrawn, one]
    assert one != other
    assert one != redrawn


@pytest.mark.parametrize("levels", [Levels(), Levels(flat=True)])
def test_rollouts_that_step_together_are_the_same_and_networks_evaluate_their_states_in_batches(
    levels: Levels, monkeypatch: pytest.MonkeyPatch
) -> None:
    instances = CorridorDomain().instances("random").train
    learner = Learner(CorridorDomain(), TINY, seed=0, levels=levels, threads=1)
    sizes: list[int] = []
    evaluate = Policy.__call__

    def counted(policy: Policy, observations: Observation) -> Outputs:
        sizes.append(len(observations))
        return evaluate(policy, observations)

    monkeypatch.setattr(Policy, "__call__", counted)
    starts = [learner.start(instance, draw) for draw, instance in enumerate(instances[:4])]
    alone = [contents(learner.roll_out(s)) for s in starts]
    assert max(sizes) == 1
    learner.roll_out_together(starts)
    assert [contents(learner.roll_out(s)) for s in reversed(starts)] == alone[::-1]
    assert max(sizes) == len(starts)


def test_the_same_start_state_is_rolled_out_again_from_its_beginning() -> None:
    learner = Learner(CorridorDomain(), TINY, seed=0, threads=1)
    s = learner.start(CorridorDomain().instances("random").train[0], 3)
    assert contents(learner.roll_out(s)) == contents(learner.roll_out(s))
    assert s.simulator.steps == n_steps(learner.roll_out(s))


class PlacedCorridor(CorridorDomain):
    """The corridor, in which a state's place is its cell."""

    def place(self, state: Any) -> int:
        return int(state)


def placed(*cells: int) -> Trajectory:
    """Segments that began in these cells."""
    return tuple(replace(segment(0), states=(State(np.zeros(2), cell), State(np.ones(2), cell + 1))) for cell in cells)


def test_a_place_is_visited_first_by_one_segment_and_without_places_every_segment_is_a_first_visit() -> None:
    sigma = placed(3, 1, 3, 2, 1)
    assert list(Learner(PlacedCorridor(), TINY, seed=0, threads=1).first_visits(sigma)) == [0, 1, 3]
    assert list(Learner(CorridorDomain(), TINY, seed=0, threads=1).first_visits(sigma)) == [0, 1, 2, 3, 4]


def test_tests_can_take_more_subgoals_than_training() -> None:
    def longest(**values: int) -> tuple[int, int]:
        learner = Learner(CorridorDomain(), TINY.with_values(h_lo=1, **values), seed=0, threads=1)
        far = Corridor(11, 0)
        rollouts = [learner.rollout(learner.make_simulator(), far, stream, 0) for stream in (TRAIN, TEST)]
        trained, tested = (len(run(one, learner.policies)) for one in rollouts)
        return trained, tested

    assert longest(h_hi=2) == (2, 2)
    assert longest(h_hi=2, h_hi_tests=4) == (2, 4)


def exploring(domain: Any) -> Learner:
    preset = TINY.with_values(dqn=replace(TINY.training.dqn, exploration=ExplorationSpec(wander=4)))
    return Learner(domain, preset, seed=0, levels=Levels(q_lo=True), threads=1)


def attempted(actions: tuple[int, ...], led: bool) -> Segment:
    """An attempt at `east` that begins in cell 1, where its aim is cell 4."""
    states = [1 + sum(1 if one else -1 for one in actions[:step]) for step in range(len(actions) + 1)]
    outcome = "reached" if states[-1] == 4 else "failed"
    observed = tuple(State(np.zeros(CorridorDomain.observation_shape, np.float32), cell) for cell in states)
    return Segment(1, observed, actions, terminated=True, outcome=outcome, led=led)


def learn(learner: Learner, segment: Segment) -> None:
    labels = Labels()
    labels.append_experience(pi(1), (segment,))
    learner.learn(labels)


def test_training_explores_and_tests_do_not() -> None:
    learner = exploring(PlacedCorridor())
    instance = learner.domain.instances("random").train[0]
    trained = learner.roll_out(learner.start(instance, 0))
    assert all(segment.led and len(segment.actions) <= 4 for segment in trained)
    tested = run(learner.rollout(learner.make_simulator(), instance, TEST, 0), learner.policies)
    assert not any(segment.led for segment in tested)


def test_only_what_the_policy_did_alone_counts_as_an_attempt_and_the_best_successes_are_demonstrations() -> None:
    learner = exploring(PlacedCorridor())
    q, replay = learner.q[pi(1)], learner.q[pi(1)].replay
    learn(learner, attempted((1, 0, 0), led=True))
    assert (q.attempts, q.succeeded, replay.tensors()["demonstrated"].tolist()) == (deque(), False, [False] * 3)
    learn(learner, attempted((1, 1, 1), led=True))
    assert (q.attempts, q.succeeded, replay.tensors()["demonstrated"].tolist()[3:]) == (deque(), True, [True] * 3)
    learn(learner, attempted((1, 0, 1, 1, 1), led=False))
    assert list(q.attempts) == [True]
    assert replay.tensors()["demonstrated"].tolist()[6:] == [False, False, True, True, True]  # not the detour
    assert learner.explorations[pi(1)].known["1"].successes == [(1, 1, 1), (1, 0, 1, 1, 1)]


def test_a_domain_without_places_is_not_explored_and_the_run_says_so() -> None:
    learner = exploring(CorridorDomain())
    assert learner.explorations == {}
    assert missing_parts(learner)["places to explore"] == "Attempts at subgoals do not explore."
    assert "places to explore" not in missing_parts(exploring(PlacedCorridor()))
