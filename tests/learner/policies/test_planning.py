"""A network that plans: what costs it is given, or learns, become the shortest ways over a grid of places."""

from dataclasses import replace

import numpy as np
import torch
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.learner.kit import STEPS, examples

from waypost.domains import Grid
from waypost_learner.policies.datasets import Dataset, Row
from waypost_learner.policies.imitation import Policy, TrainSpec
from waypost_learner.policies.networks import PlanningNet, PlanningSpec, build_network

SIDE = 7
GRID = Grid(patch=3, stride=1, moves=STEPS)
SPEC = PlanningSpec(GRID, horizon=SIDE**2, features=5)
WALL, TARGET = 0, 1
FAR = 48  # steps: more than 80, which float32 cannot tell from more


def net(outputs: int = 4, spec: PlanningSpec = SPEC) -> PlanningNet:
    network = build_network((2, SIDE + 2, SIDE + 2), outputs, spec, 0.5, torch.Generator().manual_seed(0))
    assert isinstance(network, PlanningNet)
    return network.eval().requires_grad_(False)


def with_known_costs(outputs: int = 4) -> PlanningNet:
    """A network that is told: a step costs 5; into a wall, and ending elsewhere than on the target, 600."""
    network = net(outputs)
    for parameter in network.parameters():
        parameter.zero_()
    for feature, (row, column) in enumerate(STEPS):
        network.places.weight[feature, WALL, 1 + row, 1 + column] = 1
        network.costs.weight[feature, feature] = 595
    network.places.weight[4, TARGET, 1, 1] = 1
    network.costs.weight[4, 4] = -600
    assert network.costs.bias is not None
    network.costs.bias[:4], network.costs.bias[4] = 5, 600
    return network


@st.composite
def pictures(draw: st.DrawFn) -> np.ndarray:
    """Walls with a target somewhere: float32[2, 9, 9], a frame of walls around."""
    picture = np.ones((2, SIDE + 2, SIDE + 2), np.float32)
    picture[TARGET] = 0
    inside = picture[WALL, 1:-1, 1:-1]
    inside[:] = draw(arrays(np.bool_, (SIDE, SIDE), fill=st.just(0)))
    row, column = draw(st.tuples(*[st.integers(1, SIDE)] * 2))
    middle = SIDE // 2 + 1
    picture[WALL, middle, middle] = picture[WALL, row, column] = 0
    picture[TARGET, row, column] = 1
    return picture


def steps_to_target(picture: np.ndarray) -> np.ndarray:
    """Steps from each cell, by value iteration; infinite where no way leads."""
    steps = np.where(picture[TARGET] == 1, 0.0, np.inf)
    for _ in range(SIDE**2):
        around = [np.roll(steps, (-row, -column), (0, 1)) for row, column in STEPS]
        steps = np.where(picture[WALL] == 1, np.inf, np.minimum(steps, 1 + np.min(around, axis=0)))
    return steps


@examples
@given(pictures())
def test_with_the_right_costs_its_best_choice_is_the_first_step_of_a_shortest_way(picture: np.ndarray) -> None:
    steps, middle = steps_to_target(picture), SIDE // 2 + 1
    assume(0 < steps[middle, middle] <= FAR)
    best = int(with_known_costs()(torch.from_numpy(picture[None]))[0].argmax())
    row, column = STEPS[best]
    assert steps[middle + row, middle + column] == steps[middle, middle] - 1


@examples
@given(pictures())
def test_one_output_more_says_whether_to_end_here(picture: np.ndarray) -> None:
    middle = SIDE // 2 + 1
    there = steps_to_target(picture)[middle, middle]
    assume(there <= FAR)
    ends = float(with_known_costs(5)(torch.from_numpy(picture[None]))[0, -1])
    assert (ends > 0) == (
        picture[TARGET, middle, middle] == 1 or not np.isfinite(steps_to_target(picture)[middle, middle])
    )


def test_it_sees_as_far_as_its_horizon() -> None:
    picture = np.zeros((2, SIDE + 2, SIDE + 2), np.float32)
    picture[TARGET, 1, 1 + SIDE // 2] = 1  # three steps up
    network = with_known_costs()
    values = []
    for horizon in (2, 3):
        network.horizon = horizon
        values.append(network(torch.from_numpy(picture[None]))[0])
    near, far = values
    assert far[0] > near[0] + 5
    assert int(far.argmax()) == 0


def test_ending_is_a_choice_where_the_grid_has_it_so() -> None:
    spec = replace(SPEC, grid=replace(GRID, moves=(*STEPS, None)))
    assert net(5, spec)(torch.zeros(3, 2, SIDE + 2, SIDE + 2)).shape == (3, 5)
    assert not net(5, spec).terminates
    assert net(5).terminates


def test_it_learns_where_to_go_from_choices_alone() -> None:
    rng = np.random.default_rng(0)
    rows = []
    while len(rows) < 300:
        picture = np.zeros((2, SIDE + 2, SIDE + 2), np.float32)
        picture[WALL] = rng.random((SIDE + 2, SIDE + 2)) < 0.25
        row, column, middle = *rng.integers(1, SIDE + 1, 2), SIDE // 2 + 1
        picture[WALL, middle, middle] = picture[WALL, row, column] = 0
        picture[TARGET, row, column] = 1
        steps = steps_to_target(picture)
        if 0 < steps[middle, middle] < np.inf:
            good = [n for n, (r, c) in enumerate(STEPS) if steps[middle + r, middle + c] < steps[middle, middle]]
            rows.append(Row(picture, good[0]))
    data, unseen = Dataset((2, SIDE + 2, SIDE + 2)), rows[200:]
    data.append(rows[:200])
    train = TrainSpec(learning_rate=1e-2, least=64 * 400, most=64 * 400, batch=64, bf16=False)
    policy = Policy((2, SIDE + 2, SIDE + 2), 4, False, replace(SPEC, horizon=12, features=16), train, seed=0)
    policy.train(data)
    right = policy(np.stack([row.observation for row in unseen])).logits.argmax(1) == [row.choice for row in unseen]
    assert right.mean() > 0.7  # of several shortest ways one is labeled; a guess would be right in a quarter
