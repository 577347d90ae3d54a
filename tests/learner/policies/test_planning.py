"""A network that plans: what costs it is given, or learns, become the shortest ways over a grid of places."""

from dataclasses import replace

import numpy as np
import torch
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tests.learner.kit import STEPS, examples, mazes, solved
from torch.nn import functional

from waypost.domains import Grid
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import MazeEnv
from waypost_learner.domains.maze.maze import Maze, moved
from waypost_learner.policies.datasets import Dataset, Row
from waypost_learner.policies.imitation import Policy, TrainSpec
from waypost_learner.policies.networks import NetworkSpec, build_network
from waypost_learner.policies.planning import PlanningNet, PlanningSpec, iterate
from waypost_learner.policies.views import policy_view
from waypost_learner.presets import find_preset
from waypost_learner.rollout.policy_keys import PolicyKey

SIDE = 7
GRID = Grid(patch=3, stride=1, moves=STEPS)
SPEC = PlanningSpec(GRID, horizon=SIDE**2, features=5)
WALL, TARGET = 0, 1
FAR = 48  # steps: more than 80, which float32 cannot tell from more


def net(outputs: int = 4, spec: PlanningSpec = SPEC, channels: int = 2) -> PlanningNet:
    network = build_network((channels, SIDE + 2, SIDE + 2), outputs, spec, 0.5, torch.Generator().manual_seed(0))
    assert isinstance(network, PlanningNet)
    return network.eval().requires_grad_(False)


def with_known_costs(
    outputs: int = 4,
    spec: PlanningSpec = SPEC,
    channels: int = 2,
    wall: int = WALL,
    target: int = TARGET,
    sign: int = 1,  # of the target in its channel
) -> PlanningNet:
    """A network that is told: a step costs 5; into a wall, and ending elsewhere than on the target, 600."""
    network = net(outputs, spec, channels)
    for parameter in network.parameters():
        parameter.zero_()
    for feature, (row, column) in enumerate(STEPS):
        network.places.weight[feature, wall, 1 + row, 1 + column] = 1
        network.costs.weight[feature, feature] = 595
    network.places.weight[4, target, 1, 1] = sign
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


@examples
@given(mazes(), st.data())
def test_a_flat_policy_plans_over_a_whole_maze_from_where_the_agent_is(maze: Maze, data: st.DataObject) -> None:
    view = policy_view(MazeDomain(), find_preset("lean").use, NetworkSpec(), PolicyKey("flat"))
    assert isinstance(view.network, PlanningSpec)
    steps = solved(maze)
    near = sorted(cell for cell in steps if 0 < steps[cell] <= FAR)
    assume(near)
    cell = data.draw(st.sampled_from(near))
    observation, _ = MazeEnv().reset(options={"instance": Maze(maze.lava, cell, maze.goal)})
    network = with_known_costs(4, replace(view.network, features=5), channels=3, wall=1, target=2, sign=-1)
    best = int(network(torch.from_numpy(view.view.observe(observation)[None]))[0].argmax())
    assert steps[moved(cell, best)] == steps[cell] - 1


@examples
@given(st.integers(1, 3), st.integers(3, 6), st.integers(3, 6), st.integers(1, 5), st.integers(0, 99))
def test_its_steps_and_their_gradients_are_those_of_the_formula(
    batch: int, rows: int, columns: int, steps: int, seed: int
) -> None:
    rng, moves = torch.Generator().manual_seed(seed), [*STEPS, (1, 1), (0, 0)]
    inside = functional.pad(torch.ones(rows - 2, columns - 2, dtype=torch.float64), (1, 1, 1, 1))
    moving = torch.rand(batch, len(moves), rows, columns, dtype=torch.float64, generator=rng) * inside
    ending = torch.rand(batch, rows, columns, dtype=torch.float64, generator=rng) * inside
    wanted = torch.rand(batch, rows, columns, dtype=torch.float64, generator=rng)

    def formula(moving: torch.Tensor, ending: torch.Tensor) -> torch.Tensor:
        reached = ending
        for _ in range(steps):
            ahead = [reached.roll((-down, -right), (1, 2)) for down, right in moves]
            reached = ending + (moving * torch.stack(ahead, 1)).sum(1)
        return reached

    def fast(moving: torch.Tensor, ending: torch.Tensor) -> torch.Tensor:
        return iterate(moving, ending, [down * columns + right for down, right in moves], steps)

    found = []
    for way in (formula, fast):
        inputs = [moving.clone().requires_grad_(), ending.clone().requires_grad_()]
        reached = way(*inputs)
        (reached * wanted).sum().backward()
        found.append([reached.detach(), *(one.grad * inside for one in inputs if one.grad is not None)])
    for one, other in zip(*found, strict=True):
        torch.testing.assert_close(one, other)
    torch.testing.assert_close(fast(moving, ending), found[0][0])


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
