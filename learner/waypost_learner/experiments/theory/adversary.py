"""Constructs the worst episodes for a learner: each shows one mistake, at the highest cost and with the least gain.

The theorems hold for every sequence of episodes, so an adversary who knows the learner comes closest to the bounds.
This adversary keeps the learner at a position where it acts correctly, lets the last segment begin at u, and leads it
to x for the last step, where its action differs from the expert's. So the episode fails, all other labels teach
nothing, and hg-DAgger inspects all earlier segments before the last one.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from waypost_learner.experiments.theory.classes import Classes
from waypost_learner.experiments.theory.halving import VersionSpace
from waypost_learner.experiments.theory.task import Task
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey, pi


def worst_instance(task: Task, classes: Classes, policies: dict[PolicyKey, VersionSpace]) -> Any | None:
    """Return the instance whose one mistake removes the fewest policies; None if no episode of this form exists."""
    right = classes.pi_star[classes.mu_star]  # [u, x], the expert's actions
    if FLAT in policies:
        acts, kept, trusted = _flat(policies[FLAT], right)
    else:
        acts, kept, trusted = _hierarchical(classes, policies, right)
    agrees = acts.diagonal() == right.diagonal()  # [u], the learner is right in the state (u, u)
    showing = np.where(agrees[:, None] & (acts != right), kept, 0)
    calm = np.flatnonzero(agrees & trusted)
    if not showing.any() or not len(calm):
        return None
    u, x = (int(i) for i in np.unravel_index(showing.argmax(), showing.shape))
    wait, horizons = int(calm[0]), task.horizons
    before = horizons.full - horizons.lo
    return task.steered(
        positions=[wait] * before + [u] * (horizons.lo - 1) + [x],
        actions=[int(acts[wait, wait])] * before + [int(acts[u, u])] * (horizons.lo - 1) + [int(acts[u, x])],
    )


_View = tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.bool_]]
"""The learner's actions, [u, x]; the share of a class that remains after a mistake there, [u, x]; whether mu is right,
[u]."""


def _flat(policy: VersionSpace, right: NDArray[np.int64]) -> _View:
    kept = np.take_along_axis(policy.votes, right[..., None], -1)[..., 0] / policy.size
    return policy.choices, kept, np.ones(len(right), bool)


def _hierarchical(classes: Classes, policies: dict[PolicyKey, VersionSpace], right: NDArray[np.int64]) -> _View:
    meta, subpolicies = policies[META], [policies[pi(g)] for g in range(len(classes.pi_star))]
    acts = np.array([one.choices for one in subpolicies])[meta.choices]
    knows = meta.choices == classes.mu_star  # [u]
    kept_lo = np.array([one.votes / one.size for one in subpolicies])[classes.mu_star]  # [u, x, actions]
    kept_lo = np.take_along_axis(kept_lo, right[..., None], -1)[..., 0]
    kept_hi = np.take_along_axis(meta.votes, classes.mu_star[:, None], -1) / meta.size  # [u, 1]
    return acts, np.where(knows[:, None], kept_lo, kept_hi), knows
