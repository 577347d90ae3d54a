"""What each policy is given to see, and whose network answers for it: what a preset makes of a domain's structure."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from waypost.domain import Domain, Structured, Symmetry, View
from waypost_learner.policies.networks import NetworkSpec, PlanningSpec
from waypost_learner.presets.base import Preset
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey
from waypost_learner.rollout.rollout import Outputs

Answering = Callable[[NDArray[np.float32]], Outputs]


@dataclass(frozen=True)
class Through:
    """Answers for a policy with what another says of what something makes of the observations."""

    answering: Answering
    observe: Callable[[NDArray[np.float32]], NDArray[np.float32]]
    choices: Sequence[int] | None  # what each choice is to the other; the same if None

    def __call__(self, observations: NDArray[np.float32]) -> Outputs:
        """Evaluate float32[B, observation shape]."""
        out = self.answering(np.stack([self.observe(one) for one in observations]))
        return out if self.choices is None else Outputs(out.logits[:, self.choices], out.termination)


@dataclass(frozen=True)
class Sight:
    """How one policy sees.

    Args:
        view: what it is given of an observation.
        network: what its own network is, if it has one.
        owner: whose network answers: its own, or that of the policy it is tied to.
        symmetry: what makes its task the owner's; None if it is its own.
    """

    view: View
    network: NetworkSpec | PlanningSpec
    owner: PolicyKey
    symmetry: Symmetry | None

    def through(self, learned: Answering) -> Answering:
        """Return what answers for the policy, given what the owner has learned."""
        symmetry, look = self.symmetry, self.view.observe
        if symmetry is not None:
            return Through(learned, lambda seen: look(symmetry.observe(seen)), symmetry.actions)
        return learned if look is _everything else Through(learned, look, None)


def sight(domain: Domain, preset: Preset, key: PolicyKey) -> Sight:
    """Return how a policy sees."""
    view = _view(domain, preset, key)
    symmetry = _tie(domain, key) if preset.tied and key >= 0 else None
    owner = key if symmetry is None else symmetry.subgoals[key]
    if view.grid is None or preset.planning is None:
        return Sight(view, preset.network, owner, symmetry)
    horizons = domain.horizons
    ahead = {META: horizons.hi, FLAT: horizons.full}.get(key, horizons.lo)
    return Sight(view, PlanningSpec(view.grid, ahead, preset.planning), owner, symmetry)


def _view(domain: Domain, preset: Preset, key: PolicyKey) -> View:
    if not preset.views or not isinstance(domain, Structured):
        return View(domain.observation_shape, _everything)
    return {META: domain.hi_view, FLAT: domain.flat_view}.get(key, domain.lo_view)


def _everything(observation: NDArray[np.float32]) -> NDArray[np.float32]:
    return observation


def _tie(domain: Domain, key: PolicyKey) -> Symmetry | None:
    """Return the symmetry that makes a subgoal the first of those that are the same but for one; None for the first."""
    first = min(domain.symmetries, key=lambda one: one.subgoals[key], default=None)
    return first if first is not None and first.subgoals[key] < key else None
