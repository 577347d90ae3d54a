"""The drawn mazes are the paper's: its rules hold for every one, and its numbers for all together."""

import numpy as np
import pytest
from tests.learner.kit import solved

from waypost import wire
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.domains.maze.maze import Maze, closed_rooms, distances_from, room_of, walls
from waypost_learner.experts.oracle import OracleExpert

KINDS = ["random", "corners"]
CORNERS = {(1, 1), (1, 15), (15, 1), (15, 15)}


def all_mazes(kind: str, seed: int = 0) -> list[Maze]:
    training, test = maze_set(kind, seed)
    return [*training, *test]


def doors(maze: Maze) -> list[tuple[int, int]]:
    return [(int(r), int(c)) for r, c in np.argwhere(closed_rooms() & ~maze.lava)]


def path_lengths(kind: str) -> np.ndarray:
    return np.array([distances_from(maze.lava, maze.start)[maze.goal] for maze in all_mazes(kind)])


@pytest.mark.parametrize("kind", KINDS)
def test_there_are_a_thousand_mazes_to_train_on_and_another_thousand_to_test_on(kind: str) -> None:
    training, test = maze_set(kind)
    assert (len(training), len(test)) == (1_000, 1_000)
    assert len({(maze.lava.tobytes(), maze.start, maze.goal) for maze in (*training, *test)}) == 2_000


def test_the_same_seed_gives_the_same_mazes_and_another_seed_others() -> None:
    first = [maze.to_json() for maze in all_mazes("corners")]
    maze_set.cache_clear()
    assert [maze.to_json() for maze in all_mazes("corners")] == first
    assert [maze.to_json() for maze in all_mazes("corners", seed=1)] != first


@pytest.mark.parametrize("kind", KINDS)
def test_rooms_are_empty_and_doors_lie_in_the_middle_three_cells_of_inner_walls_one_to_a_wall(kind: str) -> None:
    for maze in all_mazes(kind):
        assert not maze.lava[~closed_rooms()].any()
        open_cells = [sum(not maze.lava[cell] for cell in cells) for *_, cells in walls()]
        assert max(open_cells) == 1
        assert sum(open_cells) == len(doors(maze))


@pytest.mark.parametrize("kind", KINDS)
def test_the_last_door_was_needed_so_some_door_is_on_every_path(kind: str) -> None:
    for maze in all_mazes(kind)[:60]:
        closed = [Maze(with_lava(maze, door), maze.start, maze.goal) for door in doors(maze)]
        assert any(solved(one)[one.start] == np.inf for one in closed)


def with_lava(maze: Maze, cell: tuple[int, int]) -> np.ndarray:
    lava = maze.lava.copy()
    lava[cell] = True
    return lava


def test_random_mazes_start_and_end_anywhere_in_rooms_at_least_40_steps_apart() -> None:
    mazes = all_mazes("random")
    assert path_lengths("random").min() == 40
    assert all(room_of(maze.start) and room_of(maze.goal) for maze in mazes)
    assert len({maze.start for maze in mazes}) > 130  # of 144 cells
    assert len({maze.goal for maze in mazes}) > 130


def test_corner_mazes_lead_from_one_corner_to_another() -> None:
    mazes = all_mazes("corners")
    pairs = {(maze.start, maze.goal) for maze in mazes}
    assert pairs == {(start, goal) for start in CORNERS for goal in CORNERS if start != goal}


def test_the_doors_of_corner_mazes_are_redrawn_so_paths_are_a_little_shorter_and_longer_than_40() -> None:
    lengths = path_lengths("corners")
    assert 28 <= lengths.min() < 40
    assert 42.5 < lengths.mean() < 44.5
    assert 58 <= lengths.max() <= 76


def test_random_mazes_have_the_measured_mean_path_and_number_of_doors() -> None:
    assert path_lengths("random").mean() == pytest.approx(43.9, abs=0.4)
    assert np.mean([len(doors(maze)) for maze in all_mazes("random")]) == pytest.approx(14.9, abs=0.2)


def test_every_cell_of_a_wall_is_as_likely_a_door_and_so_is_every_side() -> None:
    counts = np.zeros((17, 17))
    for maze in all_mazes("random"):
        counts += closed_rooms() & ~maze.lava
    by_cell = np.array([[counts[cell] for cell in cells] for *_, cells in walls()])
    np.testing.assert_allclose(by_cell.sum(0) / by_cell.sum(), 1 / 3, atol=0.01)
    turned = (counts, counts.T, counts[::-1], counts[:, ::-1])
    assert max(np.abs(counts - other).max() for other in turned) < 6 * np.sqrt(counts.max())


def test_expert_trajectories_have_the_measured_horizons_and_few_ties() -> None:
    domain = MazeDomain()
    expert, oracle = OracleExpert(domain), domain.oracle
    n_segments, n_actions, n_decisions, n_ties = [], [], 0, 0
    for maze in all_mazes("random")[:150]:
        view = maze.to_json()
        demonstration = expert(ask_demonstration(view))
        assert isinstance(demonstration, wire.HierDemoAnswer)
        n_segments.append(len(demonstration.segments))
        here = view["start"]
        for segment in demonstration.segments:
            n_actions.append(len(segment.actions))
            n_decisions += 1
            n_ties += len(oracle.good_subgoals(view, here)) > 1
            for action in segment.actions:
                here = oracle.successor(view, here, domain.actions.index(action))
    assert np.mean(n_segments) == pytest.approx(10.3, abs=0.4)
    assert max(n_segments) <= 16
    assert np.mean(n_actions) == pytest.approx(4.3, abs=0.15)
    assert max(n_actions) <= 7
    assert 0.005 < n_ties / n_decisions < 0.04
    # HierDemo's price under the paper's model: subgoals, actions and terminations.
    assert 2 * np.mean(n_segments) + np.sum(n_actions) / len(n_segments) == pytest.approx(64.4, abs=1.0)


def test_a_number_after_the_name_draws_other_mazes_of_the_same_kind() -> None:
    domain = MazeDomain()
    usual, others = domain.instances("random"), domain.instances("random:1")
    assert domain.instances("random:0") == usual
    drawn = {(maze.lava.tobytes(), maze.start, maze.goal) for maze in (*usual.train, *usual.test)}
    assert not any((maze.lava.tobytes(), maze.start, maze.goal) in drawn for maze in (*others.train, *others.test))
    assert (others.train, others.test) == maze_set("random", 1)
    assert domain.instances("corners:1").vary is not None
    for wrong in ("random:", "random:one", "random:-1", "others:1"):
        with pytest.raises(ValueError, match="no instances"):
            domain.instances(wrong)


def ask_demonstration(view: dict) -> wire.AskHierDemo:
    return wire.AskHierDemo(
        kind="hier_demo",
        episode=0,
        ordinal=0,
        question="?",
        instance=view,
        state=view["start"],
        max_segments=100,
        max_actions=100,
    )
