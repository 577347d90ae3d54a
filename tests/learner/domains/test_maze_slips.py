"""The maze's expert that plans for slips: it gets there, and slips cost it less than the expert of shortest ways."""

import numpy as np
import pytest
from hypothesis import given, settings
from tests.learner.kit import Cell, Maze, mazes, reachable_cells

from waypost_learner.domains.maze.as_authors import AsAuthorsMazeDomain
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.lasting_lava import LastingLavaMazeDomain
from waypost_learner.domains.maze.maze import ACTIONS, GO_TO_TARGET, SUBGOALS, moved, wall_beside
from waypost_learner.domains.maze.oracle import MazeOracle
from waypost_learner.domains.maze.slips import SlipExpertMazeDomain, SlipOracle
from waypost_learner.experts.oracle import OracleExpert

SIDES = {"up": ("left", "right"), "down": ("left", "right"), "left": ("up", "down"), "right": ("up", "down")}


def worth(oracle: MazeOracle, maze: Maze) -> float:
    """The expected 0.99 ** steps of an agent that slips from the start to the target, and acts as the oracle says."""
    view, cells = maze.to_json(), reachable_cells(maze)
    chosen: dict[Cell, int] = {}
    for cell in cells:
        if cell != maze.goal:
            subgoal = oracle.good_subgoals(view, cell)[0]
            chosen[cell] = oracle.good_actions(view, cell, cell, subgoal)[0]
    number = {cell: i for i, cell in enumerate(cells)}
    moves, ends = np.eye(len(cells)), np.zeros(len(cells))
    ends[number[maze.goal]] = 1
    for cell, action in chosen.items():
        sides = [ACTIONS.index(side) for side in SIDES[ACTIONS[action]]]
        for slipped, probability in zip((action, *sides), (0.8, 0.1, 0.1), strict=True):
            if (after := moved(cell, slipped)) in number:
                moves[number[cell], number[after]] -= 0.99 * probability
    return float(np.linalg.solve(moves, ends)[number[maze.start]])


@settings(deadline=None, max_examples=10)
@given(mazes())
def test_an_agent_that_slips_fares_at_least_as_well_as_on_shortest_ways(maze: Maze) -> None:
    assert worth(SlipOracle(), maze) >= worth(MazeOracle(), maze) - 1e-6


@pytest.mark.parametrize("name", ["corners", "random"])
def test_its_demonstrations_reach_the_target_by_ways_that_are_longer_and_worth_more(name: str) -> None:
    careful, plain = SlipExpertMazeDomain(), MazeDomain()
    lengths, worths = [], []
    for maze in plain.instances(name).test[:4]:
        for domain in (careful, plain):
            demonstration = OracleExpert(domain).demonstrate(maze.to_json(), list(maze.start))
            actions = [action for segment in demonstration.segments for action in segment.actions]
            cell = maze.start
            for action in actions:
                cell = moved(cell, ACTIONS.index(action))
            assert cell == maze.goal
            lengths.append(len(actions))
            worths.append(worth(domain.oracle, maze))
    assert sum(lengths[::2]) > sum(lengths[1::2])
    assert np.mean(worths[::2]) > 1.1 * np.mean(worths[1::2])


def test_where_no_way_leads_to_the_subgoal_no_action_is_right() -> None:
    for maze in MazeDomain().instances("corners").test[:8]:
        view, oracle = maze.to_json(), SlipOracle()
        by_subgoal = [oracle.good_actions(view, maze.start, maze.start, subgoal) for subgoal in range(len(SUBGOALS))]
        assert by_subgoal[GO_TO_TARGET] == []  # the target is in another room
        assert [bool(good) for good in by_subgoal] == [
            any(not maze.lava[cell] for cell in wall_beside(maze.start, subgoal)) for subgoal in range(4)
        ] + [False]


def test_with_both_departures_the_expert_leaves_lava_and_else_acts_as_the_one_that_plans_for_slips() -> None:
    both, careful, lasting = AsAuthorsMazeDomain().oracle, SlipOracle(), LastingLavaMazeDomain().oracle
    for maze in MazeDomain().instances("corners").test[:3]:
        view, cells = maze.to_json(), reachable_cells(maze)
        for cell in cells:
            assert both.good_subgoals(view, cell) == careful.good_subgoals(view, cell)
            for subgoal in both.good_subgoals(view, cell):
                good = both.good_actions(view, cell, cell, subgoal)
                assert good == careful.good_actions(view, cell, cell, subgoal)
        burnt = next(cell for cell in (moved(maze.start, action) for action in range(4)) if maze.lava[cell])
        there = [*burnt, [list(maze.start)]]
        [subgoal, *_] = both.good_subgoals(view, there)
        out = both.good_actions(view, maze.start, there, subgoal)
        assert [moved(burnt, action) for action in out] == [maze.start]
        assert out == lasting.good_actions(view, maze.start, there, subgoal)
        assert careful.good_actions(view, maze.start, burnt, subgoal) == []
