"""Labels stay right when the picture is turned or mirrored: the expert says the same of the changed maze."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import TINY, drawn_mazes, examples, mazes, random_labels, reachable_cells

from waypost.domains import Domain, Symmetry
from waypost.trajectory import Segment, State
from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.corridor import CELLS, Corridor, CorridorDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import MazeEnv
from waypost_learner.domains.maze.maze import Cell, Maze
from waypost_learner.domains.maze.symmetries import symmetries
from waypost_learner.policies.datasets import UNLABELED, Row
from waypost_learner.policies.labels import Labels, transformed_experience, transformed_rows
from waypost_learner.policies.levels import Levels
from waypost_learner.rollout.experience import Experience, Transition
from waypost_learner.rollout.policy_keys import META, pi

oracle = MazeDomain().oracle


def seen(maze: Maze, cell: Cell) -> np.ndarray:
    """What the agent sees when it starts in a cell."""
    observation, _ = MazeEnv().reset(options={"instance": Maze(maze.lava, cell, maze.goal)})
    return observation


def changed(maze: Maze, symmetry: Symmetry) -> tuple[Maze, Callable[[Cell], Cell]]:
    """The changed maze, and where a cell is in it, both read off the changed picture."""
    picture = symmetry.observe(seen(maze, maze.start))

    def there(cell: Cell) -> Cell:
        (place,) = np.argwhere(symmetry.observe(seen(maze, cell))[0])
        return int(place[0]), int(place[1])

    (goal,) = np.argwhere(picture[2])
    return Maze(picture[1] == 1, there(maze.start), (int(goal[0]), int(goal[1]))), there


@examples
@given(mazes(), st.sampled_from(symmetries()), st.data())
def test_the_expert_says_the_same_of_the_changed_maze(maze: Maze, symmetry: Symmetry, data: st.DataObject) -> None:
    here = data.draw(st.sampled_from([cell for cell in reachable_cells(maze) if cell != maze.goal]))
    other, there = changed(maze, symmetry)
    view, changed_view, at = maze.to_json(), other.to_json(), list(there(here))
    good = oracle.good_subgoals(view, list(here))
    assert {symmetry.subgoals[g] for g in good} == set(oracle.good_subgoals(changed_view, at))
    for subgoal in range(5):
        actions = oracle.good_actions(view, list(here), list(here), subgoal)
        turned = oracle.good_actions(changed_view, at, at, symmetry.subgoals[subgoal])
        assert {symmetry.actions[a] for a in actions} == set(turned)


@examples
@given(drawn_mazes())
def test_the_seven_symmetries_and_the_picture_itself_are_eight_different_pictures(maze: Maze) -> None:
    picture = seen(maze, maze.start)
    pictures = {picture.tobytes()} | {symmetry.observe(picture).tobytes() for symmetry in symmetries()}
    assert len(pictures) == 8


@pytest.mark.parametrize("domain", [MazeDomain(), CorridorDomain()])
def test_every_symmetry_permutes_the_subgoals_and_the_actions(domain: Domain) -> None:
    for symmetry in domain.symmetries:
        assert sorted(symmetry.subgoals) == list(range(len(domain.subgoals)))
        assert sorted(symmetry.actions) == list(range(len(domain.actions)))


@examples
@given(st.integers(0, CELLS - 1), st.integers(0, CELLS - 1))
def test_the_corridors_expert_says_the_same_of_the_mirrored_corridor(cell: int, target: int) -> None:
    domain = CorridorDomain()
    for symmetry in domain.symmetries:
        env = domain.make_env()
        observation, _ = env.reset(options={"instance": Corridor(cell, target)})
        mirrored = symmetry.observe(observation)
        there = int(np.argmax(mirrored[:CELLS]))
        goal = there + int(np.argmax(mirrored[CELLS:])) - (CELLS - 1)
        here = domain.oracle.good_subgoals({"target": target}, cell)
        assert [symmetry.subgoals[g] for g in here] == list(domain.oracle.good_subgoals({"target": goal}, there))


def test_rows_in_a_symmetry_go_to_the_changed_subgoals_policy() -> None:
    quarter = symmetries()[0]  # counterclockwise: north becomes west
    observation = seen(Maze(np.zeros((17, 17), bool), (1, 3), (5, 5)), (1, 3))
    rows = {META: [Row(observation, 0)], pi(0): [Row(observation, 3, 1), Row(observation, UNLABELED, 0)]}
    turned = transformed_rows(rows, quarter)
    assert turned.keys() == {META, pi(2)}
    assert [row.choice for row in turned[META]] == [2]
    assert [(row.choice, row.termination) for row in turned[pi(2)]] == [(0, 1), (UNLABELED, 0)]
    assert np.argwhere(turned[pi(2)][0].observation[0]).tolist() == [[13, 1]]


def test_a_preset_decides_whether_a_learner_sees_its_labels_through_the_symmetries() -> None:
    labels = random_labels(0, (3, 17, 17), [META], n=1)
    for symmetric, rows in ((False, 1), (True, 8)):
        preset = TINY.with_values(symmetries=symmetric)
        learner = Learner(MazeDomain(), preset, seed=0, threads=1)
        learner.learn(labels)
        assert len(learner.data[META]) == rows


@examples
@given(st.sampled_from(MazeDomain().symmetries), st.integers(0, 3), st.integers(0, 3))
def test_experience_seen_through_a_symmetry_is_of_the_turned_subgoal_and_the_turned_action(
    symmetry: Symmetry, subgoal: int, action: int
) -> None:
    before, after = (np.random.default_rng(n).random((3, 17, 17)).astype(np.float32) for n in range(2))
    given_one = Experience((before, after), (Transition(0, action, 0.5, 1, 1),))
    key, experience = transformed_experience(pi(subgoal), given_one, symmetry)
    (seen,) = experience.transitions
    assert (key.subgoal, seen.choice) == (symmetry.subgoals[subgoal], symmetry.actions[action])
    assert (seen.reward, seen.steps) == (0.5, 1)
    assert (experience.observations[seen.state] == symmetry.observe(before)).all()
    assert (experience.observations[seen.next_state] == symmetry.observe(after)).all()


@pytest.mark.parametrize(("symmetric", "rows"), [(False, 1), (True, 8)])
def test_a_preset_decides_whether_q_functions_see_their_experience_through_the_symmetries(
    symmetric: bool, rows: int
) -> None:
    preset = TINY.with_values(dqn=replace(TINY.training.dqn, symmetries=symmetric))
    learner = Learner(MazeDomain(), preset, seed=0, levels=Levels(q_lo=True), threads=1)
    here = State(np.zeros((3, 17, 17), np.float32), None)
    labels = Labels()
    labels.append_experience(pi(0), (Segment(0, (here, here), (0,), terminated=False),))
    learner.learn(labels)
    assert sum(len(q.replay) for q in learner.q.values()) == rows
