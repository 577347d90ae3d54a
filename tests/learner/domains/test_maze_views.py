"""What the maze tells a learner of its structure is true of it."""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from tests.learner.kit import examples, free_cells, mazes, neighbours, solved

from waypost.domains import Grid, Symmetry, View
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.env import AGENT, TRAIL, MazeEnv
from waypost_learner.domains.maze.maze import ROOMS, Cell, Maze, moved, room_of, walls
from waypost_learner.domains.maze.views import CROP_VIEW, FLAT_VIEW, HI_VIEW, LO_VIEW

domain = MazeDomain()
views = st.sampled_from([HI_VIEW, LO_VIEW, FLAT_VIEW, CROP_VIEW])


def seen_from(maze: Maze, cell: Cell) -> np.ndarray:
    observation, _ = MazeEnv().reset(options={"instance": Maze(maze.lava, cell, maze.goal)})
    return observation


def with_nearest_doors(maze: Maze, agent: Cell) -> Maze:
    """The maze in which each wall without lava beside it has only the doors nearest to the agent."""
    lava = maze.lava.copy()
    for *_, wall in walls():
        beside = [cell for door in wall for cell in neighbours(door) if room_of(cell) is not None]
        steps = {door: sum(abs(a - b) for a, b in zip(door, agent, strict=True)) for door in wall if not lava[door]}
        if not any(lava[cell] for cell in beside):
            for door in steps:
                lava[door] = steps[door] > min(steps.values())
    return Maze(lava, agent, maze.goal)


@examples
@given(mazes(), st.data(), st.sampled_from(domain.symmetries), views)
def test_a_turned_picture_is_seen_turned(maze: Maze, data: st.DataObject, symmetry: Symmetry, view: View) -> None:
    cell = data.draw(st.sampled_from(free_cells(maze)))
    assume(view is not HI_VIEW or room_of(cell) is not None)  # a door is of the room behind it: one of two
    picture = seen_from(maze, cell)
    assert (view.observe(symmetry.observe(picture)) == symmetry.observe(view.observe(picture))).all()


@examples
@given(mazes(), st.data(), views)
def test_the_agents_place_is_in_the_middle_of_every_view(maze: Maze, data: st.DataObject, view: View) -> None:
    cell = data.draw(st.sampled_from(free_cells(maze)))
    seen = view.observe(seen_from(maze, cell))
    assert seen.shape == view.shape
    grid = view.grid or Grid(patch=1, stride=1, moves=())
    ((row, column),) = np.argwhere(seen[0] == AGENT)
    n_places = (view.shape[1] - grid.patch) // grid.stride + 1
    first = n_places // 2 * grid.stride
    assert first <= row < first + grid.patch
    assert first <= column < first + grid.patch


@examples
@given(mazes(), st.data())
def test_subgoals_are_chosen_by_the_whole_maze_without_the_trail(maze: Maze, data: st.DataObject) -> None:
    cell = data.draw(st.sampled_from(free_cells(maze)))
    seen = HI_VIEW.observe(seen_from(maze, cell))
    assert not (seen == TRAIL).any()
    assert (seen[1] == 0).sum() == (~with_nearest_doors(maze, cell).lava).sum()


@examples
@given(mazes(), st.data(), st.sampled_from([HI_VIEW, LO_VIEW]))
def test_of_several_doors_in_a_wall_the_nearest_are_seen(maze: Maze, data: st.DataObject, view: View) -> None:
    cell = data.draw(st.sampled_from(free_cells(maze)))
    nearest = with_nearest_doors(maze, cell)
    assert (view.observe(seen_from(maze, cell)) == view.observe(seen_from(nearest, cell))).all()


@examples
@given(mazes(), st.data())
def test_where_some_doors_are_not_seen_the_same_rooms_can_be_reached(maze: Maze, data: st.DataObject) -> None:
    cell = data.draw(st.sampled_from(free_cells(maze)))
    before, after = (
        {place for place, steps in solved(one, cell).items() if steps < np.inf and room_of(place) is not None}
        for one in (maze, with_nearest_doors(maze, cell))
    )
    assert before == after


@examples
@given(mazes(), st.data())
def test_actions_are_chosen_by_the_cells_around_alone(maze: Maze, data: st.DataObject) -> None:
    cell = data.draw(st.sampled_from([cell for cell in free_cells(maze) if room_of(cell) is not None]))
    room = room_of(cell)
    assert room is not None
    far = np.ones_like(maze.lava)
    rows, columns = (slice(max(ROOMS * place - 1, 0), ROOMS * place + ROOMS + 2) for place in room)
    far[rows, columns] = False
    filled = Maze(maze.lava | far, maze.start, cell)
    near = Maze(maze.lava, maze.start, cell)
    assert (LO_VIEW.observe(seen_from(near, cell)) == LO_VIEW.observe(seen_from(filled, cell))).all()


@pytest.mark.parametrize(("cell", "place"), [((1, 1), (0, 0)), ((7, 13), (1, 3)), ((4, 2), (4, 2))])
def test_the_place_of_a_state_is_its_room_or_its_door(cell: Cell, place: Cell) -> None:
    assert domain.place(list(cell)) == place


def test_moves_lead_where_subgoals_and_actions_do() -> None:
    assert HI_VIEW.grid is not None
    assert LO_VIEW.grid is not None
    assert LO_VIEW.grid.moves == tuple(moved((0, 0), action) for action in range(4))
    assert domain.subgoals == ("north", "south", "west", "east", "go_to_target")
    assert HI_VIEW.grid.moves == (*LO_VIEW.grid.moves, None)
