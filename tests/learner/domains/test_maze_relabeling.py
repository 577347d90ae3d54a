"""What labels and demonstrations of a maze are taken to say of other tasks is right."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.learner.kit import drawn_mazes, examples, mazes, solved

from waypost.trajectory import Action, Segment, Subgoal, Trajectory
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import AGENT, TARGET, MazeEnv
from waypost_learner.domains.maze.maze import (
    GO_TO_TARGET,
    Cell,
    Maze,
    cell_of,
    closed_rooms,
    distances_from,
    moved,
    room_of,
    wall_beside,
)
from waypost_learner.domains.maze.relabeling import relabeled, relabeled_actions, retraced
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator

domain = MazeDomain()


def demonstration(maze: Maze) -> Trajectory:
    start = Simulator(domain).reset(maze).view
    answer = Translator(domain, maze).answer(OracleExpert(domain).demonstrate(domain.instance_view(maze), start))
    assert isinstance(answer, tuple)
    return tuple(segment for segment in answer if isinstance(segment, Segment))


def maze_in(picture: np.ndarray) -> Maze:
    """The maze that a picture shows, begun where the agent is."""
    here, target = (cell_of(np.argwhere(picture[k] == what)[0].tolist()) for k, what in ((0, AGENT), (2, TARGET)))
    return Maze(picture[1] == 1, here, target)


def is_good(picture: np.ndarray, subgoal: Subgoal) -> bool:
    """Whether the oracle finds a subgoal good in what a picture shows."""
    maze = maze_in(picture)
    return subgoal in domain.oracle.good_subgoals(maze.to_json(), list(maze.start))


def said_of_other_tasks(maze: Maze) -> list[tuple[np.ndarray, Subgoal]]:
    sigma = demonstration(maze)
    return list(relabeled(sigma, [segment.subgoal for segment in sigma if segment.subgoal is not None]))


@examples
@given(mazes())
def test_what_a_demonstration_says_of_other_tasks_is_right(maze: Maze) -> None:
    assert all(is_good(picture, subgoal) for picture, subgoal in said_of_other_tasks(maze))


@examples
@given(drawn_mazes())
def test_a_demonstration_says_what_is_right_from_each_of_its_places_to_each_other_one(maze: Maze) -> None:
    n_places = len({room_of(tuple(segment.start.view)) for segment in demonstration(maze)})
    assert len(said_of_other_tasks(maze)) >= n_places * (n_places - 1)


def is_good_action(picture: np.ndarray, action: Action) -> bool:
    """Whether an action in what a picture shows is the first of a shortest way to the target."""
    maze = maze_in(picture)
    distances = distances_from(maze.lava, maze.goal)
    return bool(distances[moved(maze.start, action)] == distances[maze.start] - 1)


@examples
@given(mazes())
def test_what_a_flat_demonstration_says_of_other_tasks_is_right(maze: Maze) -> None:
    sigma = demonstration(maze)
    cells = len({tuple(state.view) for segment in sigma for state in segment.states})
    said = list(relabeled_actions(sigma, [action for segment in sigma for action in segment.actions]))
    assert len(said) == cells * (cells - 1)
    assert all(is_good_action(picture, action) for picture, action in said)


def test_a_flat_label_that_the_learner_did_not_follow_ends_the_path_that_says_something_of_other_tasks() -> None:
    maze = Maze(closed_rooms(), (1, 1), (3, 3))
    down, right = (domain.actions.index(name) for name in ("down", "right"))
    tau = walked(maze, [down, right, right, down], None)
    said = list(relabeled_actions(tau, [down, down, right, down]))  # the first step to the right was no good one
    walks = {(maze_in(picture).start, maze_in(picture).goal) for picture, _ in said}
    first, second = [(1, 1), (2, 1)], [(2, 2), (2, 3), (3, 3)]
    assert walks == {(a, b) for path in (first, second) for a in path for b in path if a != b}


def test_a_way_around_lava_before_a_door_says_nothing_of_the_way_through_it() -> None:
    lava = closed_rooms()
    for door in [(3, 8), (4, 7), (4, 11), (4, 15), (5, 12), (7, 8)]:
        lava[door] = False
    lava[3, 11] = True  # before the door (4, 11): the shortest way into the room to the south leads around
    maze = Maze(lava, (1, 9), (1, 13))
    first, *_ = demonstration(maze)
    assert domain.subgoals[first.subgoal or 0] == "south"
    assert (7, 8) in [tuple(state.view) for state in first.states]
    assert all(is_good(picture, subgoal) for picture, subgoal in said_of_other_tasks(maze))


def goes_as_the_expert_would(segment: Segment) -> bool:
    """Whether the oracle takes the same way to the same subgoal, in what the segment shows, and ends there."""
    maze, subgoal = maze_in(segment.start.observation), segment.subgoal
    assert subgoal is not None
    view, views = maze.to_json(), [state.view for state in segment.states]
    return (
        subgoal in domain.oracle.good_subgoals(view, views[0])
        and all(
            action in domain.oracle.good_actions(view, views[0], here, subgoal)
            for action, here in zip(segment.actions, views, strict=False)
        )
        and [domain.oracle.reached(view, views[0], here, subgoal) for here in views[1:]]
        == [False] * (len(views) - 2) + [True]
    )


@examples
@given(mazes())
def test_what_a_demonstration_shows_of_other_tasks_is_what_the_expert_would_do(maze: Maze) -> None:
    assert all(goes_as_the_expert_would(segment) for segment in retraced(demonstration(maze)))


@examples
@given(drawn_mazes())
def test_a_demonstration_shows_the_way_back_and_the_way_to_every_cell_of_its_rooms(maze: Maze) -> None:
    sigma = demonstration(maze)
    way = [sigma[0].start.view] + [state.view for segment in sigma for state in segment.states[1:]]
    n_rooms = len({room_of(tuple(cell)) for cell in way} - {None})
    n_inside = sum(room_of(tuple(cell)) is not None for cell in way)
    subgoals = [segment.subgoal for segment in retraced(sigma)]
    assert sum(subgoal != GO_TO_TARGET for subgoal in subgoals) == n_rooms - 1
    assert subgoals.count(GO_TO_TARGET) == 2 * (n_inside - n_rooms)


@examples
@given(mazes())
def test_a_way_back_looks_as_it_does_to_who_goes_it(maze: Maze) -> None:
    sigma = demonstration(maze)
    there = [sigma[0].start.view] + [state.view for segment in sigma for state in segment.states[1:]]
    for segment in retraced(sigma):
        shown = maze_in(segment.states[-1].observation)
        here, end = segment.start.view, segment.states[-1].view
        way = there if there.index(here) < there.index(end) else there[::-1]
        env = MazeEnv()
        seen, _ = env.reset(options={"instance": Maze(maze.lava, cell_of(way[0]), shown.goal)})
        pictures = {tuple(way[0]): seen}
        for cell, beyond in pairwise(way[: way.index(end) + 1]):
            action = next(action for action in range(4) if moved(cell_of(cell), action) == cell_of(beyond))
            pictures[tuple(beyond)] = env.step(np.int64(action))[0]
        assert all((pictures[tuple(state.view)] == state.observation).all() for state in segment.states)


def walked(maze: Maze, actions: list[Action], subgoal: Subgoal | None) -> Trajectory:
    """A demonstration of one segment, by somebody who makes mistakes."""
    simulator = Simulator(domain)
    states = [simulator.reset(maze)]
    states += [simulator.step(action) for action in actions]
    return (Segment(subgoal, tuple(states), tuple(actions), terminated=True),)


def test_a_demonstration_that_crosses_itself_or_ends_in_lava_shows_no_task_that_ends_before_its_end() -> None:
    lava = closed_rooms()
    lava[14, 4] = False
    maze = Maze(lava.copy(), (14, 3), (15, 7))
    _, down, left, right = range(4)
    to_and_fro = [left, right, right, right, left, right, right, right, right]  # through the door, and into the wall
    found = list(retraced(walked(maze, to_and_fro, domain.subgoals.index("east"))))
    assert found
    for segment in found:
        pictures = [state.observation for state in segment.states]
        assert not any((picture[0] == AGENT)[picture[2] == TARGET].any() for picture in pictures[:-1])
        assert not any(lava[cell_of(state.view)] for state in segment.states)
    lava[15, 3] = True
    assert not list(retraced(walked(Maze(lava, (14, 3), (15, 7)), [down], GO_TO_TARGET)))


def clumsy(maze: Maze, seed: int) -> Trajectory:
    """An episode of somebody who knows the way, but takes wrong steps, goes on too far, and stops too early."""
    rng, view = np.random.default_rng(seed), domain.instance_view(maze)
    simulator = Simulator(domain)
    state, sigma = simulator.reset(maze), list[Segment]()
    while not simulator.ended and len(sigma) < 12:
        good = domain.oracle.good_subgoals(view, state.view)
        subgoal = good[0] if good and rng.random() < 0.9 else int(rng.integers(5))
        states, actions = [state], list[int]()
        while not simulator.ended and len(actions) < 10:
            right = domain.oracle.good_actions(view, states[0].view, states[-1].view, subgoal)
            actions.append(right[0] if right and rng.random() < 0.95 else int(rng.integers(4)))
            states.append(simulator.step(actions[-1]))
            over = domain.oracle.reached(view, states[0].view, states[-1].view, subgoal)
            if rng.random() < (0.8 if over else 0.02):
                break
        state = states[-1]
        sigma.append(Segment(subgoal, tuple(states), tuple(actions), terminated=True))
    return tuple(sigma)


def steps_by_way_of(maze: Maze, here: Cell, target: Cell, subgoal: Subgoal) -> float:
    """The fewest steps from here to a target for who first does as a subgoal says."""
    from_here, to_target = solved(maze, here), solved(maze, target)
    if subgoal == GO_TO_TARGET:
        return to_target[here]
    beyond = [moved(door, subgoal) for door in wall_beside(here, subgoal) if not maze.lava[door]]
    return min((from_here[cell] + to_target[cell] for cell in beyond if not maze.lava[cell]), default=np.inf)


@settings(examples, max_examples=100)
@given(mazes(), st.integers(0, 2**32))
def test_what_a_failed_episode_says_of_other_tasks_is_no_worse_than_the_way_that_was_gone(
    maze: Maze, seed: int
) -> None:
    sigma, view = clumsy(maze, seed), domain.instance_view(maze)
    gone = [cell_of(sigma[0].start.view)] + [cell_of(state.view) for segment in sigma for state in segment.states[1:]]
    sigma = tuple(segment for segment in sigma if domain.oracle.good_subgoals(view, segment.start.view))
    good = [domain.oracle.good_subgoals(view, segment.start.view) for segment in sigma]
    labels = [segment.subgoal if segment.subgoal in ok else ok[0] for segment, ok in zip(sigma, good, strict=True)]
    for picture, subgoal in relabeled(sigma, labels):
        here, target = (cell_of(np.argwhere(picture[k] == what)[0]) for k, what in ((0, AGENT), (2, TARGET)))
        when = [[time for time, cell in enumerate(gone) if cell == one] for one in (here, target)]
        steps = max((abs(a - b) for a in when[0] for b in when[1]), default=0)
        said = steps_by_way_of(maze, here, target, subgoal)
        assert said <= steps if subgoal != GO_TO_TARGET else room_of(here) == room_of(target)


@pytest.mark.parametrize("too_far", [(15, 6), (14, 7), (14, 8)])
def test_a_segment_that_went_on_into_a_wall_or_a_door_ends_the_way(too_far: Cell) -> None:
    lava = closed_rooms()
    for door in [(14, 4), (14, 8)]:
        lava[door] = False
    maze = Maze(lava, (14, 3), (14, 11))
    simulator = Simulator(domain)
    states = [simulator.reset(maze)]
    down, right = 1, 3
    actions = [right, right, *([down, right, down] if too_far[0] == 15 else [right] * (too_far[1] - 5))]
    states += [simulator.step(action) for action in actions]
    east = domain.subgoals.index("east")
    segment = Segment(east, tuple(states), tuple(actions), terminated=True)
    for picture, _ in relabeled((segment,), (east,)):
        assert room_of(tuple(np.argwhere(picture[0] == AGENT)[0])) is not None
        assert room_of(tuple(np.argwhere(picture[2] == TARGET)[0])) is not None


def test_a_subgoal_that_was_missed_ends_the_way() -> None:
    maze = domain.instances("random").train[0]
    sigma = demonstration(maze)
    stayed = Segment(sigma[1].subgoal, sigma[1].states[:1] * 2, (0,), terminated=True)
    good = [segment.subgoal for segment in sigma[:2] if segment.subgoal is not None]
    whole, cut = (list(relabeled((sigma[0], second), good)) for second in (sigma[1], stayed))
    between = [len([one for _, one in found if one != domain.subgoals.index("go_to_target")]) for found in (whole, cut)]
    assert between == [6, 2]  # three places, and two
