"""The maze environment keeps gymnasium's contract and shows what the paper's networks are to see."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from hypothesis import given
from hypothesis import strategies as st
from tests.learner.kit import STEPS, drawn_mazes, examples, free_cells

from waypost_learner.domains.maze.env import MAX_STEPS, MazeEnv
from waypost_learner.domains.maze.lasting_lava import LastingLavaMazeEnv
from waypost_learner.domains.maze.maze import Maze, closed_rooms, moved

UP, DOWN, LEFT, RIGHT = (np.int64(action) for action in range(4))


def one_room(start: tuple[int, int] = (2, 2), goal: tuple[int, int] = (2, 3)) -> Maze:
    return Maze(closed_rooms(), start, goal)


def started(maze: Maze) -> tuple[MazeEnv, np.ndarray]:
    env = MazeEnv()
    observation, _ = env.reset(options={"instance": maze})
    return env, observation


@pytest.mark.parametrize("environment", [MazeEnv, LastingLavaMazeEnv])
def test_the_environment_passes_gymnasiums_checker_without_a_warning(environment: type[MazeEnv]) -> None:
    gymnasium.register("Maze-v0", environment)
    try:
        check_env(gymnasium.make("Maze-v0", render_mode="ansi").unwrapped)
    finally:
        del gymnasium.registry["Maze-v0"]


def test_environments_run_side_by_side_in_a_vector_environment() -> None:
    vector = gymnasium.vector.SyncVectorEnv([lambda: MazeEnv([one_room()]) for _ in range(3)])
    vector.reset(seed=0)
    _, rewards, terminated, truncated, _ = vector.step(np.array([0, 2, 3]))
    assert rewards.tolist() == [0, 0, 1]
    assert terminated.tolist() == [False, False, True]
    assert truncated.tolist() == [False, False, False]
    vector.close()


def test_the_first_observation_shows_agent_lava_trail_and_target_in_the_authors_values() -> None:
    maze = one_room()
    _, observation = started(maze)
    expected = np.zeros((3, 17, 17), np.float32)
    expected[0, 2, 2] = np.float32(0.4)
    expected[1] = maze.lava
    expected[1, 2, 2] = -0.5
    expected[2, 2, 3] = -1
    assert observation.dtype == np.float32
    np.testing.assert_array_equal(observation, expected)


@examples
@given(drawn_mazes(), st.data())
def test_the_agent_is_in_one_pixel_and_its_trail_is_every_cell_it_has_been_in(maze: Maze, data: st.DataObject) -> None:
    env, observation = started(maze)
    visited, cell, ended = {maze.start}, maze.start, False
    while not ended and data.draw(st.booleans()):
        action = data.draw(st.integers(0, 3))
        observation, _, terminated, truncated, _ = env.step(np.int64(action))
        cell, ended = moved(cell, action), terminated or truncated
        visited.add(cell)
    assert [tuple(place) for place in np.argwhere(observation[0])] == [cell]
    trail = {tuple(place) for place in np.argwhere(observation[1] == -0.5)}
    assert trail == {place for place in visited if not maze.lava[place]}
    np.testing.assert_array_equal(observation[1] == 1, maze.lava)
    assert [tuple(place) for place in np.argwhere(observation[2])] == [maze.goal]


def test_the_four_actions_go_up_down_left_and_right() -> None:
    for action, (row, column) in enumerate(STEPS):
        env, _ = started(one_room(goal=(14, 14)))
        env.step(np.int64(action))
        assert env.cell == (2 + row, 2 + column)


def test_an_observation_does_not_change_after_it_was_given() -> None:
    env, first = started(one_room(goal=(14, 14)))
    kept = first.copy()
    second, *_ = env.step(UP)
    env.step(DOWN)
    np.testing.assert_array_equal(first, kept)
    assert second[0, 1, 2] != 0


def test_lava_ends_the_episode_with_reward_minus_one() -> None:
    env, _ = started(one_room(start=(1, 1)))
    _, reward, terminated, truncated, _ = env.step(UP)
    assert (reward, terminated, truncated) == (-1, True, False)


def test_the_target_ends_the_episode_with_the_only_positive_reward() -> None:
    env, _ = started(one_room())
    _, reward, terminated, truncated, _ = env.step(LEFT)
    assert (reward, terminated, truncated) == (0, False, False)
    env.step(RIGHT)
    _, reward, terminated, truncated, _ = env.step(RIGHT)
    assert (reward, terminated, truncated) == (1, True, False)


def test_the_hundredth_step_truncates_the_episode_and_no_earlier_one_does() -> None:
    env, _ = started(one_room(goal=(14, 14)))
    truncations = [env.step(LEFT if step % 2 else RIGHT)[3] for step in range(MAX_STEPS)]
    assert truncations == [False] * 99 + [True]


def test_arriving_with_the_hundredth_step_is_a_success_and_no_truncation() -> None:
    env, _ = started(one_room(start=(2, 1)))
    for step in range(98):
        env.step(DOWN if step % 2 == 0 else UP)
    env.step(RIGHT)
    _, reward, terminated, truncated, _ = env.step(RIGHT)
    assert (env.steps, reward, terminated, truncated) == (100, 1, True, False)


def test_equal_seeds_give_equal_episodes() -> None:
    def episode(seed: int) -> list[bytes]:
        env = MazeEnv()
        observation, _ = env.reset(seed=seed)
        env.action_space.seed(seed)
        seen = [observation.tobytes()]
        for _ in range(5):
            observation, _, terminated, _, _ = env.step(env.action_space.sample())
            seen.append(observation.tobytes())
            if terminated:
                break
        return seen

    assert episode(3) == episode(3)
    assert episode(3)[0] != episode(4)[0]


def test_a_step_before_the_first_reset_is_refused_with_what_to_do() -> None:
    with pytest.raises(RuntimeError, match=r"call reset\(\) before"):
        MazeEnv().step(UP)


def test_rendering_draws_lava_trail_agent_and_target_as_text() -> None:
    env = MazeEnv(render_mode="ansi")
    env.reset(options={"instance": one_room()})
    env.step(LEFT)
    rows = (env.render() or "").split("\n")
    assert rows[2].startswith("#@*$#")
    assert len(rows) == 17
    assert sum(row.count(".") for row in rows) == len(free_cells(one_room())) - 3
