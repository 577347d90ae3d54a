"""Find the symmetries of a domain of pictures that nobody told: turns and reflections that fit moves and labels."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import torch

from waypost.domains import Symmetry
from waypost.trajectory import Observation

_FITS = 0.25  # the largest distance, in total variation, of two distributions that are taken for the same ...
_NOISE = 1.0  # ... to which this is added, divided by the root of the number of observations
NO_SYMMETRY = -1
_EQUAL = 0.05  # distances that differ by less are taken for equal: then a choice stays itself


def _turned(mirrored: bool, quarters: int, picture: Any) -> Any:
    return np.ascontiguousarray(np.rot90(picture[..., ::-1] if mirrored else picture, quarters, (-2, -1)))


TURNS: Sequence[Callable[[Observation], Observation]] = [
    partial(_turned, mirrored, quarters)
    for mirrored, quarters in ((False, 2), (True, 0), (True, 2), (False, 1), (False, 3), (True, 1), (True, 3))
]
"""The turns and reflections of a picture, without the identity."""
_OF_OBLONGS = 3  # the first of them keep the shape of a picture that is no square


def find_symmetries(
    observation_shape: tuple[int, ...], displacements: torch.Tensor, actions_of: Sequence[torch.Tensor]
) -> torch.Tensor:
    """Return which turns and reflections keep moves and labels right, as far as was seen.

    A turn changes where actions move the agent. If the moves after it are again the moves of actions, it says which
    action becomes which. The subgoals follow: turned, the expert's actions toward one become those toward another.

    Args:
        observation_shape: (channels, rows, columns) of the pictures.
        displacements: where each action moved the agent, as shares float32[actions, 9] (`AgentFinder.displacements`).
        actions_of: how often the expert took each action toward each subgoal, int64[subgoals, actions]; several such
            tables, such as one of all actions and one of the last actions, must all fit.

    Returns:
        For each of `TURNS`, what each subgoal and then each action becomes, int64[turns, subgoals + actions]; a row of
        -1 for a turn that does not fit.
    """
    moves, tables = displacements.cpu().double().numpy(), [one.cpu().numpy() for one in actions_of]
    n_subgoals, n_actions = tables[0].shape
    found = np.full((len(TURNS), n_subgoals + n_actions), NO_SYMMETRY)
    square = observation_shape[1] == observation_shape[2]
    for row, turn in enumerate(TURNS if square else TURNS[:_OF_OBLONGS]):
        moved = _distances(turn(moves.reshape(-1, 3, 3)).reshape(-1, 9), moves)
        actions = _matched(moved, np.full(n_actions, np.inf), np.zeros((n_actions, n_actions)))
        if actions is None:
            continue
        far, noise = np.zeros((2, n_subgoals, n_subgoals))
        for taken in tables:
            turned = np.empty_like(taken)
            turned[:, actions] = taken
            far += _distances(turned + 1, taken + 1) / len(tables)  # one more of each: few observations tell little
            observed = taken.sum(1)
            noise += _NOISE / np.sqrt(np.minimum(observed[:, None], observed[None]) + 1) / len(tables)
        subgoals = _matched(far, tables[0].sum(1), noise)
        if subgoals is not None:
            found[row] = subgoals + actions
    return torch.from_numpy(found)


def symmetries_in(found: torch.Tensor, n_subgoals: int) -> tuple[Symmetry, ...]:
    """Return what `find_symmetries` found, as symmetries."""
    return tuple(
        Symmetry(turn, tuple(row[:n_subgoals]), tuple(row[n_subgoals:]))
        for turn, row in zip(TURNS, found.tolist(), strict=True)
        if NO_SYMMETRY not in row
    )


def _distances(first: Any, second: Any) -> Any:
    """Return the distances, in total variation, of each row of `first` from each row of `second`; rows are counts."""
    shares = first / first.sum(1, keepdims=True), second / second.sum(1, keepdims=True)
    return np.abs(shares[0][:, None] - shares[1][None]).sum(2) / 2


def _matched(distances: Any, observed: Any, noise: Any) -> list[int] | None:
    """Return the nearest partner of each row; None if one is farther than the noise allows, or could be another.

    Different rows have different partners. Rows that were observed more often choose first.
    """
    matches, free = {}, set(range(len(distances)))
    for row in np.argsort(-observed, kind="stable").tolist():
        far = distances[row] - _EQUAL * (np.arange(len(distances)) == row)
        nearest, *others = sorted(free, key=far.__getitem__)
        if others and nearest != row and far[others[0]] - far[nearest] < _EQUAL:
            return None  # too little was seen to tell which of them is its partner
        if distances[row, nearest] > _FITS + noise[row, nearest]:
            return None
        matches[row] = nearest
        free.remove(nearest)
    return [matches[row] for row in range(len(distances))]
