"""A domain of MiniGrid that declares nothing: cross rivers of lava through their openings, and reach the goal.

The environment is MiniGrid-LavaCrossingS11N5-v0 with one change: an action moves the agent up, down, left or right,
instead of turning it. In this module, a state is the JSON view that `state` returns.
"""

from typing import Any

import gymnasium
import numpy as np

import waypost

State = dict[str, Any]

MOVES = {"up": (0, -1), "down": (0, 1), "left": (-1, 0), "right": (1, 0)}  # column, row
DIRECTIONS = {"up": 3, "down": 1, "left": 2, "right": 0}  # MiniGrid's numbers
WALL, LAVA, GOAL, FREE = "#", "~", "G", "."
SYMBOLS = {"wall": WALL, "lava": LAVA, "goal": GOAL}
SIDE = 11


class Moves(gymnasium.Wrapper[Any, Any, Any, Any]):
    """LavaCrossing with the actions of `MOVES`. The observation float32[4, 11, 11] shows walls, lava, goal, agent."""

    def __init__(self, env: gymnasium.Env[Any, Any]) -> None:
        super().__init__(env)
        self.action_space = gymnasium.spaces.Discrete(len(MOVES))
        self.observation_space = gymnasium.spaces.Box(0, 1, (4, SIDE, SIDE), np.float32)

    def reset(self, **arguments: Any) -> tuple[Any, dict[str, Any]]:
        """Start an instance."""
        _, info = super().reset(**arguments)
        return picture_of(state(self)), info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Turn the agent, and move it forward."""
        base: Any = self.env.unwrapped
        base.agent_dir = list(DIRECTIONS.values())[int(action)]
        _, reward, terminated, truncated, info = super().step(base.actions.forward)
        return picture_of(state(self)), reward, terminated, truncated, info


def state(env: gymnasium.Env[Any, Any]) -> State:
    """Return the agent's column and row, and the rows of the map."""
    base: Any = env.unwrapped
    cells = [FREE if one is None else SYMBOLS[one.type] for one in base.grid.grid]
    return {
        "agent": [*map(int, base.agent_pos)],
        "map": ["".join(cells[row * SIDE : (row + 1) * SIDE]) for row in range(SIDE)],
    }


def picture_of(state: State) -> Any:
    """Return what networks see of a state."""
    cells = np.array([list(row) for row in state["map"]])
    agent = np.zeros((SIDE, SIDE), bool)
    agent[state["agent"][1], state["agent"][0]] = True
    return np.stack([cells == WALL, cells == LAVA, cells == GOAL, agent]).astype(np.float32)


def cell(state: State) -> str:
    """Return what is where the agent is."""
    column, row = state["agent"]
    return str(state["map"][row][column])


def succeeded(state: State) -> bool:
    """Return whether the agent is on the goal."""
    return cell(state) == GOAL


def reached(origin: State, state: State, subgoal: str) -> bool:
    """Return whether a subgoal is accomplished: the goal, or an opening farther right, or farther down."""
    if subgoal == "goal":
        return succeeded(state)
    axis = 0 if subgoal == "cross_right" else 1
    return state["agent"][axis] > origin["agent"][axis] and in_river(state, axis)


def in_river(state: State, axis: int) -> bool:
    """Return whether the agent is in the opening of a river that runs down (axis 0) or across (axis 1)."""
    place = state["agent"][axis]
    line = [row[place] for row in state["map"]] if axis == 0 else state["map"][place]
    return cell(state) == FREE and sum(one in (FREE, GOAL) for one in line) == 1  # a river has one opening


def successor(state: State, action: str) -> State:
    """Return the state after an action. Nothing moves the agent out of lava, or into a wall."""
    column, row = (place + move for place, move in zip(state["agent"], MOVES[action], strict=True))
    stays = cell(state) == LAVA or state["map"][row][column] == WALL
    return state if stays else {**state, "agent": [column, row]}


def action_landmarks(state: State) -> dict[str, Any]:
    """Return the cell in the picture to which each action leads; a wall keeps the agent where it is."""
    cells = {action: successor(state, action)["agent"] for action in MOVES}
    return {
        action: (column / SIDE, row / SIDE, (column + 1) / SIDE, (row + 1) / SIDE)
        for action, (column, row) in cells.items()
        if [column, row] != state["agent"]
    }


lava_crossing = waypost.domain(
    lambda: Moves(gymnasium.make("minigrid:MiniGrid-LavaCrossingS11N5-v0", render_mode="rgb_array", highlight=False)),
    ("cross_right", "cross_down", "goal"),
    name="crossing",
    actions=tuple(MOVES),
    horizons=(20, 12, 80),
    state=state,
    succeeded=succeeded,
    reached=reached,
    successor=successor,
    picture=lambda env: env.render(),
    action_landmarks=action_landmarks,
)
