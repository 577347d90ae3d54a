"""A domain of MiniGrid: get the key, open the door between two rooms, drop the key, and pick up the box.

The environment is MiniGrid-UnlockPickup-v0. In this module, a state is the JSON view that `state` returns.
"""

from collections import deque
from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from minigrid.core.grid import Grid

import waypost

State = dict[str, Any]
Cell = tuple[int, int]  # column, row
Pose = tuple[int, int, int]  # column, row, and the direction: 0 right, 1 down, 2 left, 3 up

ACTIONS = {"left": 0, "right": 1, "forward": 2, "pickup": 3, "drop": 4, "toggle": 5}
SUBGOALS = {"get_key": "pickup", "open_door": "toggle", "drop_key": "drop", "pick_up_box": "pickup"}  # the last action
OBJECTS = {"get_key": "key", "open_door": "door", "pick_up_box": "box"}  # which the agent must face for it
AHEAD = ((1, 0), (0, 1), (-1, 0), (0, -1))  # by direction
TURNS = {"left": 3, "right": 1}


def state(env: gymnasium.Env[Any, Any]) -> State:
    """Return the agent's pose, the carried object, the door's state, and the cell of each object in the rooms."""
    base: Any = env.unwrapped
    cells = {one.type: divmod(i, base.width)[::-1] for i, one in enumerate(base.grid.grid) if one is not None}
    door = base.grid.get(*cells["door"])
    return {
        "pose": [*map(int, base.agent_pos), int(base.agent_dir)],
        "carrying": base.carrying.type if base.carrying else None,
        "door_is": "open" if door.is_open else "locked" if door.is_locked else "closed",
        **{name: list(cells[name]) if name in cells else None for name in OBJECTS.values()},
    }


def succeeded(state: State) -> bool:
    """Return whether the box is picked up."""
    return bool(state["carrying"] == "box")


def reached(origin: State, state: State, subgoal: str) -> bool:
    """Return whether a subgoal is accomplished."""
    del origin
    if subgoal == "open_door":
        return bool(state["door_is"] == "open")
    return bool(state["carrying"] == {"get_key": "key", "drop_key": None, "pick_up_box": "box"}[subgoal])


def good_subgoals(state: State) -> Sequence[str]:
    """Return the good subgoal. A key that is in the way must be moved again."""
    way_is_free = moves_to(state, "pick_up_box") is not None
    if state["carrying"] == "key":
        return ["drop_key" if way_is_free else "open_door"]
    if way_is_free:
        return ["pick_up_box"]
    return ["open_door" if state["door_is"] == "closed" and moves_to(state, "open_door") is not None else "get_key"]


def good_actions(origin: State, state: State, subgoal: str) -> Sequence[str]:
    """Return every action that begins a shortest way to a subgoal."""
    moves = moves_to(state, subgoal)
    if moves is None or reached(origin, state, subgoal):
        return []
    if moves == 0:
        return [SUBGOALS[subgoal]]
    after = {move: moves_to(state | {"pose": pose}, subgoal) for move, pose in next_poses(state, state["pose"])}
    return [move for move, left in after.items() if left == moves - 1]


def moves_to(state: State, subgoal: str) -> int | None:
    """Return how many moves the agent needs until one last action accomplishes a subgoal; None if it cannot."""
    start: Pose = tuple(state["pose"])
    moves, frontier = {start: 0}, deque([start])
    while frontier:
        pose = frontier.popleft()
        if can_end(state, faced(pose), subgoal):
            return moves[pose]
        for _, following in next_poses(state, pose):
            if following not in moves:
                moves[following] = moves[pose] + 1
                frontier.append(following)
    return None


def can_end(state: State, cell: Cell, subgoal: str) -> bool:
    """Return whether an agent that faces this cell can accomplish a subgoal by one action."""
    if subgoal != "drop_key":
        return bool(list(cell) == state[OBJECTS[subgoal]])
    column, row = state["door"]  # a key beside the door would block it
    return is_free(state, cell) and abs(cell[0] - column) + abs(cell[1] - row) > 1


def next_poses(state: State, pose: Sequence[int]) -> list[tuple[str, Pose]]:
    """Return each move that changes the pose, with the pose after it."""
    column, row, direction = pose
    poses = [(move, (column, row, (direction + turn) % 4)) for move, turn in TURNS.items()]
    return [*poses, ("forward", (*faced(pose), direction))] if is_free(state, faced(pose)) else poses


