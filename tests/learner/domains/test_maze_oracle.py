"""The maze's oracle against value iteration: all it calls good is on a shortest path, and nothing else."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from tests.learner.kit import drawn_mazes, examples, free_cells, mazes, neighbours, reachable_cells, solved

from waypost import wire
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.maze import (
    ACTIONS,
    SUBGOALS,
    Cell,
    Maze,
    closed_rooms,
    distances_from,
    moved,
    room_of,
    walls,
)
from waypost_learner.domains.maze.oracle import MazeOracle
from waypost_learner.experts.oracle import OracleExpert

NORTH, SOUTH, WEST, EAST, TARGET = range(5)
TOWARD = {NORTH: (-1, 0), SOUTH: (1, 0), WEST: (0, -1), EAST: (0, 1)}
oracle = MazeOracle()


def somewhere(data: st.DataObject, maze: Maze) -> Cell:
    """Any cell from which the target can be reached, the target itself left out."""
    return data.draw(st.sampled_from([cell for cell in reachable_cells(maze) if cell != maze.goal]))


def rooms_beside(cell: Cell) -> set[tuple[int, int]]:
    """The room of a cell, or both rooms of a door."""
    return {room for near in (cell, *neighbours(cell)) if (room := inner_room(near)) is not None}


def inner_room(cell: Cell) -> tuple[int, int] | None:
    inside = all(line % 4 for line in cell)
    return (cell[0] // 4, cell[1] // 4) if inside else None


def entries(maze: Maze, origin: Cell, subgoal: int) -> set[Cell]:
    """The first cells beyond the doors on the subgoal's side of a cell: the definition, by hand."""
    found = set()
    for first, second, cells in walls():
        for here, there in ((first, second), (second, first)):
            if (there[0] - here[0], there[1] - here[1]) != TOWARD.get(subgoal):
                continue
            if inner_room(origin) == here or origin in cells:
                doors = [cell for cell in cells if not maze.lava[cell]]
                found |= {moved(door, subgoal) for door in doors}
    return {cell for cell in found if not maze.lava[cell]}


def beyond(maze: Maze, origin: Cell, subgoal: int) -> tuple[int, int] | None:
    """The room that a subgoal chosen in a cell leads into, None without a door."""
    return next((inner_room(entry) for entry in entries(maze, origin, subgoal)), None)


@examples
@given(mazes(), st.data())
def test_good_choices_reach_the_target_in_exactly_the_shortest_number_of_steps(maze: Maze, data: st.DataObject) -> None:
    view, here = maze.to_json(), somewhere(data, maze)
    shortest, steps = solved(maze)[here], 0
    while here != maze.goal:
        subgoal = data.draw(st.sampled_from(oracle.good_subgoals(view, list(here))))
        origin = here
        while True:
            here = moved(here, data.draw(st.sampled_from(oracle.good_actions(view, list(origin), list(here), subgoal))))
            steps += 1
            if oracle.reached(view, list(origin), list(here), subgoal):
                break
    assert steps == shortest


@examples
@given(mazes(), st.data())
def test_the_flat_labels_are_exactly_the_actions_on_shortest_paths(maze: Maze, data: st.DataObject) -> None:
    view, here = maze.to_json(), somewhere(data, maze)
    to_goal = solved(maze)
    optimal = {a for a, near in enumerate(neighbours(here)) if to_goal.get(near, np.inf) < to_goal[here]}
    good = {
        action
        for subgoal in oracle.good_subgoals(view, list(here))
        for action in oracle.good_actions(view, list(here), list(here), subgoal)
    }
    assert good == optimal


@examples
@given(mazes(), st.data())
def test_each_optimal_action_is_a_flat_label_that_agrees_with_the_learner(maze: Maze, data: st.DataObject) -> None:
    here = somewhere(data, maze)
    to_goal = solved(maze)
    own = data.draw(st.integers(0, 3))
    label = flat_label(maze, here, own)
    optimal = [a for a, near in enumerate(neighbours(here)) if to_goal.get(near, np.inf) < to_goal[here]]
    assert label == own if own in optimal else label in optimal


def flat_label(maze: Maze, here: Cell, own: int) -> int:
    answer = OracleExpert(MazeDomain())(
        wire.AskLabelFull(
            kind="label_full",
            episode=0,
            ordinal=0,
            question="?",
            instance=maze.to_json(),
            segments=[wire.Segment(subgoal=None, states=[list(here), [0, 0]], actions=[ACTIONS[own]])],
        )
    )
    assert isinstance(answer, wire.LabelFullAnswer)
    (action,) = answer.actions
    return ACTIONS.index(action)


