"""A learner: policies, the data they learn from, and rollouts under them."""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import torch

from waypost.domain import Domain, Structured
from waypost.trajectory import State, Trajectory
from waypost_learner.policies.datasets import Dataset, Labels
from waypost_learner.policies.dqn import QFunction
from waypost_learner.policies.imitation import Policy
from waypost_learner.policies.views import sight
from waypost_learner.presets.base import Preset
from waypost_learner.rollout.policy_keys import FLAT, META, PolicyKey
from waypost_learner.rollout.rollout import Manner, Rollout, flat_rollout, hierarchical_rollout, nowhere_twice, run
from waypost_learner.rollout.simulator import HeadStart, Simulator

TRAIN, TEST = 0, 1
"""Streams of randomness: training and test rollouts draw from different ones."""
_ONE_OF = 6  # another: which segment of a rollout an algorithm asks about


@dataclass(frozen=True)
class Structure:
    """What a learner consists of: which policies, and which of them are Q-functions."""

    flat: bool = False  # one policy for everything
    q_hi: bool = False  # the meta-controller is a Q-function
    q_lo: bool = False  # the subpolicies are, or the flat policy is; subgoals' terminations are then given

    @property
    def reinforced(self) -> bool:
        """Whether anything is learned by reinforcement."""
        return self.q_hi or self.q_lo


HIERARCHY = Structure()
"""The paper's: mu and pi_g, all imitating."""


class Learner:
    """mu and one pi_g with beta_g per subgoal, or one flat policy; and D_HI and D_g, or D.

    Args:
        domain: where to act.
        preset: the values of learning.
        seed: fixes every draw.
        structure: which policies there are.
        threads: processor threads to train with; as many as there are if None.
        head_start: what is carried out before the learner begins; nothing if None.
    """

    def __init__(
        self,
        domain: Domain,
        preset: Preset,
        seed: int,
        structure: Structure = HIERARCHY,
        threads: int | None = None,
        head_start: HeadStart | None = None,
    ) -> None:
        self.domain, self.preset, self.seed, self.structure = domain, preset, seed, structure
        self._head_start = head_start
        self.simulator = self.make_simulator()
        keys = [FLAT] if structure.flat else [META, *range(len(domain.subgoals))]
        self._sights = {key: sight(domain, preset, key) for key in keys}
        own = [key for key in keys if self._sights[key].owner == key]
        self.q = {key: self._q_function(key) for key in own if (structure.q_hi if key == META else structure.q_lo)}
        self.imitators = {key: self._policy(key) for key in own if key not in self.q}
        self.learned: dict[PolicyKey, Policy | QFunction] = {**self.imitators, **self.q}
        self.policies = {key: one.through(self.learned[one.owner]) for key, one in self._sights.items()}
        self.data = {key: Dataset(self._sights[key].view.shape) for key in self.imitators}
        self._draw = 0
        self.due: list[PolicyKey] = []  # the policies that will train on
        # One thread a policy: small networks gain nothing from threads within one operation. What each policy learns
        # depends on its own data and generator, so the number of threads changes nothing but the time.
        torch.set_num_threads(1)
        self._threads = ThreadPoolExecutor(threads or os.cpu_count(), initializer=torch.set_num_threads, initargs=(1,))

    def _policy(self, key: PolicyKey) -> Policy:
        preset = self.preset
        hi = preset.train_hi_hybrid if self.structure.q_lo else preset.train_hi
        train = {META: hi, FLAT: preset.train_flat}.get(key, preset.train_lo)
        seen = self._sights[key]
        return Policy(seen.view.shape, self._choices(key), key >= 0, seen.network, train, self._seed(key))

    def _q_function(self, key: PolicyKey) -> QFunction:
        seen = self._sights[key]
        return QFunction(seen.view.shape, self._choices(key), seen.network, self.preset.dqn, self._seed(key))

    def _choices(self, key: PolicyKey) -> int:
        return len(self.domain.subgoals if key == META else self.domain.actions)

    def _seed(self, key: PolicyKey) -> int:
        return int(np.random.SeedSequence([self.seed, key + 2]).generate_state(1)[0])

    def make_simulator(self) -> Simulator:
        """Return a new simulator, with the head start there may be."""
        return Simulator(self.domain, self._head_start)

    def start(self, instance: Any, draw: int) -> State:
        """Put the simulator into the start state s of an instance, the run's `draw`-th."""
        self._draw = draw
        return self.simulator.reset(instance)

    def roll_out(self, s: State) -> Trajectory:
        """Roll out the present policies from s, the start state that `start` returned.

        Q-functions explore, and are updated after each of their choices (Algorithm 3, lines 9 to 11).
        """
        del s  # the simulator is in it
        rollout = self.rollout(self.simulator, self.simulator.instance, TRAIN, self._draw)
        return run(rollout, self.policies, self._stepped)

    def draw_one(self, sigma: Trajectory) -> int:
        """Return the number of a segment of the rollout that was just made, each as likely."""
        return int(np.random.default_rng([self.seed, _ONE_OF, self._draw]).integers(len(sigma)))

    def _stepped(self, key: PolicyKey) -> None:
        owner = self._sights[key].owner
        if owner in self.q:
            self.q[owner].step()

    def rollout(self, simulator: Simulator, instance: Any, stream: int, number: int) -> Rollout:
        """Return a rollout whose choices depend on the seed, the stream and its number in it alone."""
        rng = np.random.default_rng([self.seed, stream, number])
        exploring = {key: self.q[one.owner] for key, one in self._sights.items() if one.owner in self.q}
        manner = Manner(
            self.preset.choosing,
            rng,
            self.preset.h_hi or self.domain.horizons.hi,
            {key: q.epsilon if stream == TRAIN else 0.0 for key, q in exploring.items()},
            self.structure.q_lo,
            self.preset.repeat_penalty,
            self.domain.place if isinstance(self.domain, Structured) else nowhere_twice,
        )
        roll_out = flat_rollout if self.structure.flat else hierarchical_rollout
        return roll_out(simulator, instance, manner)

    def learn(self, labels: Labels) -> None:
        """Append to the data buffers, then Train the policies whose turn it is (docs/paper.md, deviation 6)."""
        sizes = {key: len(data) for key, data in self.data.items()}
        if self.preset.relabeling and isinstance(self.domain, Structured):
            labels.relabel(self.domain)
        for seen in self._symmetric(labels, self.preset.symmetries):
            for key, rows in seen.rows.items():
                if key in self.data:  # what is tied to another is learned from in its place
                    observe = self._sights[key].view.observe
                    self.data[key].append(replace(row, observation=observe(row.observation)) for row in rows)
        for seen in self._symmetric(labels, bool(labels.transitions) and self.preset.dqn.symmetries):
            for key, transitions in seen.transitions.items():
                if key in self.q:
                    observe = self._sights[key].view.observe
                    self.q[key].replay.add(one.seen(observe) for one in transitions)
        self.due = [
            key
            for key, policy in self.imitators.items()
            if policy.spec.every_episode or len(self.data[key]) > sizes[key]
        ]
        list(self._threads.map(lambda key: self.imitators[key].train(self.data[key]), self.due))

    def train_on(self) -> None:
        """Train on what the last episode brought, once, where the preset has it so: while the expert is busy."""
        list(self._threads.map(lambda key: self.imitators[key].train_on(self.data[key]), self.due))
        self.due = []

    def _symmetric(self, labels: Labels, symmetric: bool) -> Iterator[Labels]:
        """Yield labels as they are, and as they are in each symmetry of the domain, if so."""
        yield labels
        if symmetric:
            yield from map(labels.seen_through, self.domain.symmetries)
