"""Determines which part of an observation each policy sees, and which network computes its outputs.

This depends on the preset (`DomainUse`) and on the domain's declarations (`waypost.domains.Viewed` and
`Centered`).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from waypost.domains import Centered, Cropped, Domain, Gridded, Symmetry, View, Viewed, symmetries_of
from waypost.trajectory import Observation
from waypost_learner.policies.domain_use import DomainUse
from waypost_learner.policies.networks import NetworkSpec
from waypost_learner.policies.planning import PlanningSpec
from waypost_learner.rollout.policy_keys import PolicyKey, pi
from waypost_learner.rollout.rollout import Outputs

Evaluate = Callable[[Observation], Outputs]
"""Maps a batch float32 or uint8[B, observation shape] to a policy's outputs."""


@dataclass(frozen=True)
class WrappedPolicy:
    """A policy that is evaluated on transformed observations, and whose choices may be permuted.

    Args:
        policy: the policy that is evaluated.
        observe: transforms one observation.
        choices: for each choice, the corresponding choice of `policy`; if None, choices are not permuted.
    """

    policy: Evaluate
    observe: Callable[[Observation], Observation]
    choices: Sequence[int] | None

    def __call__(self, observations: Observation) -> Outputs:
        """Return the outputs for a batch float32 or uint8[B, observation shape]."""
        out = self.policy(np.stack([self.observe(one) for one in observations]))
        return out if self.choices is None else Outputs(out.logits[:, self.choices], out.termination)


@dataclass(frozen=True)
class PolicyView:
    """The part of an observation that one policy sees, and the network that computes its outputs.

    Args:
        view: the part of an observation that it sees.
        network: the kind and the sizes of its network; None if all policies share one.
        owner: the policy whose network it uses: itself, or the policy that it is tied to.
        symmetry: maps its task to the owner's task; None if it is its own owner.
    """

    view: View
    network: NetworkSpec | PlanningSpec | None
    owner: PolicyKey
    symmetry: Symmetry | None

    def wrap(self, owner: Evaluate) -> Evaluate:
        """Return the policy, given its owner's network."""
        symmetry, observe = self.symmetry, self.view.observe
        if symmetry is not None:
            return WrappedPolicy(owner, lambda whole: observe(symmetry.observe(whole)), symmetry.actions)
        return owner if observe is _unchanged else WrappedPolicy(owner, observe, None)


def shared_view(domain: Domain, owner: PolicyKey) -> PolicyView:
    """Return the view of a policy that shares its network, named by its owner, with all others: the observation."""
    return PolicyView(View(domain.observation_shape, _unchanged), None, owner, None)


def policy_view(domain: Domain, use: DomainUse, network: NetworkSpec, key: PolicyKey) -> PolicyView:
    """Return the view and the network of a policy.

    Args:
        domain: declares views and symmetries.
        use: which of these declarations to use.
        network: the sizes of networks that do not plan.
        key: the policy.
    """
    view = _view(domain, use, key)
    if use.planning is not None and use.views and key.level == "flat" and isinstance(domain, Gridded):
        view = View(domain.observation_shape, _unchanged, domain.flat_grid)
    symmetry = _tie(domain, key.subgoal) if use.tied and key.subgoal is not None else None
    owner = key if symmetry is None or key.subgoal is None else pi(symmetry.subgoals[key.subgoal])
    if view.grid is None or use.planning is None:
        return PolicyView(view, network, owner, symmetry)
    horizons = domain.horizons
    horizon = {"hi": horizons.hi, "lo": horizons.lo, "flat": horizons.full}[key.level]
    return PolicyView(view, PlanningSpec(view.grid, horizon, use.planning), owner, symmetry)


def _view(domain: Domain, use: DomainUse, key: PolicyKey) -> View:
    if use.crop and isinstance(domain, Cropped) and key.level == "lo":
        return domain.crop_view
    if use.centered and isinstance(domain, Centered) and (key.level != "hi" or not use.views):
        return domain.centered_view
    if not use.views or not isinstance(domain, Viewed):
        return View(domain.observation_shape, _unchanged)
    return {"hi": domain.hi_view, "lo": domain.lo_view, "flat": domain.flat_view}[key.level]


def _unchanged(observation: Observation) -> Observation:
    return observation


def _tie(domain: Domain, subgoal: int) -> Symmetry | None:
    """Return the symmetry that maps a subgoal to the lowest possible number; None if that is its own number."""
    first = min(symmetries_of(domain), key=lambda one: one.subgoals[subgoal], default=None)
    return first if first is not None and first.subgoals[subgoal] < subgoal else None
