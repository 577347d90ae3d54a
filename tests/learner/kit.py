"""What the learner's tests are written with: small presets, mazes to choose from, and a reference solver."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import assume, settings
from hypothesis import strategies as st

from waypost import wire
from waypost.client import Client
from waypost.trajectory import Segment, State
from waypost_learner.domains.maze.generator import maze_set
from waypost_learner.domains.maze.maze import ROOMS, SIZE, Cell, Maze, closed_rooms, room_of, walls
from waypost_learner.policies.dqn import DqnSpec
from waypost_learner.policies.imitation import TrainSpec
from waypost_learner.policies.labels import Labels, LoLabels
from waypost_learner.policies.networks import NetworkSpec, blocks
from waypost_learner.presets import PRESETS
from waypost_learner.presets.base import Preset, Training
from waypost_learner.remote.connection import Connection
from waypost_learner.remote.embedded import embedded
from waypost_learner.rollout.policy_keys import PolicyKey
from waypost_learner.rollout.rollout import RolloutSpec, SelectionSpec
from waypost_learner.runs.config import TrainConfig
from waypost_learner.runs.training import RunOptions

TINY_TRAIN = TrainSpec(learning_rate=5e-3, batch=16, least=48, most=48, dropout=0.25)
TINY = Preset(
    warm_start=3,
    rollouts=RolloutSpec(SelectionSpec(temperature=0.5, termination_threshold=0.9)),
    training=Training(
        network=NetworkSpec(blocks(4, 4), hidden=16),
        train_hi=TINY_TRAIN,
        train_lo=TINY_TRAIN,
        train_flat=TINY_TRAIN,
        train_hi_hybrid=TINY_TRAIN,
        dqn=DqnSpec(
            learning_rate=5e-3, batch=16, least=32, update_every=2, epsilon=((0, 1.0), (200, 0.02)), target_every=20
        ),
    ),
)
"""A preset for runs of a second, in which policies make all kinds of mistakes."""

_AVERAGED = replace(TINY_TRAIN, averaging=0.9)
TINY_LEAN = TINY.with_values(
    train_hi=_AVERAGED,
    train_lo=_AVERAGED,
    train_flat=_AVERAGED,
    train_hi_hybrid=_AVERAGED,
    symmetries=True,
    tied=True,
    views=True,
    planning=4,
    repeat_penalty=1.0,
    relabeling=True,
)
"""The same with every part of the preset `lean`."""

examples = settings(deadline=None, max_examples=40)
"""How properties are tried."""

GREEDY = SelectionSpec(temperature=0, termination_threshold=0.9)
STEPS: tuple[Cell, ...] = ((-1, 0), (1, 0), (0, -1), (0, 1))  # up, down, left, right


PRESETS["tiny"], PRESETS["tiny-lean"] = TINY, TINY_LEAN


@contextmanager
def store(path: Path) -> Iterator[tuple[Connection, RunOptions]]:
    """Connect to a store in `path`, with checkpoints beside it."""
    path.mkdir(exist_ok=True)
    with embedded(path / "waypost.db") as connection:
        yield connection, RunOptions(checkpoints=path / "checkpoints", threads=1)


# --- trajectories


def state(view: Any = None, number: float = 0) -> State:
    """A state that no network will see."""
    return State(np.full(2, number, np.float32), view)


def segment(subgoal: int | None, n_actions: int = 2, action: int = 0, terminated: bool = True) -> Segment:
    """A segment of states that differ."""
    states = tuple(state(number=number) for number in range(n_actions + 1))
    return Segment(subgoal, states, (action,) * n_actions, terminated)


# --- mazes


def free_cells(maze: Maze) -> list[Cell]:
    """Every cell that is no lava."""
    return [(int(row), int(column)) for row, column in np.argwhere(~maze.lava)]


def reachable_cells(maze: Maze) -> list[Cell]:
    """Every cell from which a path leads to the target."""
    return sorted(cell for cell, steps in solved(maze).items() if steps < np.inf)


def solved(maze: Maze, target: Cell | None = None) -> dict[Cell, float]:
    """Steps from each free cell to the target by value iteration: the reference that the oracle is held against."""
    value = np.full((SIZE + 2, SIZE + 2), np.inf)  # a frame of lava around it
    before = np.zeros_like(value)
    inside, (row, column) = value[1:-1, 1:-1], target or maze.goal
    while (before != value).any():
        before = value.copy()
        around = (before[:-2, 1:-1], before[2:, 1:-1], before[1:-1, :-2], before[1:-1, 2:])
        inside[:] = np.where(maze.lava, np.inf, 1 + np.minimum.reduce(around))
        inside[row, column] = 0
    return {cell: float(inside[cell]) for cell in free_cells(maze)}


def neighbours(cell: Cell) -> Sequence[Cell]:
    """The cells up, down, left and right of a cell, in the order of the actions."""
    return [(cell[0] + row, cell[1] + column) for row, column in STEPS]


@st.composite
def drawn_mazes(draw: st.DrawFn) -> Maze:
    """Mazes of the two sets."""
    training, test = maze_set(draw(st.sampled_from(["random", "corners"])))
    return draw(st.sampled_from([*training[:100], *test[:100]]))


def room_cells() -> st.SearchStrategy[Cell]:
    """Cells of rooms."""
    lines = st.integers(1, SIZE - 2).filter(lambda line: line % ROOMS)
    return st.tuples(lines, lines)


@st.composite
def free_mazes(draw: st.DrawFn) -> Maze:
    """Mazes as a file may have them: any doors, several in one wall too, and lava in rooms."""
    lava = closed_rooms()
    for *_, cells in walls():
        for cell, is_open in zip(cells, draw(st.tuples(*[st.booleans()] * 3)), strict=True):
            lava[cell] = not is_open
    for cell in draw(st.lists(room_cells(), max_size=6)):
        lava[cell] = True
    goal = draw(room_cells())
    lava[goal] = False
    unstarted = Maze(lava, goal, goal)
    starts = [cell for cell in reachable_cells(unstarted) if cell != goal and room_of(cell) is not None]
    assume(starts)
    return Maze(lava, draw(st.sampled_from(starts)), goal)


def mazes() -> st.SearchStrategy[Maze]:
    """Mazes of the sets and of files."""
    return st.one_of(drawn_mazes(), free_mazes())


def random_labels(seed: int, shape: tuple[int, ...], keys: Sequence[PolicyKey], n: int = 5, choices: int = 2) -> Labels:
    """Labels of random states for mu and for subpolicies: n states each."""
    rng = np.random.default_rng(seed)

    def states(n: int) -> tuple[State, ...]:
        return tuple(State(rng.random(shape).astype(np.float32), None) for _ in range(n))

    labels = Labels()
    for key in keys:
        chosen = tuple(int(choice) for choice in rng.integers(choices, size=n))
        if key.subgoal is None:
            sigma = tuple(Segment(0, (one, one), (0,), terminated=False) for one in states(n))
            labels.append_hi(sigma, chosen)
        else:
            ends = bool(rng.integers(2))
            segment = Segment(key.subgoal, states(n + 1), (0,) * n, terminated=False)
            labels.append_lo(segment, LoLabels(chosen, (*(False for _ in chosen), ends)))
    return labels


def picture(maze: Maze) -> list[str]:
    """The maze as rows of text, to show in a failure."""
    return ["".join("#" if maze.lava[row, column] else "." for column in range(SIZE)) for row in range(SIZE)]


# --- runs


def corridor(**values: Any) -> TrainConfig:
    """A run of a few seconds."""
    common = {"algorithm": "hg-dagger", "domain": "corridor", "preset": "tiny", "seed": 1, "episodes": 12}
    return TrainConfig(**common | values)


def history(client: Client, run: str) -> list[tuple[Any, ...]]:
    """All that was asked (its pictures aside), answered and charged in a run, by episode and ordinal."""
    found, cursor = [], 0
    pictures: Any = {part: {"__all__": {*wire.Pictured.model_fields}} for part in ("segments", "context")}
    while (page := client.answers(run, cursor)).queries:
        cursor = page.cursor
        found += [
            (q.ask.episode, q.ask.ordinal, q.ask.model_dump(exclude=pictures), q.answer, q.units) for q in page.queries
        ]
    return sorted(found, key=lambda row: row[:2])


def outcome(connection: Connection, summary: dict[str, Any]) -> tuple[Any, ...]:
    """What must be the same in the same run: weights, costs, results and every query with its answer."""
    client, run = connection.learner, summary["run"]
    curves = client.curves(run)
    results = (curves.episode, curves.test_success, curves.cost, curves.cost_by_kind)
    return summary["weights"], summary["cost"], summary["ended"], results, history(client, run)
