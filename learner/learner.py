"""A learner: policies, the data they learn from, and rollouts under them."""

import os
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import torch

from learner.datasets import Dataset, Labels
from learner.domains.base import Domain
from learner.policies import Policy
from learner.presets.base import Preset
from learner.rollout import Rollout, flat_rollout, hierarchical_rollout, run
from learner.simulator import Simulator
from learner.types import FLAT, META, PolicyKey, State, Trajectory

TRAIN, TEST = 0, 1
"""Streams of randomness: training and test rollouts draw from different ones."""


class Learner:
    """mu and one pi_g with beta_g per subgoal, or one flat policy; and D_HI and D_g, or D."""

    def __init__(
        self, domain: Domain, preset: Preset, seed: int, flat: bool = False, threads: int | None = None
    ) -> None:
        self.domain, self.preset, self.seed, self.flat = domain, preset, seed, flat
        self.simulator = Simulator(domain)
        keys = [FLAT] if flat else [META, *range(len(domain.subgoals))]
        self.policies = {key: self._policy(key) for key in keys}
        self.data = {key: Dataset(domain.observation_shape) for key in keys}
        self._draw = 0
        # One thread a policy: small networks gain nothing from threads within one operation. What each policy learns
        # depends on its own data and generator, so the number of threads changes nothing but the time.
        torch.set_num_threads(1)
        self._threads = ThreadPoolExecutor(threads or os.cpu_count(), initializer=torch.set_num_threads, initargs=(1,))

    def _policy(self, key: PolicyKey) -> Policy:
        choices = len(self.domain.subgoals if key == META else self.domain.actions)
        train = {META: self.preset.train_hi, FLAT: self.preset.train_flat}.get(key, self.preset.train_lo)
        seed = int(np.random.SeedSequence([self.seed, key + 2]).generate_state(1)[0])
        return Policy(self.domain.observation_shape, choices, key >= 0, self.preset.network, train, seed)

    def start(self, instance: Any, draw: int) -> State:
        """Put the simulator into the start state s of an instance, the run's `draw`-th."""
        self._draw = draw
        return self.simulator.reset(instance)

    def roll_out(self, s: State) -> Trajectory:
        """Roll out the present policies from s, the start state that `start` returned."""
        del s  # the simulator is in it
        return run(self.rollout(self.simulator, self.simulator.instance, TRAIN, self._draw), self.policies)

    def rollout(self, simulator: Simulator, instance: Any, stream: int, number: int) -> Rollout:
        """Return a rollout whose choices depend on the seed, the stream and its number in it alone."""
        rng = np.random.default_rng([self.seed, stream, number])
        roll_out = flat_rollout if self.flat else hierarchical_rollout
        return roll_out(simulator, instance, self.preset.choosing, rng)

    def learn(self, labels: Labels) -> None:
        """Append to the data buffers, then Train the policies whose buffer grew (docs/paper.md, deviation 6)."""
        grown: set[PolicyKey] = set()
        symmetries = self.domain.symmetries if self.preset.symmetries else ()
        for seen in (labels, *(labels.seen_through(symmetry) for symmetry in symmetries)):
            for key, rows in seen.rows.items():
                self.data[key].append(rows)
                grown |= {key} if rows else set()
        list(self._threads.map(lambda key: self.policies[key].train(self.data[key]), sorted(grown)))
