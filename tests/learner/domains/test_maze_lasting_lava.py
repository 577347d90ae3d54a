"""The maze in which lava does not end an episode: it holds the agent, and the expert knows the way out."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from tests.learner.kit import Maze, corridor, examples, mazes, store

from waypost.trajectory import Segment
from waypost_learner.algorithms.queries import HierDemo
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import MAX_STEPS
from waypost_learner.domains.maze.lasting_lava import LAVA_COST, LastingLavaMazeDomain, LastingLavaMazeEnv
from waypost_learner.domains.maze.maze import ACTIONS, cell_of, closed_rooms
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.translation import Translator
from waypost_learner.rollout.simulator import Simulator
from waypost_learner.runs.training import train

domain = LastingLavaMazeDomain()
UP, DOWN, LEFT, RIGHT = (np.int64(action) for action in range(4))


def started(maze: Maze) -> LastingLavaMazeEnv:
    env = domain.make_env()
    env.reset(options={"instance": maze})
    return env


def test_lava_costs_a_little_and_holds_the_agent_until_it_steps_back_onto_its_trail() -> None:
    maze = Maze(closed_rooms(), (1, 2), (3, 3))
    env = started(maze)
    _, reward, terminated, _, _ = env.step(UP)
    assert (env.cell, reward, terminated) == ((0, 2), -LAVA_COST, False)
    for held in (UP, LEFT, RIGHT):
        observation, reward, terminated, _, _ = env.step(held)
        assert (env.cell, reward, terminated) == ((0, 2), -LAVA_COST, False)
        assert observation[1][0, 2] == 1  # no trail in lava
    _, reward, _, _, _ = env.step(DOWN)
    assert (env.cell, reward) == ((1, 2), 0)


def test_an_episode_in_lava_ends_after_as_many_steps_as_any_other() -> None:
    env = started(Maze(closed_rooms(), (15, 15), (13, 13)))
    ends = [env.step(action)[2:4] for action in [DOWN, *[DOWN, RIGHT] * MAX_STEPS][:MAX_STEPS]]
    assert ends == [(False, False)] * (MAX_STEPS - 1) + [(False, True)]


@examples
@given(mazes(), st.lists(st.sampled_from(range(len(ACTIONS))), max_size=25), st.data())
def test_the_expert_leads_from_wherever_actions_led_to_the_target(
    maze: Maze, actions: list[int], data: st.DataObject
) -> None:
    env, view = started(maze), maze.to_json()
    for action in actions:
        env.step(np.int64(action))
    while not domain.succeeded(env):
        origin = domain.state_view(env)
        subgoal = data.draw(st.sampled_from(domain.oracle.good_subgoals(view, origin)))
        ended = False
        while not ended:
            before = env.cell
            good = domain.oracle.good_actions(view, origin, domain.state_view(env), subgoal)
            env.step(np.int64(data.draw(st.sampled_from(good))))
            assert env.cell != before
            assert not maze.lava[env.cell]
            ended = domain.oracle.reached(view, origin, domain.state_view(env), subgoal)


def test_out_of_lava_the_expert_is_that_of_the_other_maze() -> None:
    for maze in domain.instances("corners").test[:5]:
        view, state = maze.to_json(), list(maze.start)
        plain = MazeDomain().oracle
        assert domain.oracle.good_subgoals(view, state) == plain.good_subgoals(view, state)


def test_a_subgoal_of_a_q_function_fails_in_lava() -> None:
    maze = Maze(closed_rooms(), (1, 2), (3, 3))
    env = started(maze)
    origin = domain.state_view(env)
    env.step(UP)
    assert domain.outcome(maze, origin, domain.state_view(env), 0) == "failed"
    burnt = domain.state_view(env)
    env.step(DOWN)
    assert domain.outcome(maze, burnt, domain.state_view(env), 0) is None  # back in the room of the attempt


def test_a_run_asks_about_rollouts_that_were_in_lava(tmp_path: Path) -> None:
    name = f"{LastingLavaMazeDomain.__module__}:{LastingLavaMazeDomain.__name__}"
    config = replace(corridor(episodes=4), domain=name, warm_start=1)
    with store(tmp_path) as (connection, options):
        summary = train(config, connection, options)
    assert summary["domain"] == name
    assert summary["cost"]["by_kind"]["label_lo"] + summary["cost"]["by_kind"]["label_hi"] > 0


@examples
@given(mazes(), st.lists(st.sampled_from(range(len(ACTIONS))), max_size=9), st.sampled_from(range(len(ACTIONS))))
def test_a_demonstration_that_begins_in_lava_teaches_no_way_through_lava(
    maze: Maze, actions: list[int], toward: int
) -> None:
    simulator = Simulator(domain)
    states, taken = [simulator.reset(maze)], list[int]()
    for action in [*actions, *[toward] * 16]:
        if not simulator.ended and not (len(taken) >= len(actions) and maze.lava[cell_of(states[-1].view)]):
            states.append(simulator.step(action))
            taken.append(action)
    assume(not simulator.ended)
    before = (Segment(0, tuple(states), tuple(taken), terminated=True),)
    translator = Translator(domain, maze)
    ask = translator.ask(HierDemo(states[-1], before=before, max_segments=1), 0, 0)
    demonstration: Any = translator.answer(OracleExpert(domain)(ask))
    for segment in domain.retraced(demonstration):
        assert not any(maze.lava[cell_of(state.view)] for state in segment.states)
        assert all((state.observation[1][maze.lava] == 1).all() for state in segment.states), "no trail in lava"
