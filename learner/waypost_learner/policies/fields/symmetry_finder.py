"""Find the symmetries of a domain of pictures that nobody told: turns and reflections that fit moves and labels."""

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

import numpy as np
import torch

from waypost.domains import Symmetry
from waypost.trajectory import Observation

_FITS = 0.25  # the largest distance, in total variation, of the moves of actions that are taken for the same
_EVIDENCE = 3.0  # how much likelier, in nats, labels must be if subgoals correspond than if they do not
_MARGIN = 0.5  # nats by which the partner of a subgoal must be likelier than any other, unless it is the subgoal itself
_MOST = 20  # actions in a row of a table that count: so a small preference of the expert cannot outweigh the rest
NO_SYMMETRY = -1


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
        actions_of: how often the expert took each action toward each subgoal, int64[subgoals, actions]; the
            evidence of several such tables, such as one of all actions and one of the last actions, is added up.
            Without any action toward a subgoal, as for a flat policy, there is no evidence, so nothing is found.

    Returns:
        For each of `TURNS`, what each subgoal and then each action becomes, int64[turns, subgoals + actions]; a row of
        -1 for a turn that does not fit.
    """
    moves, tables = displacements.cpu().double().numpy(), [one.cpu().numpy() for one in actions_of]
    n_subgoals, n_actions = tables[0].shape
    found = np.full((len(TURNS), n_subgoals + n_actions), NO_SYMMETRY)
    square = observation_shape[1] == observation_shape[2]
    for row, turn in enumerate(TURNS if square else TURNS[:_OF_OBLONGS]):
        actions = _matched(-_distances(turn(moves.reshape(-1, 3, 3)).reshape(-1, 9), moves), range(n_actions), 0.0)
        if actions is None or min(likeness for _, likeness in actions) < -_FITS:
            continue
        becomes = [action for action, _ in actions]
        turned = [one[:, np.argsort(becomes)] for one in tables]
        evidence = sum(_evidence(one, other) for one, other in zip(turned, tables, strict=True))
        often_first = np.argsort(-tables[0].sum(1), kind="stable").tolist()
        subgoals = _matched(evidence, often_first, _MARGIN)
        if subgoals is not None and sum(likeness for _, likeness in subgoals) >= _EVIDENCE:
            found[row] = [subgoal for subgoal, _ in subgoals] + becomes
    return torch.from_numpy(found)


def symmetries_in(found: torch.Tensor, n_subgoals: int) -> tuple[Symmetry, ...]:
    """Return what `find_symmetries` found, as symmetries."""
    return tuple(
        Symmetry(turn, tuple(row[:n_subgoals]), tuple(row[n_subgoals:]))
        for turn, row in zip(TURNS, found.tolist(), strict=True)
        if NO_SYMMETRY not in row
    )


def _distances(first: Any, second: Any) -> Any:
    """Return the distances, in total variation, of each row of `first` from each row of `second`; rows are shares."""
    return np.abs(first[:, None] - second[None]).sum(2) / 2


def _evidence(first: Any, second: Any) -> Any:
    """Return the logarithm of the Bayes factor for each row of `first` and each row of `second`, which are counts.

    It compares that both were drawn with the same unknown probabilities with that each had its own. Their prior is
    uniform. Rows with few counts give little evidence either way.
    """
    first, second = (one * np.minimum(1, _MOST / np.maximum(one.sum(1, keepdims=True), 1)) for one in (first, second))
    together = _log_likelihood(first[:, None] + second[None])
    return together - _log_likelihood(first)[:, None] - _log_likelihood(second)[None]


def _log_likelihood(counts: Any) -> Any:
    """Return the logarithms of the probabilities of counts, along the last axis, under a uniform prior."""
    gamma = np.vectorize(math.lgamma)
    n = counts.shape[-1]
    return gamma(n) - gamma(n + counts.sum(-1)) + gamma(1 + counts).sum(-1)


def _matched(likeness: Any, order: Iterable[int], margin: float) -> list[tuple[int, float]] | None:
    """Return for each row the most alike column, with how alike they are; None if another is as much alike.

    Different rows have different partners. Rows choose in the given order. A row prefers itself by the margin.
    """
    matches, free = {}, set(range(len(likeness)))
    for row in order:
        preferred = likeness[row] + margin * (np.arange(len(likeness)) == row)
        best, *others = sorted(free, key=preferred.__getitem__, reverse=True)
        if others and best != row and preferred[best] - preferred[others[0]] < margin:
            return None
        matches[row] = (best, float(likeness[row, best]))
        free.remove(best)
    return [matches[row] for row in range(len(likeness))]