@examples
@given(mazes(), st.data())
def test_a_subgoal_is_good_if_and_only_if_a_shortest_path_enters_its_room_by_a_door_to_it(
    maze: Maze, data: st.DataObject
) -> None:
    here = somewhere(data, maze)
    to_goal, good = solved(maze), oracle.good_subgoals(maze.to_json(), list(here))
    if inner_room(here) is not None and inner_room(here) == inner_room(maze.goal):
        assert good == [TARGET]
        return
    on_the_way = [
        subgoal
        for subgoal in TOWARD
        if any(solved(maze, cell)[here] + to_goal[cell] == to_goal[here] for cell in entries(maze, here, subgoal))
    ]
    assert good == on_the_way
    assert good


@examples
@given(mazes(), st.data())
def test_a_subgoal_without_a_door_is_never_good_has_no_actions_and_is_never_reached(
    maze: Maze, data: st.DataObject
) -> None:
    view, here = maze.to_json(), somewhere(data, maze)
    subgoal = data.draw(st.sampled_from(sorted(TOWARD)))
    assume(beyond(maze, here, subgoal) is None)
    assert subgoal not in oracle.good_subgoals(view, list(here))
    assert oracle.good_actions(view, list(here), list(here), subgoal) == []
    assert not any(oracle.reached(view, list(here), list(cell), subgoal) for cell in free_cells(maze))


@examples
@given(mazes(), st.data())
def test_going_to_the_target_is_valid_in_its_room_alone(maze: Maze, data: st.DataObject) -> None:
    view, origin = maze.to_json(), somewhere(data, maze)
    in_its_room = inner_room(origin) == inner_room(maze.goal)
    assert (oracle.good_actions(view, list(origin), list(origin), TARGET) != []) == in_its_room
    for cell in free_cells(maze):
        assert oracle.reached(view, list(origin), list(cell), TARGET) == (in_its_room and cell == maze.goal)


@examples
@given(mazes(), st.data())
def test_a_subgoal_is_reached_in_every_cell_of_the_room_it_leads_into_and_nowhere_else(
    maze: Maze, data: st.DataObject
) -> None:
    view, origin = maze.to_json(), somewhere(data, maze)
    for subgoal in TOWARD:
        into = beyond(maze, origin, subgoal)
        for cell in free_cells(maze):
            reached = oracle.reached(view, list(origin), list(cell), subgoal)
            assert reached == (into is not None and inner_room(cell) == into)


@examples
@given(mazes(), st.data())
def test_after_a_wrong_turn_the_good_actions_still_lead_into_the_subgoals_room(maze: Maze, data: st.DataObject) -> None:
    view, origin = maze.to_json(), somewhere(data, maze)
    subgoal = data.draw(st.sampled_from(range(5)))
    here = somewhere(data, maze)
    assume(oracle.good_actions(view, list(origin), list(origin), subgoal))
    for _ in range(200):
        if oracle.reached(view, list(origin), list(here), subgoal):
            return
        good = oracle.good_actions(view, list(origin), list(here), subgoal)
        here = moved(here, data.draw(st.sampled_from(good)))
        assert not maze.lava[here]
    raise AssertionError("the subgoal's room was never reached")


@examples
@given(drawn_mazes())
def test_door_cells_belong_to_no_room_and_all_other_free_cells_to_one(maze: Maze) -> None:
    for cell in free_cells(maze):
        assert room_of(cell) == inner_room(cell)
    doors = [cell for cell in free_cells(maze) if room_of(cell) is None]
    assert set(doors) == {(int(r), int(c)) for r, c in np.argwhere(closed_rooms() & ~maze.lava)}
    assert all(len(rooms_beside(door)) == 2 for door in doors)


@examples
@given(drawn_mazes(), st.data())
def test_standing_on_a_door_only_the_rooms_on_its_two_sides_can_be_entered(maze: Maze, data: st.DataObject) -> None:
    view = maze.to_json()
    door = data.draw(st.sampled_from([cell for cell in reachable_cells(maze) if room_of(cell) is None]))
    assert oracle.good_subgoals(view, list(door))
    for subgoal, (row, column) in TOWARD.items():
        into = (door[0] + row, door[1] + column)
        actions = oracle.good_actions(view, list(door), list(door), subgoal)
        assert actions == ([] if maze.lava[into] else [subgoal])


