"""Learners of the preset `general` that demonstrations of mazes taught, and pictures of mazes that nobody taught."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost.trajectory import Observation, Segment, Trajectory
from waypost_learner.algorithms.learner import Learner
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.maze import Maze
from waypost_learner.policies.labels import Labels
from waypost_learner.policies.levels import HIERARCHY, Levels
from waypost_learner.presets import find_preset
from waypost_learner.presets.base import Preset
from waypost_learner.rollout.simulator import Simulator

maze = MazeDomain()
TRAIN = maze.instances("random").train


def demonstrated(instance: Maze) -> Trajectory:
    """The oracle's demonstration of a maze."""
    simulator, oracle, view = Simulator(maze), maze.oracle, instance.to_json()
    state, sigma = simulator.reset(instance), list[Segment]()
    while not simulator.ended:
        subgoal = oracle.good_subgoals(view, state.view)[0]
        states, actions = [state], list[int]()
        while not oracle.reached(view, state.view, states[-1].view, subgoal):
            actions.append(oracle.good_actions(view, state.view, states[-1].view, subgoal)[0])
            states.append(simulator.step(actions[-1]))
        sigma.append(Segment(subgoal, tuple(states), tuple(actions), True, final=simulator.final))
        state = states[-1]
    return tuple(sigma)


def into_lava(instance: Maze) -> Segment:
    """The first of random walks that ends in lava, as a segment."""
    rng = np.random.default_rng(0)
    while True:
        simulator = Simulator(maze)
        states, actions = [simulator.reset(instance)], list[int]()
        while not simulator.ended:
            actions.append(int(rng.integers(4)))
            states.append(simulator.step(actions[-1]))
        if simulator.final and not simulator.succeeded:
            return Segment(0, tuple(states), tuple(actions), False, final=True)


def taught(preset: Preset, n: int, first: int = 0, levels: Levels = HIERARCHY, seed: int = 0) -> Learner:
    learner = Learner(maze, preset, seed, levels, threads=1)
    teach(learner, n, first)
    return learner


def teach(learner: Learner, n: int, first: int = 0) -> None:
    for instance in TRAIN[first : first + n]:
        labels = Labels()
        if learner.levels.flat:
            path = demonstrated(instance)
            labels.append_flat(path, [action for segment in path for action in segment.actions])
        else:
            labels.append_demonstration(demonstrated(instance))
        learner.learn(labels)
        learner.train_idle()


def briefly(updates: int, **values: Any) -> Preset:
    preset = find_preset("general").with_values(**values)
    batch = preset.training.train_shared.batch
    rows = replace(preset.training.train_shared, least=1, most=1, idle=updates * batch)
    return preset.with_values(train_shared=rows)


def seen(n: int = 6, first: int = 500) -> tuple[Observation, NDArray[np.int64]]:
    """Observations of mazes that nobody taught, and the agent's cells."""
    states = [state for instance in TRAIN[first : first + n] for one in demonstrated(instance) for state in one.states]
    return np.stack([state.observation for state in states]), np.array([state.view for state in states])
