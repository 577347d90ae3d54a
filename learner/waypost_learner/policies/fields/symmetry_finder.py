"""Find the symmetries of a domain of pictures that nobody told: turns and reflections that fit moves and labels."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
import torch

from waypost.domains import Symmetry
from waypost.trajectory import Observation

_FITS = 0.15  # the largest distance, in total variation, of two distributions that are taken for the same ...
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
    observation_shape: tuple[int, ...], displacements: torch.Tensor, actions_of: torch.Tensor
) -> torch.Tensor:
    """Return which turns and reflections keep moves and labels right, as far as was seen.

    A turn changes where actions move the agent. If the moves after it are again the moves of actions, it says which
    action becomes which. The subgoals follow: turned, the expert's actions toward one become those toward another.

    Args:
        observation_shape: (channels, rows, columns) of the pictures.
        displacements: where each action moved the agent, as shares float32[actions, 9] (`AgentFinder.displacements`).
        actions_of: how often the expert took each action toward each subgoal, int64[subgoals, actions].

    Returns:
        For each of `TURNS`, what each subgoal and then each action becomes, int64[turns, subgoals + actions]; a row of
        -1 for a turn that does not fit.
    """
    moves, taken = displacements.cpu().double().numpy(), actions_of.cpu().numpy()
    found = np.full((len(TURNS), sum(taken.shape)), NO_SYMMETRY)
    square = observation_shape[1] == observation_shape[2]
    for row, turn in enumerate(TURNS if square else TURNS[:_OF_OBLONGS]):
        actions = _matched(turn(moves.reshape(-1, 3, 3)).reshape(-1, 9), moves, np.full(len(moves), np.inf))
        if actions is None:
            continue
        turned = np.empty_like(taken)
        turned[:, actions] = taken
        subgoals = _matched(turned + 1, taken + 1, taken.sum(1))  # one more of each: few observations tell little
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


def _matched(first: Any, second: Any, observed: Any) -> list[int] | None:
    """Return for each row of `first` the row of `second` with the nearest distribution; None if one is too far.

    Different rows have different partners. Rows that were observed more often choose first.
    """
    shares = first / first.sum(1, keepdims=True), second / second.sum(1, keepdims=True)
    distances = np.abs(shares[0][:, None] - shares[1][None]).sum(2) / 2
    matches, free = {}, set(range(len(first)))
    for row in np.argsort(-observed, kind="stable").tolist():
        far = distances[row] - _EQUAL * (np.arange(len(first)) == row)
        nearest, *others = sorted(free, key=far.__getitem__)
        if others and nearest != row and far[others[0]] - far[nearest] < _EQUAL:
            return None  # too little was seen to tell which of them is its partner
        if distances[row, nearest] > _FITS + _NOISE / np.sqrt(min(observed[row], observed[nearest]) + 1):
            return None
        matches[row] = nearest
        free.remove(nearest)
    return [matches[row] for row in range(len(first))]