def test_of_two_doors_in_one_wall_the_one_on_the_shorter_way_is_taken() -> None:
    lava = closed_rooms()
    lava[1, 4] = lava[3, 4] = False
    maze = Maze(lava, (2, 3), (1, 5))
    assert oracle.good_actions(maze.to_json(), [2, 3], [2, 3], EAST) == [0]
    other = Maze(lava, (2, 3), (3, 5))
    assert oracle.good_actions(other.to_json(), [2, 3], [2, 3], EAST) == [1]


def test_of_two_good_subgoals_both_are_good() -> None:
    lava = closed_rooms()
    for door in ((4, 2), (2, 4), (4, 6), (6, 4)):
        lava[door] = False
    maze = Maze(lava, (2, 2), (6, 6))
    assert set(oracle.good_subgoals(maze.to_json(), [2, 2])) == {SOUTH, EAST}


def test_in_the_targets_room_only_going_there_is_good_even_if_the_way_leads_through_another_room() -> None:
    lava = closed_rooms()
    lava[1:4, 2] = True  # the room's left and right parts are connected through the room below
    lava[4, 1] = lava[4, 3] = False
    maze = Maze(lava, (1, 1), (1, 3))
    assert oracle.good_subgoals(maze.to_json(), [1, 1]) == [TARGET]
    assert oracle.good_actions(maze.to_json(), [1, 1], [3, 1], TARGET) == [1]
    assert not oracle.reached(maze.to_json(), [1, 1], [5, 2], TARGET)


def test_an_action_along_the_wall_comes_before_the_one_toward_the_door_whichever_way_the_maze_is_turned() -> None:
    lava = closed_rooms()
    lava[3, 4] = False
    first = oracle.good_actions(Maze(lava, (1, 1), (1, 5)).to_json(), [1, 1], [1, 1], EAST)
    turned = oracle.good_actions(Maze(lava.T.copy(), (1, 1), (5, 1)).to_json(), [1, 1], [1, 1], SOUTH)
    assert ([ACTIONS[a] for a in first], [ACTIONS[a] for a in turned]) == (["down", "right"], ["right", "down"])


@examples
@given(mazes(), st.data())
def test_distances_are_those_of_value_iteration(maze: Maze, data: st.DataObject) -> None:
    source = data.draw(st.sampled_from(free_cells(maze)))
    distances, values = distances_from(maze.lava, source), solved(maze, source)
    for cell, steps in values.items():
        assert distances[cell] == (-1 if steps == np.inf else steps)
    assert (distances[maze.lava] == -1).all()


@examples
@given(mazes())
def test_a_maze_survives_its_json_view(maze: Maze) -> None:
    back = Maze.from_json(maze.to_json())
    np.testing.assert_array_equal(back.lava, maze.lava)
    assert (back.start, back.goal) == (maze.start, maze.goal)


def test_the_names_are_the_papers() -> None:
    assert SUBGOALS == ("north", "south", "west", "east", "go_to_target")
    assert ACTIONS == ("up", "down", "left", "right")


@examples
@given(st.data(), drawn_mazes())
def test_given_terminations_say_what_the_expert_says(data: st.DataObject, maze: Maze) -> None:
    """A subgoal has ended where the oracle says it is reached; elsewhere, it failed in lava or in a wrong room."""
    domain = MazeDomain()
    origin = data.draw(st.sampled_from([cell for cell in reachable_cells(maze) if room_of(cell) is not None]))
    here = data.draw(st.sampled_from([cell for cell in reachable_cells(maze) if cell != origin]))
    subgoal = data.draw(st.integers(0, 4))
    found = domain.outcome(maze, list(origin), list(here), subgoal)
    if oracle.reached(maze.to_json(), list(origin), list(here), subgoal):
        assert found == "reached"
    elif room_of(here) in (None, room_of(origin)):
        assert found is None
    elif found == "reached":  # in the room that the subgoal names, by a way around: there is no door in between
        assert not entries(maze, origin, subgoal)
        assert subgoal != TARGET
    else:
        assert found == "failed"


@examples
@given(st.data(), drawn_mazes(), st.integers(0, 4))
def test_lava_fails_every_subgoal(data: st.DataObject, maze: Maze, subgoal: int) -> None:
    lava = data.draw(st.sampled_from([(int(r), int(c)) for r, c in zip(*maze.lava.nonzero(), strict=True)]))
    assert MazeDomain().outcome(maze, list(maze.start), list(lava), subgoal) == "failed"