def faced(pose: Sequence[int], turn: int = 0) -> Cell:
    """Return the cell before the agent, or beside it after a turn."""
    ahead = AHEAD[(pose[2] + turn) % 4]
    return pose[0] + ahead[0], pose[1] + ahead[1]


def is_free(state: State, cell: Cell) -> bool:
    """Return whether the agent can enter a cell. Each room has 4 x 4 cells, and the door is in the wall between."""
    if list(cell) == state["door"]:
        return bool(state["door_is"] == "open")
    return cell[0] in (1, 2, 3, 4, 6, 7, 8, 9) and 1 <= cell[1] <= 4 and list(cell) not in (state["key"], state["box"])


class Egocentric(gymnasium.ObservationWrapper[Any, Any, Any]):
    """UnlockPickup with the observation float32[15] of `observation`. An episode also ends if the box is destroyed."""

    def __init__(self, env: gymnasium.Env[Any, Any]) -> None:
        super().__init__(env)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (15,), np.float32)

    def observation(self, observation: Any) -> Any:
        """Return how far ahead and to the right each object is, which cells around are free, the key and the door."""
        del observation  # MiniGrid's own shows a part of the rooms
        now, seen = state(self), list[float]()
        column, row, _ = now["pose"]
        for name in OBJECTS.values():
            x, y = now[name] or (column, row)
            for turn in (0, 1):
                dx, dy = faced((0, 0, now["pose"][2]), turn)
                seen.append(((x - column) * dx + (y - row) * dy) / 4)  # rooms have 4 cells on each side
            seen.append(now[name] is not None)
        seen += [is_free(now, faced(now["pose"], turn)) for turn in (0, 1, 3)]
        seen += [now["carrying"] == "key", now["door_is"] == "open", now["door_is"] == "locked"]
        return np.array(seen, np.float32)

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Carry out an action. MiniGrid destroys a box that the agent opens."""
        seen, reward, terminated, truncated, info = super().step(action)
        lost = state(self)["box"] is None and not succeeded(state(self))
        return seen, reward, terminated or lost, truncated, info


def picture(env: gymnasium.Env[Any, Any]) -> Any:
    """Return MiniGrid's picture, with the carried object in the top left corner."""
    image, held = np.array(env.render()), getattr(env.unwrapped, "carrying", None)
    if held is not None:
        tile = Grid.render_tile(held)
        image[: len(tile), : len(tile)] = tile
    return image


def landmarks(state: State) -> dict[str, Any]:
    """Return where the key, the door and the box are in the picture."""
    cells = {subgoal: state[thing] for subgoal, thing in OBJECTS.items() if state[thing] is not None}
    return {subgoal: box_of(cell) for subgoal, cell in cells.items()}


def action_landmarks(state: State) -> dict[str, Any]:
    """Return the cell of each action: beside the agent for a turn, ahead for an action that changes something there."""
    ahead = faced(state["pose"])
    cells = {move: faced(state["pose"], turn) for move, turn in TURNS.items()}
    if is_free(state, ahead):
        cells["forward"] = ahead
        if state["carrying"] and list(ahead) != state["door"]:
            cells["drop"] = ahead
    elif list(ahead) == state["door"]:
        cells["toggle"] = ahead
    elif list(ahead) in (state["key"], state["box"]) and not state["carrying"]:
        cells["pickup"] = ahead
    return {action: box_of(cell) for action, cell in cells.items()}


def box_of(cell: Sequence[int]) -> tuple[float, float, float, float]:
    """Return where a cell is in the picture, which shows 11 x 6 cells."""
    column, row = cell
    return column / 11, row / 6, (column + 1) / 11, (row + 1) / 6


unlock_pickup = waypost.domain(
    lambda: Egocentric(gymnasium.make("MiniGrid-UnlockPickup-v0", render_mode="rgb_array", highlight=False)),
    tuple(SUBGOALS),
    name="minigrid",
    actions=ACTIONS,
    horizons=(12, 10, 60),
    state=state,
    succeeded=succeeded,
    reached=reached,
    good_subgoals=good_subgoals,
    good_actions=good_actions,
    picture=picture,
    landmarks=landmarks,
    action_landmarks=action_landmarks,
)
